#!/usr/bin/env bash
# Makes docs/report.png: the top of the report of near_plane, as headless Chromium shows it.
# Needs Chromium and the command that ./verify.sh builds.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/shadowproof verify near_plane -q --out "$folder/report"
chromium --headless --no-sandbox --hide-scrollbars --window-size=1100,1260 \
    --screenshot="$PWD/docs/report.png" "file://$folder/report/index.html" 2>/dev/null
