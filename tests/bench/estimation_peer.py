#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Terratet's nearest, inverse distance and kriging beside scipy's cKDTree and R's gstat, in one run: same samples, same
places, same neighbourhoods; prints seconds of one thread, ratios, and the largest differences.

estimation_peer.py ESTIMATION_BENCH [SITES [QUERIES]]      needs python3-scipy and r-cran-gstat

Places come in random order for everyone. gstat's time is that of predict() alone, as R's system.time tells.
"""
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


def main():
    program, *sizes = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        out = subprocess.run([program, name, *sizes], check=True, capture_output=True, text=True).stdout
        print(out, end="")
        ours = {line.split()[0]: float(line.split("1 thread ")[1].split()[0]) for line in out.splitlines()}
        load = lambda file, columns: numpy.fromfile(folder / file, float).reshape(-1, columns)
        sites, places, values = load("sites.f64", 3), load("places.f64", 3), load("values.f64", 1)[:, 0]
        tree = cKDTree(sites)

        def nearest():
            return values[tree.query(places)[1]]

        def inverse_distance():
            distances, indices = tree.query(places, 12)
            weights = 1 / distances**2
            return (weights * values[indices]).sum(axis=1) / weights.sum(axis=1)

        def report(what, peer, seconds, mine, theirs):
            difference = numpy.abs(mine - theirs).max()
            print(f"{what:10} {peer} {seconds:.4f} s: {seconds / ours[what]:.1f} times terratet's; "
                  f"largest difference {difference:.1e}")

        for what, work in (("nearest", nearest), ("idw", inverse_distance)):
            seconds, result = median_cpu(work)
            report(what, "scipy", seconds, load(what + ".f64", 2)[:, 0], result)
        result = subprocess.run(["Rscript", "-"], input=GSTAT, cwd=folder, check=True, capture_output=True, text=True)
        gstat = load("gstat.f64", 2)
        mine = load("kriging.f64", 2)
        report("kriging", "gstat", float(result.stdout.split()[-1]), mine, gstat)


main()
