#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing on a bare Debian 12; sourced by tools/demo.sh and tests/run.sh:
#     . tools/setup.sh && install_packages "${BUILD_PACKAGES[@]}"
# Only apt is used. Nothing happens when everything is there.

# What the library and the command need.
BUILD_PACKAGES=(
  g++ cmake ninja-build pkg-config
  libgdal-dev libproj-dev libsqlite3-dev libcgal-dev libopenvdb-dev libboost-iostreams-dev libtbb-dev libmeshoptimizer-dev libcairo2-dev zlib1g-dev
  libdeflate-dev libnetcdf-dev
  nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev libeigen3-dev libcpp-httplib-dev
)
# What the tests need besides: independent readers of our outputs among others.
TEST_PACKAGES=(
  libopenmpi-dev openmpi-bin
  clang-14 libclang-rt-14-dev
  catch2 python3 python3-vtk9 python3-openvdb python3-gdal python3-netcdf4 netcdf-bin libopenvdb-tools gdal-bin voro++-dev chromium fonts-dejavu-core
)
# Node may come from elsewhere than Debian, where its package would be in the way.
command -v npm >/dev/null || TEST_PACKAGES+=(nodejs npm)
# The heavy peers that `tests/run.sh --peers` compares with.
PEER_PACKAGES=(gmsh libgmsh-dev r-base-core r-cran-gstat python3-scipy postgresql-15-postgis-3 libtet1.5-dev libbenchmark-dev
               debootstrap dpkg-dev python3-qgis blender)

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

# Mirrors fail now and then: three tries, a little apart.
with_retries() {
  local try
  for try in 1 2 3; do
    "$@" && return 0
    echo "setup: '$*' failed (try $try of 3)" >&2
    sleep $((try * 5))
  done
  return 1
}

install_packages() {
  local package missing=()
  for package in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  echo "setup: installing ${missing[*]}" >&2
  with_retries as_root apt-get update -qq || return 1
  with_retries as_root apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# A translation unit of CGAL or OpenVDB takes over 1 GB: as many jobs as memory allows, at most as many as cores.
build_jobs() {
  local gigabytes cores
  gigabytes=$(awk '/MemAvailable/ {print int($2 / 2000000)}' /proc/meminfo)
  cores=$(nproc)
  [ "$gigabytes" -ge 1 ] || gigabytes=1
  echo $((gigabytes < cores ? gigabytes : cores))
}
