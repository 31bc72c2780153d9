#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The natural neighbour family beside what is commonly used instead, on a regular grid of places, in one run:
SciPy's cKDTree with inverse distances over 12 neighbours, and its local RBF over 30.

    natural_neighbour_peer.py BENCH [SITES=100000] [GRID=46]    BENCH: the natural_neighbour_bench program

One thread each, its CPU time, medians of 3 runs. Times are for weights and values here, for weights there.
"""
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import cKDTree


def rate(work, count, repeats=3):
    seconds = []
    for _ in range(repeats):
        start = time.process_time()
        work()
        seconds.append(time.process_time() - start)
    return count / sorted(seconds)[len(seconds) // 2]


def main(bench, sites=100_000, grid=46):
    rng = np.random.default_rng(1)
    points = rng.uniform(0, 1000, (int(sites), 3))
    values = rng.uniform(size=len(points))
    axis = np.linspace(50, 950, int(grid))
    queries = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)

    tree = cKDTree(points)

    def inverse_distance():
        distance, index = tree.query(queries, k=12, workers=1)
        weight = 1 / distance**2
        return (weight * values[index]).sum(axis=1) / weight.sum(axis=1)

    some = queries[:: max(1, len(queries) // 20_000)]
    rbf = RBFInterpolator(points, values, neighbors=30)
    rates = {"cKDTree IDW, k = 12": rate(inverse_distance, len(queries)),
             "RBFInterpolator, 30 neighbours": rate(lambda: rbf(some), len(some))}
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "sites.bin"
        file.write_bytes(points.tobytes() + queries.tobytes())
        output = subprocess.run([bench, "--sites", file, str(len(points))], check=True, capture_output=True, text=True)
    ours = {name: float(number) for name, number in (line.split() for line in output.stdout.splitlines())}

    print(f"{len(points)} uniform sites, {len(queries)} queries on a grid\n")
    print("| | queries/s | " + " | ".join(rates) + " |\n|---|---|" + "---|" * len(rates))
    for name, number in rates.items():
        print(f"| {name} | {number / 1000:.1f} k |" + " |" * len(rates))
    for name, number in ours.items():
        print(f"| `{name}` | {number / 1000:.1f} k | " + " | ".join(f"{number / r:.1f}" for r in rates.values()) + " |")


if __name__ == "__main__":
    main(*sys.argv[1:])
