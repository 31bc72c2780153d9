#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# From a fresh clone on a bare Debian 12 to a model that can be looked at: installs what is missing, builds, models the
# synthetic site in data/olkiluoto-twin.
#     tools/demo.sh [FOLDER]        outputs go to FOLDER, by default out/ in the checkout
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-"$root/out"}
. "$root/tools/setup.sh"

install_packages "${BUILD_PACKAGES[@]}"
echo "Building (some minutes the first time) …" >&2
cmake -S "$root" -B "$root/build/demo" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" \
  -DTERRATET_TESTS=OFF >/dev/null
cmake --build "$root/build/demo" --target terratet -j "$(build_jobs)" >/dev/null

mkdir -p "$out"
out=$(cd "$out" && pwd)
site=$root/data/olkiluoto-twin
"$root/build/demo/tools/terratet" convert \
  --boreholes "$site/collar.csv" --survey "$site/survey.csv" --log "$site/log.csv" --faults "$site/fracture.ts" \
  --property K:log10:unit=m/s -s_srs EPSG:3067 -te 525130 6791500 -990 525870 6792500 10 \
  --lmin 20m --lmax 80m --df-max K=1 -tr 10m \
  --overwrite --report "$out/report.json" \
  "$out/olkiluoto-twin.html" "$out/olkiluoto-twin.png" "$out/olkiluoto-twin.gpkg" "$out/olkiluoto-twin.vtu" "$out/olkiluoto-twin.glb" "$out/olkiluoto-twin.vdb" \
  "$out/olkiluoto-twin.csv"

cat <<TEXT

What to look at:
  $out/olkiluoto-twin.html
      any browser opens it, offline: sections, thresholds, logs, values; $out/olkiluoto-twin.png is its picture
  $out/olkiluoto-twin.vtu
      ParaView (apt-get install paraview): open, Apply, colour by K; Threshold on MaterialIDs shows a fault block
  $out/olkiluoto-twin.glb
      drop it on https://gltf-viewer.donmccurdy.com or open it in Blender
  $out/olkiluoto-twin.vdb
      Houdini or Blender as a volume; on a terminal: vdb_print -l (apt-get install libopenvdb-tools)
  $out/olkiluoto-twin.gpkg
      the model: QGIS opens its layers; $root/build/demo/tools/terratet info reads it, check verifies it
  $out/olkiluoto-twin.csv
      the vertices with their values
  $out/report.json
      what was done, in numbers ('terratet help report' explains the keys)
TEXT
