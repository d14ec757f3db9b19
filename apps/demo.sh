#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs the main job on a simulated flat: map it from one drive, then localize a
# second drive from an unknown start, with the camera and with the laser. Results go to build/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

share/debian/install-packages.sh
cmake --preset release
cmake --build --preset release --target vmcl

export PATH=$PWD/build/bin:$PATH
share=$PWD/share
mkdir -p build/demo
cd build/demo

run() {
  echo
  echo "\$ $*"
  "$@"
}

run vmcl simulate "$share/scenes/rooms.yaml" --session map --seed 1 -o map.rawlog --simplemap map.simplemap
run vmcl simulate "$share/scenes/rooms.yaml" --session query --seed 2 -o query.rawlog
run vmcl map map.simplemap -o map.vmap
for sensor in camera laser; do
  map=map.vmap
  [ "$sensor" = camera ] || map=map.simplemap
  run vmcl localize "$share/config/$sensor.ini" --map "$map" --rawlog query.rawlog \
    --groundtruth query.groundtruth.tum --threads 2 --out "$sensor"
done

python3 - <<'PYTHON'
import json, math

runs = {name: json.load(open(f'{name}/summary.json')) for name in ('camera', 'laser')}

def row(title, value):
    print(f'{title:34}' + ''.join(f'{value(run):>24}' for run in runs.values()))

def pose(run):
    x, y, phi = run['final']['robot_in_map']
    return f'{x:.3f} {y:.3f} {math.degrees(phi):.1f}'

def after(run, error):
    return run['ground_truth'][error + '_error_after_convergence']['rmse']

print()
row('', lambda run: next(name for name in runs if runs[name] is run))
row('updates', lambda run: run['frames'])
if all(run['ground_truth']['converged'] for run in runs.values()):
    row('time to converge, s', lambda run: f'{run["ground_truth"]["time_to_converge"]:.2f}')
    row('position RMSE from then on, m', lambda run: f'{after(run, "position"):.3f}')
    row('heading RMSE from then on, deg', lambda run: f'{math.degrees(after(run, "heading")):.2f}')
row('false accepts', lambda run: run['ground_truth']['false_accepts'])
row('pose at the end, m m deg', pose)
PYTHON
truth=$(tail -n 1 query.groundtruth.tum | awk '{printf "%.3f %.3f %.1f", $2, $3, 2 * atan2($7, $8) * 57.29577951}')
echo "(the truth: $truth)"
echo
echo "Pictures of the paths over the maps: $PWD/{camera,laser}/path.png"
