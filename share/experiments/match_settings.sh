#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: match_settings.sh MAP LOG GROUNDTRUTH
# The paper's table: success within 0.25, 0.5 and 1 m (and 5 deg) by setting, single images and five frames, beside the
# methods of the study. MAP is one made with `vmcl map --dense`.
set -euo pipefail
for frames in 1 5; do
  for setting in scsd dcsd dcdd; do
    echo "== $setting, frames: $frames"
    "${VMCL:-vmcl}" relocalize --map "$1" --rawlog "$2" --groundtruth "$3" --setting $setting --frames $frames --peers
  done
done
