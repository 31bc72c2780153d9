#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_deb.sh BUILD SOURCE: makes the Debian packages of a build, installs them on a bare Debian of their own (debootstrap)
# and runs there the README's command, looks up a man page and the completion, and builds the README's program.
set -euo pipefail
build=$1 source=$2
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "skipped: needs root and debootstrap"
  exit 77
fi
work=$(mktemp -d)
leave() { umount "$work/debian/proc" 2>/dev/null || true; rm -rf "$work"; }
trap leave EXIT

(cd "$work" && cpack -G DEB --config "$build/CPackConfig.cmake" >/dev/null)
debootstrap --variant=minbase bookworm "$work/debian" >/dev/null
mount -t proc proc "$work/debian/proc"
cp /etc/resolv.conf "$work/debian/etc/"
cp -r /etc/apt/apt.conf.d/. "$work/debian/etc/apt/apt.conf.d/"   # a proxy, where there is one
mkdir "$work/debian/site"
cp "$work"/*.deb "$source"/data/olkiluoto-twin/* "$work/debian/site/"
inside() { chroot "$work/debian" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 sh -euc "cd /site; $1"; }

inside 'apt-get update -qq; apt-get install -y -qq --no-install-recommends ./terratet_*.deb >/dev/null'
inside 'terratet --version
  terratet convert --boreholes collar.csv --survey survey.csv --log log.csv --faults fracture.ts \
    --property K:log10:unit=m/s -s_srs EPSG:3067 --lmin 20m --lmax 80m model.gpkg model.vtu model.glb model.vdb
  test -s model.gpkg -a -s model.vtu -a -s model.glb -a -s model.vdb
  terratet check model.gpkg
  dpkg -L terratet | grep -q completions/terratet$
  dpkg -L terratet | grep -q man1/terratet-convert.1'
cp -r "$source/tests/install" "$work/debian/site/project"
inside 'apt-get install -y -qq --no-install-recommends ./libterratet-dev_*.deb g++ cmake ninja-build >/dev/null
  cmake -S project -B built -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null; cmake --build built >/dev/null
  sed s/^OT-01,/B12,/ collar.csv > renamed_collar.csv; sed s/^OT-01,/B12,/ log.csv > renamed_log.csv
  built/first_model renamed_collar.csv renamed_log.csv first.vtu; test -s first.vtu
  built/without_fault model.gpkg fracture healed.vtu; test -s healed.vtu'
echo "the packages install and work on a bare Debian"
