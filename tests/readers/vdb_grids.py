# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The grids of floats in a VDB file. Debian's pyopenvdb has no grids of integers, and lists none of a file that has one."""
import subprocess

import pyopenvdb


def float_grids(path):
    """{name: grid}"""
    listed = subprocess.run(["vdb_print", path], capture_output=True, text=True, check=True).stdout
    rows = [line.split() for line in listed.splitlines()]
    return {row[0]: pyopenvdb.read(path, row[0]) for row in rows if row[1] == "float"}
