#!/usr/bin/env bash
# Sets up, builds and runs `shadowproof verify`, with the arguments given: ./verify.sh [SCENE...]
# The report is then in report/index.html, or where --out says.
set -euo pipefail
root=$(cd "$(dirname "$0")" && pwd)
"$root/setup.sh" build
(
    cd "$root"
    # Quiet unless it fails.
    log=$(mktemp)
    trap 'rm -f "$log"' EXIT
    cmake --preset release >"$log" 2>&1 || { cat "$log" >&2; exit 3; }
    cmake --build --preset release --target shadowproof || exit 3
)
exec "$root/build/release/shadowproof" verify "$@"
