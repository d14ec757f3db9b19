#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: slurm.sh EXPERIMENT.yaml DIRECTORY [OPTION of sbatch ...]
# Makes the runs of an experiment as an array job of Slurm, waits for it, and reports as vmcl evaluate does:
#
#   slurm.sh rooms.yaml result --partition short --time 2:00:00
#
# The nodes see experiment, data, directory and the program vmcl at the same paths as this machine. Run it again to go
# on after a stop. What the tasks say goes to DIRECTORY/slurm.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '4,11s/^# \?//p' "$0" >&2; exit 2; }
vmcl=$(realpath "${VMCL:-$(command -v vmcl)}")
directory=$(realpath -m "$2")
evaluate=("$vmcl" evaluate "$(realpath "$1")" -o "$directory")
shift 2

runs=$("${evaluate[@]}" --list | wc -l)
max_tasks=1000 # of an array, as Slurm comes; a task makes several runs when there are more
mkdir -p "$directory/slurm"
task=$(dirname "$(realpath "$0")")/slurm_task.sh
sbatch --wait --quiet --array="1-$((runs < max_tasks ? runs : max_tasks))" --output="$directory/slurm/%A_%a.txt" \
  "$@" "$task" "$directory/jobs.jsonl" "${evaluate[@]}" || true # the report says which failed
exec "${evaluate[@]}" --report-only
