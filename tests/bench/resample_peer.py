#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK's vtkResampleToImage on the mesh that resample_bench left in a folder, for comparison of time and values.

resample_bench 256 FOLDER
resample_peer.py FOLDER [CPU_SECONDS]     what resample_bench printed for one thread; prints the ratio

VTK may use as many threads as VTK_SMP_MAX_THREADS allows. Takes about half a minute at 256³.
"""
import sys
import time

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def exact(grid, p):
    """The field at p by looking into every cell whose box holds it."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    values = vtk_to_numpy(grid.GetPointData().GetArray("f"))
    corners = points[cells]
    for c in numpy.flatnonzero(((corners.min(axis=1) <= p) & (p <= corners.max(axis=1))).all(axis=1)):
        q = corners[c] - p
        last = numpy.linalg.solve((q[1:] - q[0]).T, -q[0])
        weights = numpy.concatenate([[1 - last.sum()], last])
        if weights.min() >= -1e-12:
            return weights @ values[cells[c]]
    return numpy.nan


def main():
    folder = sys.argv[1]
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(f"{folder}/mesh.vtu")
    reader.Update()
    grid = reader.GetOutput()
    ours = numpy.fromfile(f"{folder}/voxels.f32", numpy.float32)
    count = round(len(ours) ** (1 / 3))
    ours = ours.reshape(count, count, count)

    # VTK's samples stand on the corners of its bounds: those of our voxels' centres.
    low, high = numpy.array(grid.GetBounds()).reshape(3, 2).T
    half = (high - low) / count / 2
    resample = vtk.vtkResampleToImage()
    resample.SetInputDataObject(grid)
    resample.UseInputBoundsOff()
    resample.SetSamplingBounds(*numpy.stack([low + half, high - half], axis=1).ravel())
    resample.SetSamplingDimensions(count, count, count)
    start, cpu_start = time.perf_counter(), time.process_time()
    resample.Update()
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu_start
    data = resample.GetOutput().GetPointData()
    theirs = vtk_to_numpy(data.GetArray("f")).reshape(count, count, count).transpose(2, 1, 0)
    valid = vtk_to_numpy(data.GetArray("vtkValidPointMask")).reshape(count, count, count).transpose(2, 1, 0) > 0

    difference = numpy.where(valid, numpy.abs(ours - theirs), 0)
    print(f"vtkResampleToImage {seconds:.2f} s, {cpu:.2f} s of CPU, {ours.size / seconds / 1e6:.2f} Mvoxels/s")
    print(f"voxels without value: VTK {(~valid).sum()}, terratet {numpy.isnan(ours).sum()}")
    print(f"values: largest difference {difference.max():.1e}, {(difference > 1e-5).sum()} voxels above 1e-5, "
          f"values from {ours.min():.3f} to {ours.max():.3f}")
    worst = numpy.argsort(difference, axis=None)[-10:]
    index = numpy.stack(numpy.unravel_index(worst, ours.shape), axis=1)
    truth = numpy.array([exact(grid, low + (2 * i + 1) * half) for i in index])
    print(f"at the ten worst: VTK is off by {numpy.abs(theirs.flat[worst] - truth).max():.1e}, "
          f"terratet by {numpy.abs(ours.flat[worst] - truth).max():.1e}")
    if len(sys.argv) > 2:
        print(f"ratio to one thread of terratet: {cpu / float(sys.argv[2]):.1f}")


if __name__ == "__main__":
    main()
