#!/usr/bin/env bash
# Builds the fuzz targets and runs them, two at a time, sharing the minutes: tests/fuzz/run.sh MINUTES
# Prints executions, processor time and findings of each; exits 1 where a promise was broken.
#
# The corpus grows in build/fuzz/corpus/TARGET and begins with what is kept in tests/fuzz/corpus;
# inputs that break a promise lie in build/fuzz/found. `./setup.sh fuzz` installs what this needs.
set -euo pipefail
cd "$(dirname "$0")/../.."
minutes=${1:-}
[[ $minutes =~ ^[1-9][0-9]*$ ]] || { echo "usage: tests/fuzz/run.sh MINUTES" >&2; exit 2; }
command -v clang++-14 >/dev/null || {
    echo "run.sh: there is no clang++-14; run ./setup.sh fuzz" >&2
    exit 3
}
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz

targets=(gltf md2 picture results verify)
slots=2
seconds=$((minutes * 60 * slots / ${#targets[@]}))
work=build/fuzz
found=$work/found/$(date +%Y%m%dT%H%M%S)
mkdir -p "$found" "$work/logs"
export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp
export ASAN_SYMBOLIZER_PATH=${ASAN_SYMBOLIZER_PATH:-/usr/bin/llvm-symbolizer-14}
# llvmpipe would start a thread for each core; two targets run at a time already.
export LP_NUM_THREADS=0

# One target, in rounds until its time is over: a crash ends a round, and the next goes on.
run() {
    local name=$1 log=$work/logs/$1.log corpus=$work/corpus/$1
    # Mesa and LLVM keep what they have made until the end, and so does libpng's caller where a
    # picture is damaged.
    local leaks=1
    case $name in verify | picture) leaks=0 ;; esac
    local begin=$SECONDS round=0 code before
    mkdir -p "$corpus"
    : >"$log"
    while [ $((SECONDS - begin)) -lt "$seconds" ]; do
        code=0
        before=$(find "$found" -name "$name-*" | wc -l)
        SHADOWPROOF_FUZZ_FINDINGS=$found \
            ASAN_OPTIONS=detect_leaks=$leaks:quarantine_size_mb=16:allocator_may_return_null=1 \
            "$work/tests/fuzz/fuzz_$name" "$corpus" "tests/fuzz/corpus/$name" \
            -artifact_prefix="$found/$name-" -max_total_time=$((seconds - (SECONDS - begin))) \
            -max_len=60000 -len_control=0 -timeout=30 -rss_limit_mb=3000 -malloc_limit_mb=1500 \
            -print_final_stats=1 >>"$log" 2>&1 || code=$?
        # Whatever ends a round without an input of its own to show is a finding all the same.
        round=$((round + 1))
        if [ "$code" -ne 0 ] && [ "$(find "$found" -name "$name-*" | wc -l)" -eq "$before" ]; then
            echo "see $log" >"$found/$name-ended-with-$code-in-round-$round"
            break
        fi
    done
    # The second line of `times` is of what this subshell has started: "0m1.2s 0m0.3s", the
    # targets' own work and the kernel's for them.
    times >"$log.times"
    local processor
    processor=$(tail -n 1 "$log.times")
    awk -v name="$name" -v processor="$processor" '
        /stat::number_of_executed_units/ { executions += $2 }
        / cov: / { for (i = 1; i < NF; ++i) if ($i == "cov:") coverage = $(i + 1) }
        END { printf "%-8s %10d executions, %d edges, processor time %s\n",
                     name, executions, coverage, processor }' "$log"
}

# Each slot takes the next target that nobody has taken.
queue=$(mktemp)
trap 'rm -f "$queue" "$queue.lock"; jobs -p | xargs -r kill 2>/dev/null' EXIT
printf '%s\n' "${targets[@]}" >"$queue"
slot() {
    local name
    while name=$(flock "$queue.lock" sh -c 'head -n 1 "$0"; sed -i 1d "$0"' "$queue") && [ -n "$name" ]
    do
        (run "$name")
    done
}
for ((i = 0; i < slots; ++i)); do slot & done
wait

count=$(find "$found" -type f | wc -l)
echo "$count findings in $found"
find "$found" -type f -printf '  %f\n' | sort
[ "$count" -eq 0 ]
