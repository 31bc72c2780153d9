# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where CesiumJS puts the corners of a model 24 km wide, against PROJ.

    check_globe.py TERRATET NODE_MODULES PICTURE.png"""
import itertools
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from osgeo import osr

osr.UseExceptions()
terratet, modules, picture = sys.argv[1:]
west, south, bottom, east, north, top = 525000, 6780000, -2000, 549000, 6804000, 100
with tempfile.TemporaryDirectory(prefix="terratet test ") as folder:
    # Boreholes, with all that the file tells of them: what a viewer misses there has stopped its drawing.
    holes = {f"H{x}-{y}": (x, y) for x in range(west + 2000, east, 4000) for y in range(south + 2000, north, 4000)}
    pathlib.Path(folder, "collar.csv").write_text("id,x,y,z\n" + "".join(f"{id},{x},{y},0\n" for id, (x, y) in holes.items()))
    pathlib.Path(folder, "log.csv").write_text("id,from,to,T\n" + "".join(
        f"{id},{depth},{depth + 500},{20 + depth / 40}\n" for id in holes for depth in (0, 500, 1000, 1500)))
    subprocess.run([terratet, "convert", "-q", "--boreholes", "collar.csv", "--log", "log.csv", "-s_srs", "EPSG:3067", "-te",
                    *map(str, (west, south, bottom, east, north, top)), "--lmin", "1500", "-co", "FRAME=enu", "globe.glb"],
                   cwd=folder, check=True)
    done = subprocess.run(["node", pathlib.Path(__file__).with_name("open_gltf.mjs"), "--modules", modules, "--page", "cesium",
                           pathlib.Path(folder, "globe.glb"), picture], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
found = json.loads(done.stdout)

grid, earth = osr.SpatialReference(), osr.SpatialReference()
grid.ImportFromEPSG(3067)
grid.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
grid3d = grid.Clone()
grid3d.PromoteTo3D()
earth.ImportFromEPSG(4978)
to_earth = osr.CoordinateTransformation(grid3d, earth)
worst = 0
for corner in itertools.product((west, east), (south, north), (bottom, top)):
    wanted = to_earth.TransformPoint(*map(float, corner))
    worst = max(worst, min(math.dist(wanted, place) for place in found["corners"]))
print(f"{found['viewer']}: {found['nodes']} nodes, corners of 24 km within {worst:.3f} m of PROJ")
assert worst < 0.5, worst
