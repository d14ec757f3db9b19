#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: slurm_task.sh JOBS.jsonl VMCL evaluate EXPERIMENT.yaml -o DIRECTORY
# A task of slurm.sh: makes the runs on line K, K + COUNT, K + 2 COUNT, ... of the job list.
set -uo pipefail
jobs=$1
shift
sed -n "${SLURM_ARRAY_TASK_ID}~${SLURM_ARRAY_TASK_COUNT}s/^{\"id\":\"\([^\"]*\)\".*/\1/p" "$jobs" |
  while read -r id; do "$@" --job "$id" < /dev/null; done
