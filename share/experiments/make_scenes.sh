#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: make_scenes.sh [SCENE ...]
# Makes in the working directory what scenes.yaml runs on: for each scene of share/scenes a drive by daylight, a map of
# it, and a drive in the evening, with people about and things moved.
set -euo pipefail
vmcl=${VMCL:-vmcl}
scenes=$(realpath "$(dirname "$0")/../scenes")
[ $# -gt 0 ] || set -- apartment office cafe
for scene; do
  "$vmcl" simulate "$scenes/$scene.yaml" --session map --seed 1 -o "$scene-map.rawlog" --simplemap "$scene.simplemap"
  "$vmcl" simulate "$scenes/$scene.yaml" --session query --seed 2 -o "$scene.rawlog"
  "$vmcl" map "$scene.simplemap" -o "$scene.vmap"
done
