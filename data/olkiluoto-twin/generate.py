#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the synthetic twin of the Olkiluoto site (README.md says what is fact and what is ours).

    python3 generate.py [FOLDER]           the text files: standard library only, the same bytes everywhere
    python3 generate.py --gpkg [FOLDER]    fracture.gpkg as well, by ogr2ogr (Debian: gdal-bin)

Numbers are written with fixed decimals, far above the last bits in which mathematical libraries differ.
"""
import math
import pathlib
import random
import subprocess
import sys
import tempfile

# The site: 740 x 1000 x 1000 m in EPSG:3067 (ETRS89 / TM35FIN), heights in metres.
CENTRE = (525_500.0, 6_792_000.0)
HOLES = {  # collar east and north of the centre, height, azimuth and final inclination in degrees
    "OT-01": (-95.0, 70.0, 8.4, 200.0, 9.0),
    "OT-02": (60.0, 85.0, 7.1, 255.0, 6.0),
    "OT-03": (85.0, -60.0, 9.6, 330.0, 8.0),
    "OT-04": (-70.0, -95.0, 6.3, 35.0, 7.0),
}
SECTIONS, SECTION = 323, 2.6  # test sections a hole, and the length of one
STATION = 40.0  # between survey stations

# The fracture: 31 points along strike, 15 down dip, 20 m apart, one plane.
ALONG, DOWN, SPACING = 31, 15, 20.0
FRACTURE_MIDDLE = (-120.0, 40.0, -380.0)  # relative to the centre, and height
STRIKE_DEG, DIP_DEG = 25.0, 60.0  # right-hand rule: it dips to the east-south-east


def direction(azimuth_deg, inclination_deg):
    """Unit vector; inclination from the downward vertical."""
    azimuth, inclination = math.radians(azimuth_deg), math.radians(inclination_deg)
    return (math.sin(inclination) * math.sin(azimuth), math.sin(inclination) * math.cos(azimuth),
            -math.cos(inclination))


def survey(azimuth, inclination):
    """Stations (depth, azimuth, inclination): a hole that starts at 2 degrees and bends gently."""
    length = SECTIONS * SECTION
    count = int(length // STATION)
    for k in range(count + 1):
        share = k / count
        yield (k * STATION, round(azimuth + 12.0 * share + 1.5 * math.sin(3.0 * math.pi * share), 2),
               round(2.0 + (inclination - 2.0) * share, 2))


def positions(collar, stations, depths):
    """Minimum curvature, interpolated along the arcs; straight below the last station."""
    point, out, depths = collar, [], list(depths)
    legs = list(zip(stations, stations[1:] + [(math.inf,) + stations[-1][1:]]))
    for (top, az1, in1), (bottom, az2, in2) in legs:
        a, b = direction(az1, in1), direction(az2, in2)
        bend = math.acos(max(-1.0, min(1.0, sum(p * q for p, q in zip(a, b)))))

        def at(distance):
            if bend < 1e-6 or not math.isfinite(bottom):
                return tuple(p + distance * q for p, q in zip(point, a))
            angle, radius = bend * distance / (bottom - top), (bottom - top) / bend
            across = tuple((q - math.cos(bend) * p) / math.sin(bend) for p, q in zip(a, b))
            return tuple(o + radius * (math.sin(angle) * p + (1.0 - math.cos(angle)) * q)
                         for o, p, q in zip(point, a, across))

        out += [at(depth - top) for depth in depths if top <= depth < bottom]
        if math.isfinite(bottom):
            point = at(bottom - top)
    return out


def fracture_frame():
    """Middle, unit vectors along strike, down dip and along the normal."""
    strike, dip = math.radians(STRIKE_DEG), math.radians(DIP_DEG)
    along = (math.sin(strike), math.cos(strike), 0.0)
    down = (math.cos(strike) * math.cos(dip), -math.sin(strike) * math.cos(dip), -math.sin(dip))
    normal = (along[1] * down[2] - along[2] * down[1], along[2] * down[0] - along[0] * down[2],
              along[0] * down[1] - along[1] * down[0])
    middle = (CENTRE[0] + FRACTURE_MIDDLE[0], CENTRE[1] + FRACTURE_MIDDLE[1], FRACTURE_MIDDLE[2])
    return middle, along, down, normal


def fracture_points():
    middle, along, down, _ = fracture_frame()
    return [tuple(m + SPACING * ((i - (ALONG - 1) / 2) * a + (j - (DOWN - 1) / 2) * d)
                  for m, a, d in zip(middle, along, down)) for j in range(DOWN) for i in range(ALONG)]


def fracture_triangles():
    for j in range(DOWN - 1):
        for i in range(ALONG - 1):
            a = j * ALONG + i
            yield (a, a + 1, a + ALONG)
            yield (a + 1, a + ALONG + 1, a + ALONG)


def log10_conductivity(point, noise):
    """Decades of m/s: falls smoothly with depth, is raised by two decades and a half at the fracture, and ends at the
    limits of the tests, 1e-12 and 1e-8."""
    middle, along, down, normal = fracture_frame()
    offset = [p - m for p, m in zip(point, middle)]
    u, v, w = (sum(o * e for o, e in zip(offset, axis)) for axis in (along, down, normal))
    beyond = math.hypot(max(0.0, abs(u) - SPACING * (ALONG - 1) / 2), max(0.0, abs(v) - SPACING * (DOWN - 1) / 2))
    depth = -point[2]
    trend = -8.8 - 3.3 * (1.0 - math.exp(-max(depth, 0.0) / 420.0))
    wave = 0.25 * math.sin((point[0] - CENTRE[0]) / 90.0) * math.cos((point[1] - CENTRE[1]) / 110.0)
    raised = 2.5 * math.exp(-(w / 35.0) ** 2) * math.exp(-(beyond / 60.0) ** 2)
    return max(-12.0, min(-8.0, trend + wave + raised + noise))


def write(path, header, rows):
    path.write_bytes("".join(line + "\n" for line in [header, *rows]).encode())


def write_boreholes(folder):
    collars, surveys, logs = [], [], []
    for number, (hole, (east, north, height, azimuth, inclination)) in enumerate(HOLES.items()):
        collar = (CENTRE[0] + east, CENTRE[1] + north, height)
        collars.append(f"{hole},{collar[0]:.2f},{collar[1]:.2f},{collar[2]:.2f},{SECTIONS * SECTION:.1f}")
        stations = list(survey(azimuth, inclination))
        # Dip is negative downwards, as most borehole tables have it.
        surveys += [f"{hole},{d:.1f},{a % 360.0:.2f},{i - 90.0:.2f}" for d, a, i in stations]
        uniform, noise = random.Random(1000 + number).random, 0.0
        middles = [(k + 0.5) * SECTION for k in range(SECTIONS)]
        for k, point in enumerate(positions(collar, stations, middles)):
            noise = 0.9 * noise + 0.12 * (uniform() - 0.5)  # neighbouring sections resemble each other
            conductivity = 10.0 ** log10_conductivity(point, noise)
            logs.append(f"{hole},{k * SECTION:.1f},{(k + 1) * SECTION:.1f},{conductivity:.2e}")
    write(folder / "collar.csv", "hole,x,y,z,length", collars)
    write(folder / "survey.csv", "hole,depth,azimuth,dip", surveys)
    write(folder / "log.csv", "hole,from,to,K", logs)


def write_fracture(folder):
    points = fracture_points()
    write(folder / "fracture.csv", "x,y,z,fault", [f"{x:.3f},{y:.3f},{z:.3f},fracture" for x, y, z in points])
    lines = ["HEADER {", "name:fracture", "}", "GOCAD_ORIGINAL_COORDINATE_SYSTEM", 'NAME "ETRS89 / TM35FIN"',
             'AXIS_NAME "E" "N" "Z"', 'AXIS_UNIT "m" "m" "m"', "ZPOSITIVE Elevation",
             "END_ORIGINAL_COORDINATE_SYSTEM", "TFACE"]
    lines += [f"VRTX {n} {x:.3f} {y:.3f} {z:.3f}" for n, (x, y, z) in enumerate(points, 1)]
    lines += [f"TRGL {a + 1} {b + 1} {c + 1}" for a, b, c in fracture_triangles()]
    write(folder / "fracture.ts", "GOCAD TSurf 1", [*lines, "END"])


def write_geopackage(folder):
    points = [f"{x:.3f} {y:.3f} {z:.3f}" for x, y, z in fracture_points()]
    triangles = ",".join(f"(({points[a]},{points[b]},{points[c]},{points[a]}))" for a, b, c in fracture_triangles())
    with tempfile.TemporaryDirectory() as scratch:
        table = pathlib.Path(scratch) / "fracture.csv"
        table.write_text(f'name,WKT\nfracture,"TIN Z ({triangles})"\n')
        target = folder / "fracture.gpkg"
        target.unlink(missing_ok=True)
        subprocess.run(["ogr2ogr", "--config", "OGR_CURRENT_DATE", "2000-01-01T00:00:00Z", "-f", "GPKG", "-nln", "fracture",
                        "-nlt", "TINZ", "-a_srs", "EPSG:3067", "-oo", "GEOM_POSSIBLE_NAMES=WKT", "-oo",
                        "KEEP_GEOM_COLUMNS=NO", "-lco", "SPATIAL_INDEX=NO", str(target), str(table)], check=True)


def main(arguments):
    geopackage = "--gpkg" in arguments
    folders = [a for a in arguments if a != "--gpkg"]
    folder = pathlib.Path(folders[0]) if folders else pathlib.Path(__file__).resolve().parent
    write_boreholes(folder)
    write_fracture(folder)
    if geopackage:
        write_geopackage(folder)


if __name__ == "__main__":
    main(sys.argv[1:])
