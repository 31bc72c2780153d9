#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads files of voxels with programs that are not ours and compares them with the tessellation in a VTU file of the
same model: python3-netcdf4 for .nc, GDAL for .tif, Python's csv for block models.

check_voxels.py MESH.vtu FILE...

Random voxels of each field must agree to 1e-5 with linear interpolation in the mesh (in gaps, on one side of the fault),
the region with the cell's own.
"""
import csv
import pathlib
import re
import sys

import netCDF4
import numpy
from osgeo import gdal

from check_vdb import Mesh, plain

gdal.UseExceptions()


def from_netcdf(path):
    """{field: (x, y, z, values)} of the voxels with a value."""
    fields = {}
    with netCDF4.Dataset(path) as file:
        x, y, z = (file[axis][:].data for axis in "xyz")
        for name, variable in file.variables.items():
            if variable.ndim == 3:
                values = variable[:]
                k, j, i = numpy.nonzero(~numpy.ma.getmaskarray(values))
                fields[variable.long_name] = x[i], y[j], z[k], values.data[k, j, i]
    return fields


def from_geotiff(path):
    file = gdal.Open(str(path))
    x0, dx, _, y0, _, dy = file.GetGeoTransform()
    found = {}
    for number in range(1, file.RasterCount + 1):
        band = file.GetRasterBand(number)
        z = float(re.match(r"z=(\S+)", band.GetDescription()).group(1))
        assert z == float(band.GetMetadataItem("Z"))
        values = band.ReadAsArray()
        row, column = numpy.nonzero(~numpy.isnan(values))
        found.setdefault(band.GetMetadataItem("PROPERTY"), []).append(
            (x0 + (column + 0.5) * dx, y0 + (row + 0.5) * dy, numpy.full(len(row), z), values[row, column]))
    return {name: [numpy.concatenate(part) for part in zip(*slices)] for name, slices in found.items()}


def from_blocks(path, classes):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    places = numpy.array([[float(row[axis]) for axis in "XYZ"] for row in rows])
    order = numpy.lexsort(places.T)
    assert (order == numpy.arange(len(rows))).all(), "rows are not in the order x, y, z"
    fields = {}
    for name in rows[0]:
        if name not in ("X", "Y", "Z", "DX", "DY", "DZ"):
            given = [i for i, row in enumerate(rows) if row[name] != ""]
            values = [classes[name].index(rows[i][name]) if name in classes else float(rows[i][name]) for i in given]
            fields[name] = *places[given].T, numpy.array(values)
    return fields


def check(fields, mesh, path):
    wanted = [*mesh.names, "region"]
    assert sorted(fields) == sorted(wanted), f"{path}: fields {sorted(fields)} for {sorted(wanted)}"
    random = numpy.random.default_rng(7)
    for name, (x, y, z, values) in fields.items():
        for n in random.choice(len(values), size=25, replace=False):
            p = numpy.array([x[n], y[n], z[n]])
            candidates = mesh.cells_at(p)
            assert candidates, f"{path}: {name} has a value at {p}, in no cell"
            if name == "region":
                assert any(mesh.region[c] in (-1, values[n]) for c, _ in candidates), f"{path}: region {values[n]} at {p}"
                continue
            expected = [value for c, weights in candidates for value in mesh.values_at(name, c, weights, p)]
            if mesh.scales[name] == "categorical":
                assert values[n] in expected, f"{path}: {name} is {values[n]} at {p}, not {expected}"
            elif mesh.scales[name] == "log10":
                assert min(abs(numpy.log10(values[n]) - numpy.log10(e)) for e in expected) < 1e-5, f"{path}: {name} at {p}"
            else:
                spread = max(numpy.ptp(values), abs(values[n]))
                assert min(abs(values[n] - e) for e in expected) <= 1e-5 * spread, f"{path}: {name} at {p}"
        print(f"{path}: {name!r} {len(values)} voxels")


def main():
    mesh = Mesh(sys.argv[1])
    for path in map(pathlib.Path, sys.argv[2:]):
        fields = (from_netcdf(path) if path.suffix == ".nc" else from_geotiff(path) if path.suffix == ".tif"
                  else from_blocks(path, mesh.classes))
        check(fields, mesh, path.name)


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"check_voxels.py: {error}")
