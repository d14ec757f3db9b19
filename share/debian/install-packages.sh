#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what vmcl needs and this Debian 12 machine lacks; touches nothing when all of it is there.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev libceres-dev libhwy-dev libopencv-dev zlib1g-dev
  libmrpt-slam-dev libmrpt-opengl-dev
  libcli11-dev nlohmann-json3-dev libyaml-cpp-dev
  libassimp-dev # meshes of simulated scenes
  librosbag-storage-dev # ROS 1 bags
  libgl1-mesa-dri # renders without a GPU, for the simulator
  gnuplot-nox
  libopengv-dev # peers of vmcl bench
  # the rest serves the tests and the demo
  python3-torch python3-torchvision # share/selector: to train networks, 250 MB
  libgtest-dev libgmock-dev libbenchmark-dev python3
  parallel slurm-wlm # share/cluster
  mrpt-apps mrpt-common # the stock pf-localization and its laser demo
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
[ "$(id -u)" = 0 ] || as_root=(sudo)
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
