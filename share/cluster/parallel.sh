#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: parallel.sh EXPERIMENT.yaml DIRECTORY [OPTION of GNU Parallel ...]
# Makes the runs of an experiment with GNU Parallel, on this machine or on others, and reports as vmcl evaluate does:
#
#   parallel.sh rooms.yaml result --sshlogin 8/alice,16/bob
#
# The hosts see experiment, data, directory and the program vmcl at the same paths as this machine (a shared file
# system), and ssh asks for no password. Run it again to go on after a stop.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '4,11s/^# \?//p' "$0" >&2; exit 2; }
vmcl=$(realpath "${VMCL:-$(command -v vmcl)}")
evaluate=("$vmcl" evaluate "$(realpath "$1")" -o "$(realpath -m "$2")")
shift 2

runs=$("${evaluate[@]}" --list)
parallel --quote --workdir "$PWD" "$@" "${evaluate[@]}" --job {} <<< "$runs" || true # the report says which failed
exec "${evaluate[@]}" --report-only
