#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Terratet's nearest, inverse distance and kriging beside scipy's cKDTree and R's gstat, in one run: same samples, same
places, same neighbourhoods; prints seconds of one thread, ratios, and the largest differences.

estimation_peer.py ESTIMATION_BENCH [SITES [QUERIES]]      needs python3-scipy and r-cran-gstat

Ours and scipy take turns, five rounds of medians of three, so that both meet what else the machine does. Places come in
random order for everyone. gstat's time is that of predict() alone, as R's system.time tells.
"""
import collections
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy
from scipy.spatial import cKDTree

GSTAT = """
suppressPackageStartupMessages({library(sp); library(gstat)})
read <- function(name, columns) {
  matrix(readBin(name, "double", 1e9), ncol = columns, byrow = TRUE)
}
sites <- as.data.frame(read("sites.f64", 3)); names(sites) <- c("x", "y", "z")
sites$v <- read("values.f64", 1)[, 1]
places <- as.data.frame(read("places.f64", 3)); names(places) <- c("x", "y", "z")
coordinates(sites) <- ~x + y + z; coordinates(places) <- ~x + y + z
model <- gstat(NULL, "v", v ~ 1, sites, nmax = 24, model = vgm(1, "Exp", 150, 0.1))
seconds <- system.time(result <- predict(model, places, debug.level = 0))["user.self"]
writeBin(as.vector(rbind(result$v.pred, result$v.var)), "gstat.f64")
cat(seconds, "\n")
"""


def median_cpu(work, runs=3):
    seconds = []
    for _ in range(runs):
        start = time.process_time()
        result = work()
        seconds.append(time.process_time() - start)
    return statistics.median(seconds), result


def ask_ours(program, folder, sizes, seconds):
    out = subprocess.run([program, folder, *sizes], check=True, capture_output=True, text=True).stdout
    for line in out.splitlines():
        seconds[line.split()[0]].append(float(line.split("1 thread ")[1].split()[0]))
    return out


def main():
    program, *sizes = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        ours, theirs = collections.defaultdict(list), collections.defaultdict(list)
        load = lambda file, columns: numpy.fromfile(folder / file, float).reshape(-1, columns)
        out = ask_ours(program, name, sizes, ours)
        print(out, end="")
        sites, places, values = load("sites.f64", 3), load("places.f64", 3), load("values.f64", 1)[:, 0]
        tree = cKDTree(sites)

        def nearest():
            return values[tree.query(places)[1]]

        def inverse_distance():
            distances, indices = tree.query(places, 12)
            weights = 1 / distances**2
            return (weights * values[indices]).sum(axis=1) / weights.sum(axis=1)

        def report(what, peer, mine, result):
            own, other = statistics.median(ours[what]), statistics.median(theirs[what])
            difference = numpy.abs(mine - result).max()
            print(f"{what:10} {own:.4f} s, {peer} {other:.4f} s: {other / own:.1f} times; "
                  f"largest difference {difference:.1e}")

        results = {}
        for turn in range(5):
            if turn > 0:
                ask_ours(program, name, sizes, ours)
            for what, work in (("nearest", nearest), ("idw", inverse_distance)):
                seconds, results[what] = median_cpu(work)
                theirs[what].append(seconds)
        for what, result in results.items():
            report(what, "scipy", load(what + ".f64", 2)[:, 0], result)
        result = subprocess.run(["Rscript", "-"], input=GSTAT, cwd=folder, check=True, capture_output=True, text=True)
        gstat = load("gstat.f64", 2)
        mine = load("kriging.f64", 2)
        theirs["kriging"].append(float(result.stdout.split()[-1]))
        report("kriging", "gstat", mine, gstat)


main()
