# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the tables that read_bench left by pandas and by GDAL (its CSV driver, through OGR's Python and to numbers).

    read_peer.py FILE...

One thread each; CPU seconds, megabytes a second, and the peak of memory beside 8 bytes a number kept.
"""

import os
import resource
import sys
import time


def by_pandas(path):
    import pandas

    table = pandas.read_csv(path)
    return table.select_dtypes("number").size


def by_gdal(path):
    from osgeo import gdal, ogr

    ogr.UseExceptions()
    gdal.SetConfigOption("GDAL_NUM_THREADS", "1")
    import numpy

    dataset = gdal.OpenEx(path, gdal.OF_VECTOR, open_options=["AUTODETECT_TYPE=NO"])
    layer = dataset.GetLayer(0)
    fields = [i for i in range(layer.GetLayerDefn().GetFieldCount())
              if layer.GetLayerDefn().GetFieldDefn(i).GetName() != "BHID"]
    columns = [[] for _ in fields]
    for feature in layer:
        for column, field in zip(columns, fields):
            column.append(feature.GetFieldAsDouble(field))
    return sum(numpy.array(column).size for column in columns)


def measure(name, read, path):
    channel, out = os.pipe()
    child = os.fork()
    if child == 0:
        start = resource.getrusage(resource.RUSAGE_SELF)
        numbers = read(path)
        end = resource.getrusage(resource.RUSAGE_SELF)
        seconds = end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime
        os.write(out, f"{numbers} {seconds} {(end.ru_maxrss - start.ru_maxrss) * 1024}".encode())
        os._exit(0)
    os.waitpid(child, 0)
    numbers, seconds, peak = (float(word) for word in os.read(channel, 200).split())
    size = os.path.getsize(path) / 1e6
    print(f"{os.path.basename(path):20} {name:7} {seconds:7.2f} s {size / seconds:6.0f} MB/s  "
          f"peak {peak / 1e6:5.0f} MB: {peak / (8 * numbers):.2f} times", flush=True)


for file in sys.argv[1:]:
    with open(file, "rb") as warm:
        while warm.read(1 << 24):
            pass
    for peer in (("pandas", by_pandas), ("GDAL", by_gdal)):
        measure(*peer, file)
