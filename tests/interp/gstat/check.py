# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The stored reference numbers are what the installed gstat gives today: reference.R run anew, compared within 1e-9."""
import csv
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def rows(path):
    with open(path) as file:
        return list(csv.reader(file))


def same(a, b):
    if a == b:
        return True
    try:
        return abs(float(a) - float(b)) <= 1e-9
    except ValueError:
        return False


with tempfile.TemporaryDirectory() as folder:
    subprocess.run(["Rscript", HERE / "reference.R", folder], check=True, capture_output=True)
    for name in ("samples.csv", "places.csv", "kriging.csv", "variogram.csv"):
        stored, now = rows(HERE / name), rows(pathlib.Path(folder) / name)
        if len(stored) != len(now) or not all(
                len(a) == len(b) and all(map(same, a, b)) for a, b in zip(stored, now)):
            sys.exit(f"{name} differs from what gstat gives")
        print(f"{name}: {len(stored) - 1} rows agree")
