#!/usr/bin/env bash
# Sets up, builds with warnings as errors, and runs all tests: ./test.sh [CTEST ARGUMENTS...]
# PRESET=asan-ubsan or tsan takes another preset than dev; TARGET=name builds no more than that.
set -euo pipefail
cd "$(dirname "$0")"
preset=${PRESET:-dev}
./setup.sh test
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" ${TARGET:+--target "$TARGET"}

log=$(mktemp)
trap 'rm -f "$log"' EXIT
status=0
ctest --preset "$preset" -j2 "$@" | tee "$log" || status=$?
# "100% tests passed, 0 tests failed out of 123"
summary=$(sed -nE 's/.* ([0-9]+) tests failed out of ([0-9]+)$/\1 \2/p' "$log" | tail -n 1)
read -r failed total <<<"${summary:-0 0}"
echo "$((total - failed)) passed, $failed failed"
[ "$total" -gt 0 ] || { echo "test.sh: no test ran" >&2; status=1; }
exit "$status"
