#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# All tests, on a bare Debian 12: installs what is missing, builds the preset release, runs ctest.
#     tests/run.sh             everything but what needs heavy peers
#     tests/run.sh --peers     also the comparisons with gmsh, gstat, PostGIS, TetGen
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$root/tools/setup.sh"

selection=(--label-exclude peers)
packages=("${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}")
case "${1:-}" in
  '') ;;
  --peers) selection=(); packages+=("${PEER_PACKAGES[@]}") ;;
  *) echo "usage: tests/run.sh [--peers]" >&2; exit 2 ;;
esac

install_packages "${packages[@]}"
cd "$root"
cmake --preset release -DTERRATET_MPI=ON  # of what is built for it one file differs; without mpirun all is as without
cmake --build --preset release -j "$(build_jobs)"
ctest --preset release -j 2 "${selection[@]}"
