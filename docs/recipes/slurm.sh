#!/usr/bin/env bash
# Verifies on a Slurm cluster: an array job of PARTS tasks, and a job behind it that joins their
# reports. Waits for both, and exits as one run of `shadowproof verify` would.
#
#   ./slurm.sh PARTS REPORT [ARGUMENTS OF shadowproof verify]
#   ./slurm.sh 16 report scenes/*.glb --size 1024x1024 --gate differences
#
# REPORT must lie on a file system that all nodes share; the parts are written to REPORT.parts. A task
# whose node fails, or that is preempted, starts again elsewhere and goes on where it was. After
# failures that Slurm does not repair, call it again with the same words: what was cut off goes on.
# Partition, account, time and the like are sbatch's own variables: SBATCH_PARTITION=short ./slurm.sh ...
# $SHADOWPROOF names the program, if it is not on the nodes' PATH.
set -euo pipefail
program=${SHADOWPROOF:-shadowproof}

# The jobs run this script, too.
case ${1:-} in
part)
    of=$2 report=$3
    shift 3
    part=$SLURM_ARRAY_TASK_ID
    exec "$program" verify "$@" --shard "$part/$of" --out "$report.parts/$part" --resume \
        --threads "${SLURM_CPUS_ON_NODE:-0}"
    ;;
join)
    of=$2 report=$3
    parts=()
    for ((part = 1; part <= of; ++part)); do parts+=("$report.parts/$part"); done
    exec "$program" merge "${parts[@]}" --out "$report"
    ;;
esac

[[ ${1:-} =~ ^[1-9][0-9]*$ && -n ${2:-} ]] || {
    echo "usage: ${0##*/} PARTS REPORT [ARGUMENTS OF shadowproof verify]" >&2
    exit 2
}
of=$1 report=$2
shift 2
mkdir -p "$report.parts"
job=$(sbatch --parsable --job-name=shadowproof --requeue --open-mode=append --array="1-$of" \
    --output="$report.parts/%a.txt" "$0" part "$of" "$report" "$@")
# Whatever became of the parts: merge says which of them is not there.
sbatch --wait --job-name=shadowproof-merge --dependency="afterany:${job%%;*}" \
    --output="$report.parts/merge.txt" "$0" join "$of" "$report" || code=$?
cat "$report.parts/merge.txt"
exit "${code:-0}"
