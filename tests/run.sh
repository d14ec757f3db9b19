#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs every test: the unit tests under the address and undefined behaviour
# sanitizers, then the whole suite in Release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

share/debian/install-packages.sh

cmake --preset release
cmake --build --preset release

cmake --preset sanitize
cmake --build --preset sanitize

ctest --preset sanitize
ctest --preset release
