#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: make_scenes.sh [-I DIRECTORY] [SCENE ...]
# Makes in the working directory what scenes.yaml runs on: for each scene of share/scenes a drive by daylight, a map of
# it, and a drive in the evening, with people about and things moved. The scene aws_small_house needs its meshes, which
# do not come along: DIRECTORY holds them and their scene.yaml.
set -euo pipefail
vmcl=${VMCL:-vmcl}
scenes=$(realpath "$(dirname "$0")/../scenes")
include=()
all=(apartment office cafe)
if [ "${1:-}" = -I ]; then
  include=(-I "$2")
  all+=(aws_small_house)
  shift 2
fi
[ $# -gt 0 ] || set -- "${all[@]}"
for scene; do
  simulate=("$vmcl" simulate "$scenes/$scene.yaml" "${include[@]}")
  "${simulate[@]}" --session map --seed 1 -o "$scene-map.rawlog" --simplemap "$scene.simplemap"
  "${simulate[@]}" --session query --seed 2 -o "$scene.rawlog"
  "$vmcl" map "$scene.simplemap" -o "$scene.vmap"
done
