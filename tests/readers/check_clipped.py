#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a clipped mesh with VTK and measures it: is it whole, are its cells good, are its values those of the model?

check_clipped.py FILE.vtu --extent XMIN YMIN ZMIN XMAX YMAX ZMAX --lmin L [--whole WHOLE.vtu] [--open]

Volumes are positive and add up to the extent's; every facet belongs to two cells on opposite sides of it or is on the extent (with
--open, for models that end at a ground, a wall or a fault without width, elsewhere too). With the mesh that was clipped: its samples
are all there with their values, and values elsewhere are those of its linear field. Prints figures; of shapes those outside the gaps.
"""
import argparse
import collections
import json

import numpy
from vtk.util.numpy_support import vtk_to_numpy

from check_vtu import read, strings, tetrahedra, volumes

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
OUTWARD = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))
PROBES = 400
ROUNDING = 2e-9  # of coordinates that are true ones


def dihedral(p):
    smallest = numpy.full(len(p), 180.0)
    for i, j in EDGES:
        k, m = sorted({0, 1, 2, 3} - {i, j})
        along = p[:, j] - p[:, i]
        a, b = numpy.cross(along, p[:, k] - p[:, i]), numpy.cross(along, p[:, m] - p[:, i])
        sine = numpy.linalg.norm(numpy.cross(a, b), axis=1)
        smallest = numpy.minimum(smallest, numpy.degrees(numpy.arctan2(sine, (a * b).sum(axis=1))))
    return smallest


def signed(p):
    return numpy.einsum("ij,ij->i", numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0])


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


def check_facets(points, cells, lo, hi, open_elsewhere):
    sides = collections.defaultdict(list)
    for k in OUTWARD:
        facets = cells[:, k]
        order = numpy.argsort(facets, axis=1)
        odd = (order[:, 0] > order[:, 1]) ^ (order[:, 0] > order[:, 2]) ^ (order[:, 1] > order[:, 2])
        for key, turned in zip(map(tuple, numpy.sort(facets, axis=1)), odd):
            sides[key].append(turned)
    for key, both in sides.items():
        assert len(both) <= 2, f"facet {key} has {len(both)} cells"
        if len(both) == 2:
            assert both[0] != both[1], f"two cells on the same side of facet {key}"
        elif not open_elsewhere:
            corners = points[list(key)]
            assert any((abs(corners[:, axis] - face[axis]) <= ROUNDING).all() for axis in range(3) for face in (lo, hi)), f"facet {key} is open"


def check_values(points, grid, whole):
    """Samples by position; of the rest some, each against the cell of the whole mesh that it is in."""
    there = vtk_to_numpy(whole.GetPoints().GetData())
    cells = tetrahedra(whole)
    gap = array(whole.GetCellData(), "fault") >= 0
    lo, hi = points.min(axis=0), points.max(axis=0)
    names = strings(grid, "Properties")
    scales = strings(grid, "PropertyScales")
    at = {tuple(p): i for i, p in enumerate(points)}
    is_sample = (array(whole.GetPointData(), "role") == 0) & (there >= lo).all(axis=1) & (there <= hi).all(axis=1)
    for name in names:
        here, before = array(grid.GetPointData(), name), array(whole.GetPointData(), name)
        for v in numpy.flatnonzero(is_sample):
            assert tuple(there[v]) in at, f"the sample at {there[v]} is gone"
            assert numpy.array_equal(here[at[tuple(there[v])]], before[v], equal_nan=True), f"{name} changed at a sample"
    known = set(map(tuple, there))
    fresh = [i for i, p in enumerate(points) if tuple(p) not in known]
    worst, compared = 0.0, 0
    p = there[cells]
    low, high = p.min(axis=1), p.max(axis=1)
    for i in fresh[::max(1, len(fresh) // PROBES)]:
        x = points[i]
        near = numpy.flatnonzero((low <= x + 1e-6).all(axis=1) & (high >= x - 1e-6).all(axis=1))
        whole_volume = signed(p[near])
        weights = numpy.stack([signed(numpy.where(numpy.arange(4)[None, :, None] == k, x, p[near])) for k in range(4)], 1)
        weights /= whole_volume[:, None]
        inside = (weights > -1e-9).all(axis=1)
        if gap[near[inside]].any() or not inside.any():
            continue
        cell, weight = near[inside][0], weights[inside][0]
        for name, scale in zip(names, scales):
            if scale == "categorical":
                continue
            to = numpy.log10 if scale == "log10" else numpy.asarray
            expected = to(array(whole.GetPointData(), name)[cells[cell]]) @ weight
            worst = max(worst, abs(to(array(grid.GetPointData(), name)[i]) - expected))
        compared += 1
    return len(fresh), compared, worst


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--extent", nargs=6, type=float, required=True)
    parser.add_argument("--lmin", type=float, required=True)
    parser.add_argument("--whole")
    parser.add_argument("--open", action="store_true")
    given = parser.parse_args()
    grid = read(given.file)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = tetrahedra(grid)
    lo, hi = numpy.reshape(given.extent, (2, 3))
    assert (points >= lo - ROUNDING).all() and (points <= hi + ROUNDING).all(), "points outside the extent"
    centred = points - (lo + hi) / 2
    volume = volumes(centred, cells)
    assert (volume > 0).all(), f"{(volume <= 0).sum()} cells without volume"
    error = abs(volume.sum() / (hi - lo).prod() - 1)
    assert given.open or error < 1e-12, f"volumes do not add up to the extent's: {error}"
    check_facets(points, cells, lo, hi, given.open)
    judged = array(grid.GetCellData(), "fault") < 0
    p = centred[cells[judged]]
    angle = dihedral(p)
    assert numpy.allclose(angle, array(grid.GetCellData(), "dihedral")[judged], rtol=0, atol=0.01), "other angles are written"
    edge = numpy.min([numpy.linalg.norm(p[:, i] - p[:, j], axis=1) for i, j in EDGES], axis=0)
    result = {"cells": len(angle), "volume_error": error, "min": angle.min(), "p1": numpy.percentile(angle, 1),
              "below_1_deg": int((angle < 1).sum()), "below_10_deg": int((angle < 10).sum()), "edge_min": edge.min(),
              "short_edges": int((edge < given.lmin / 10).sum())}
    if given.whole:
        result["new_points"], result["compared"], result["off"] = check_values(points, grid, read(given.whole))
    print(json.dumps(result))


if __name__ == "__main__":
    main()
