#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: make_sample.sh VMCL SCENE DIRECTORY
# What the tests of the command work on: the first seconds of the demo's map drive, driven three times with noise of
# their own (the last time only the start of it, for tests that need no more), and a map of the first.
set -euo pipefail
vmcl=$1 scene=$2 directory=$3

rm -rf "$directory"
mkdir -p "$directory"
cd "$directory"
"$vmcl" simulate "$scene" --session map --duration 10 --seed 1 -o map.rawlog --simplemap map.simplemap
"$vmcl" simulate "$scene" --session map --duration 10 --seed 2 -o query.rawlog
"$vmcl" simulate "$scene" --session map --duration 2.5 --seed 3 -o start.rawlog
"$vmcl" map map.simplemap -o sample.vmap
