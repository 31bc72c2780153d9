#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often the truth lies within what `terratet query` states, at holes that were held out: docs/estimators.md.

    coverage.py TERRATET synthetic|trend|grade|flat|faulted [options]
    coverage.py TERRATET COLLAR SURVEY LOG --property P --crs CRS [options]

A fifth of the holes, drawn with a seed, is taken away; a model of the rest is asked for values at their samples. Printed for each
estimator, as means over the seeds in percent: errors within one and within 1.96 stated deviations, within the stated half-width;
the same among the tenth estimated richest, of the faulted site within 50 m of a fault; and the half-width's lowest and highest of
all seeds. The named sites are made up: 130 deviated holes of a stationary field, of one with a strong trend, of a grade whose
errors grow with its level, of fields that have nothing to do with each other on the sides of a fault through everything and of one
that ends; and 60 vertical holes over 50 x 50 km.
"""
import argparse
import csv
import math
import os
import random
import sqlite3
import struct
import subprocess
import sys
import tempfile


def waves(rng, ranges, count=300):
    """A random field: a sum of cosines with the spectrum of an exponential covariance."""
    made = []
    for _ in range(count):
        scale = 1 / abs(rng.gauss(0, 1))
        made.append(([rng.gauss(0, 1) * scale / r for r in ranges], rng.uniform(0, 2 * math.pi)))
    return lambda p: math.sqrt(2 / count) * sum(math.cos(sum(k * x for k, x in zip(ks, p)) + phase) for ks, phase in made)


# Planes, their normals towards +x, each as far north as it goes: y below.
FAULTS = [((1000, 0, 0), (0.94, 0.1, 0.33), 9e9), ((500, 0, 0), (0.9, -0.2, 0.38), 1000)]


def off_fault(p, fault):
    """The signed distance from its plane."""
    through, normal, _ = fault
    size = math.sqrt(sum(n * n for n in normal))
    return sum(n * (c - t) for n, c, t in zip(normal, p, through)) / size


def near_fault(p, reach=50):
    return any(abs(off_fault(p, fault)) <= reach and p[1] <= fault[2] + reach for fault in FAULTS)


def write_faults(name):
    with open(name, "w", encoding="utf-8") as file:
        for number, (through, normal, last) in enumerate(FAULTS):
            file.write(f"GOCAD TSurf 1\nHEADER {{\nname:F{number}\n}}\nTFACE\n")
            for k, (y, z) in enumerate(((-900, -1400), (min(last, 2900), -1400), (min(last, 2900), 900), (-900, 900)), 1):
                x = through[0] - (normal[1] * (y - through[1]) + normal[2] * (z - through[2])) / normal[0]
                file.write(f"VRTX {k} {500000 + x!r} {6700000 + y!r} {z}\n")
            file.write("TRGL 1 2 3\nTRGL 1 3 4\nEND\n")


def deviated(kind):
    rng = random.Random(11)
    field = waves(rng, (150, 150, 40))
    if kind == "faulted":
        west, middle_block, east = (waves(rng, (150, 150, 40)) for _ in range(3))

        def field(p):
            if off_fault(p, FAULTS[0]) > 0:
                return 4 + east(p)
            # Where the second fault ends its sides run together.
            part = 1 / (1 + math.exp((p[1] - 1000) / 60)) if off_fault(p, FAULTS[1]) < 0 else 0
            return middle_block(p) + part * 3 * (1 + 0.3 * west(p))
    collars, surveys, logs = [], [], []
    for k in range(130):
        x, y, azimuth, dip = rng.uniform(0, 2000), rng.uniform(0, 2000), rng.uniform(0, 360), rng.uniform(50, 85)
        turn, lift, length = rng.gauss(0, 0.04), rng.gauss(-0.02, 0.02), rng.randrange(200, 500, 5)
        collars.append((f"H{k:03d}", "%.2f" % (500000 + x), "%.2f" % (6700000 + y), 0, length))
        p = [x, y, 0.0]
        for depth in range(0, length, 5):
            if depth % 25 == 0:
                surveys.append((f"H{k:03d}", depth, "%.2f" % (azimuth % 360), "%.2f" % dip))
            a, d = math.radians(azimuth), math.radians(dip)
            step = (math.sin(a) * math.cos(d), math.cos(a) * math.cos(d), -math.sin(d))
            middle = [c + 2.5 * s for c, s in zip(p, step)]
            value = field(middle) + 0.3 * rng.gauss(0, 1)
            value += (middle[0] - 1000) / 100 - middle[2] / 50 if kind == "trend" else 0
            value = math.exp(0.9 * value - 0.5) if kind == "grade" else value
            logs.append((f"H{k:03d}", depth, depth + 5, "%.5f" % value))
            p = [c + 5 * s for c, s in zip(p, step)]
            azimuth, dip = azimuth + 5 * turn, dip + 5 * lift
    return collars, surveys, logs


def flat():
    rng = random.Random(4)
    collars, logs = [], []
    for k in range(60):
        x, y = 500000 + 50000 * rng.random(), 6700000 + 50000 * rng.random()
        collars.append((f"H{k:02d}", "%.1f" % x, "%.1f" % y, 0, 200))
        logs += [(f"H{k:02d}", d, d + 5, "%.4f" % (0.2 + 0.1 * math.sin(x / 9000) * math.cos(d / 20))) for d in range(0, 200, 5)]
    return collars, [], logs


def write(name, head, rows):
    with open(name, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([head, *rows])


def read(name):
    with open(name, newline="", encoding="utf-8-sig") as file:
        rows = [row for row in csv.reader(file) if row]
    hole = next(i for i, n in enumerate(rows[0]) if n.strip().lower() in ("bhid", "hole", "holeid", "hole_id", "id", "borehole"))
    return rows[0], rows[1:], hole


def samples(model, name):
    """[(x, y, z, value)] of a model."""
    base = sqlite3.connect(model)
    out = []
    for blob, value in base.execute(f'SELECT geom, "{name}" FROM samples'):
        if value is not None:
            at = 8 + (0, 32, 48, 48, 64)[(blob[3] >> 1) & 7] + 5
            out.append((*struct.unpack_from("<3d", blob, at), value))
    return out


def share(told, limit):
    return 100 * sum(limit(t) for t in told) / len(told)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("terratet")
    parser.add_argument("site", nargs="+")
    parser.add_argument("--property", default="v")
    parser.add_argument("--crs", default="EPSG:3067")
    parser.add_argument("--lmin", default="500")
    parser.add_argument("--option", action="append", default=[], help="of build, as --option=--composite=20ft")
    parser.add_argument("--estimators", default="natural,idw,kriging")
    parser.add_argument("--seeds", default="7,1,2,3,4")
    a = parser.parse_args()
    program, files = os.path.abspath(a.terratet), [os.path.abspath(f) for f in a.site] if len(a.site) == 3 else []
    column, log10 = a.property.split(":")[0], ":log10" in a.property

    def run(*arguments):
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
        return done.stdout

    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        faulted = a.site[0] == "faulted"
        if faulted:
            write_faults("faults.ts")
            a.option += ["--faults=faults.ts", "--fault-spacing=200"]
        if not files:
            collars, surveys, logs = flat() if a.site[0] == "flat" else deviated(a.site[0])
            write("collar.csv", ("hole", "x", "y", "z", "length"), collars)
            write("log.csv", ("hole", "from", "to", column), logs)
            if surveys:
                write("survey.csv", ("hole", "depth", "azimuth", "dip"), surveys)
            files = ["collar.csv", "survey.csv" if surveys else "-", "log.csv"]
        tables = {kind: read(f) for kind, f in zip(("boreholes", "survey", "log"), files) if f != "-"}
        found = {e: [] for e in a.estimators.split(",")}
        for seed in map(int, a.seeds.split(",")):
            holes = sorted({row[tables["log"][2]] for row in tables["log"][1]})
            random.Random(seed).shuffle(holes)
            held = set(holes[:round(len(holes) / 5)])
            for part in ("known", "held"):
                inputs = []
                for kind, (head, rows, hole) in tables.items():
                    write(f"{part}_{kind}.csv", head, [r for r in rows if (r[hole] in held) == (part == "held")])
                    inputs += [f"--{kind}", f"{part}_{kind}.csv"]
                # The mesh does not matter: what is asked are the estimators.
                run("build", *inputs, "--property", a.property, "-s_srs", a.crs, *a.option, "--lmin", a.lmin, "--estimator",
                    "nearest", "-o", f"{part}.gpkg", "--overwrite", "-q")
            truth = samples("held.gpkg", column)
            write("places.csv", ("x", "y", "z"), [[repr(c) for c in s[:3]] for s in truth])
            scale = math.log10 if log10 else float
            for e in found:
                told = []
                for row, sample in zip(csv.DictReader(run("query", "known.gpkg", "value", "places.csv", "-q", "--estimator", e)
                                                      .splitlines()), truth):
                    if row[column] and row[column + "_sd"]:
                        value, sd = scale(float(row[column])), float(row[column + "_sd"])
                        told.append((value, abs(value - scale(sample[3])), sd, float(row.get(column + "_ci95", 1.96 * sd)),
                                     faulted and near_fault((sample[0] - 500000, sample[1] - 6700000, sample[2]))))
                some = [t for t in told if t[4]] if faulted else sorted(told, reverse=True)[:max(len(told) // 10, 1)]
                found[e].append([share(t, limit) for t in (told, some) for limit in (
                    lambda t: t[1] <= t[2], lambda t: t[1] <= 1.96 * t[2], lambda t: t[1] <= t[3])])
        print(f"| | in sd | in 1.96 sd | in 95 % | {'beside faults' if faulted else 'richest'}: in sd | in 1.96 sd | in 95 % | lowest … highest in 95 % |")
        for e, all_of in found.items():
            means = [sum(column) / len(all_of) for column in zip(*all_of)]
            widths = [one[2] for one in all_of]
            print(f"| `{e}` | " + " | ".join("%.0f" % m for m in means) + " | %.0f … %.0f |" % (min(widths), max(widths)))


main()
