#!/usr/bin/env bash
# Makes the pictures of the README, of docs/report.md and of docs/lighting.md anew: screenshots that the test of the report's pages keeps.
# Needs what ./test.sh sets up, and build/dev.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
SHADOWPROOF_SCREENSHOTS=$folder ctest --test-dir build/dev --tests-regex '^viewer_page$' \
    --output-on-failure
for picture in overview cell; do cp "$folder/$picture-light.png" "docs/$picture.png"; done
SHADOWPROOF=$PWD/build/dev/shadowproof node docs/filtering.mjs
