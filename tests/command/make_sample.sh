#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: make_sample.sh VMCL SCENE DIRECTORY
# What the tests of the command work on: the first seconds of the demo's map drive, driven twice with noise of their
# own, and a map of the first.
set -euo pipefail
vmcl=$1 scene=$2 directory=$3

rm -rf "$directory"
mkdir -p "$directory"
cd "$directory"
"$vmcl" simulate "$scene" --session map --duration 10 --seed 1 -o map.rawlog --simplemap map.simplemap
"$vmcl" simulate "$scene" --session map --duration 10 --seed 2 -o query.rawlog
"$vmcl" map map.simplemap -o sample.vmap
