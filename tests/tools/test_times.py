# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Values that change with time: one tessellation, a property a time, files and queries of a time."""
import csv
import json
import random
import re
import subprocess
import unittest

from terratet import Case

EXTENT = ["-s_srs", "local:m", "-te", *"0,0,-100,1000,1000,0".split(",")]


def places(count=120, seed=4):
    pick = random.Random(seed)
    return [(round(pick.uniform(0, 1000), 2), round(pick.uniform(0, 1000), 2), round(pick.uniform(-100, 0), 2))
            for _ in range(count)]


def head(place, time):
    x, y, z = place
    return 20 + 0.01 * x - 0.005 * y + 0.02 * z + 0.3 * time


class Times(Case):
    def samples(self, name, times, keep=lambda place, time: True, shuffle=0):
        rows = [(*place, time, head(place, i)) for place in places() for i, time in enumerate(times) if keep(place, time)]
        random.Random(shuffle).shuffle(rows)
        return self.write(name, "x,y,z,when,head\n" + "".join(f"{x},{y},{z},{t},{h}\n" for x, y, z, t, h in rows))

    def build(self, name="s.csv", *arguments):
        return self.succeed("build", "--samples", name, "--time-column", "when", *EXTENT, "--lmin", "60", "--estimator",
                            "linear", *arguments, "-o", "m.gpkg", "--overwrite", "--report", "r.json")

    def queried(self, *arguments):
        done = self.succeed("query", "m.gpkg", *arguments, "-q")
        return list(csv.DictReader(done.stdout.splitlines()))

    def test_each_time_has_its_own_values_on_one_tessellation(self):
        times = ["2020-01-01", "2020-02-01", "2021-01-01"]
        self.samples("s.csv", times)
        done = self.build()
        self.assertIn("3 times, 2020-01-01 to 2021-01-01", done.stderr)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["input"]["times"], times)
        self.assertEqual(report["input"]["samples"], 120)
        place = (500, 500, -50)
        at = "--at=" + ",".join(map(str, place))
        for i, time in enumerate(times):
            rows = self.queried("value", at, "--time", time)
            self.assertEqual([name for name in rows[0] if "@" in name], [])
            self.assertAlmostEqual(float(rows[0]["head"]), head(place, i), 6)
            self.assertIn("head_sd", rows[0])
        self.assertEqual([name for name in self.queried("value", at, "--no-sd")[0] if name in ("head@" + t for t in times)],
                         ["head@" + t for t in times])
        self.assertAlmostEqual(float(self.queried("nearest", at, "--time", times[2])[0]["distance"]),
                               float(self.queried("nearest", at)[0]["distance"]))
        above = [float(self.queried("region", "--above", "head=22", "--time", time)[0]["volume_above"]) for time in times]
        self.assertTrue(above[0] < above[1] < above[2])

    def test_a_time_that_is_not_there_is_said(self):
        self.samples("s.csv", [10, 9, 100])
        self.build()
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["input"]["times"], ["9", "10", "100"])
        self.assertTrue(self.queried("value", "--at=1,2,-3", "--time", "10.0"))  # numbers are numbers
        self.fail_with(2, "query", "m.gpkg", "value", "--at=1,2,-3", "--time", "11", "-q", saying="there are 9, 10, 100")
        self.write("t.csv", "x,y,z,cu\n0,0,0,1\n9,9,-9,2\n900,40,-8,3\n")
        self.fail_with(2, "build", "--samples", "t.csv", *EXTENT, "--time-column", "when", "-o", "n.gpkg", "-q", saying="when")
        self.succeed("build", "--samples", "t.csv", *EXTENT, "--lmin", "60", "-o", "n.gpkg")
        self.fail_with(2, "query", "n.gpkg", "value", "--at=1,2,-3", "--time", "11", "-q", saying="do not change")

    def test_the_order_of_rows_and_gaps_in_time_do_not_matter(self):
        bytes_of = []
        for shuffle in (1, 2):
            path = self.samples("s.csv", [1, 2], shuffle=shuffle,
                                keep=lambda place, time: time == 1 or place[0] < 500)
            path.write_text(path.read_text().replace("when,head", "when,Head (m)"))
            self.build("s.csv", "--property", "head:unit=m")
            self.succeed("export", "m.gpkg", "v.csv", "--overwrite")
            bytes_of.append((self.folder / "v.csv").read_bytes())
        self.assertEqual(*bytes_of)
        self.assertIn(b"head@1,head@2", bytes_of[0])
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["input"]["samples"], 120)

    def test_rows_without_a_time_or_of_a_place_and_time_again_are_told(self):
        path = self.samples("s.csv", [1, 2])
        first = path.read_text().splitlines()[1]
        path.write_text(path.read_text() + first + "\n" + "1,2,-3,,7\n")
        self.build()
        reasons = [entry["reason"] for entry in json.loads((self.folder / "r.json").read_text())["input"]["rejected"]]
        self.assertEqual(len(reasons), 2, reasons)
        self.assertTrue(any("line 2" in reason for reason in reasons))
        self.assertTrue(any("no time" in reason for reason in reasons))

    def test_logs_are_read_over_time_too(self):
        collars = [f"H{i},{100 + 200 * (i % 4)},{100 + 250 * (i // 4)},0\n" for i in range(12)]
        self.write("collar.csv", "hole,x,y,z\n" + "".join(collars))
        log = [f"H{i},{d},{d + 10},{year},{i + d / 10 + year - 2000}\n"
               for year in (2000, 2010) for i in range(12) for d in range(0, 90, 10)]
        self.write("log.csv", "hole,from,to,year,temp\n" + "".join(log))
        self.succeed("build", "--boreholes", "collar.csv", "--log", "log.csv", "--time-column", "year", *EXTENT, "--lmin", "30",
                     "--estimator", "nearest", "-o", "m.gpkg", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())["input"]
        self.assertEqual((report["samples"], report["times"], report["rejected"]), (108, ["2000", "2010"], []))
        old, new = (float(self.queried("value", "--at=100,100,-5", "--time", t)[0]["temp"]) for t in ("2000", "2010"))
        self.assertEqual((old, new), (0, 10))

    def test_paraview_gets_a_file_a_step(self):
        self.samples("s.csv", ["2020-01-01", "2020-01-11"])
        self.build()
        self.succeed("export", "m.gpkg", "t.pvd")
        text = (self.folder / "t.pvd").read_text()
        steps = re.findall(r'timestep="([^"]+)" name="([^"]+)" file="([^"]+)"', text)
        self.assertEqual([(float(b[0]) - float(a[0])) for a, b in zip(steps, steps[1:])], [10])
        self.assertEqual([step[1] for step in steps], ["2020-01-01", "2020-01-11"])
        for _, _, file in steps:
            content = (self.folder / file).read_bytes()
            self.assertIn(b'Name="head"', content)
            self.assertNotIn(b"head@", content)
        self.assertNotEqual(*((self.folder / step[2]).read_bytes() for step in steps))

    def test_netcdf_has_an_axis_of_times_and_is_read_back_by_them(self):
        times = ["2020-01-01", "2020-01-11", "2021-01-01"]
        self.samples("s.csv", times)
        self.build()
        self.succeed("export", "m.gpkg", "t.nc", "-tr", "50", "-q")
        script = ("import netCDF4, json, sys, numpy; d = netCDF4.Dataset(sys.argv[1]); t = d['time']; h = d['head'];"
                  "print(json.dumps([list(h.dimensions), [str(x)[:10] for x in netCDF4.num2date(t[:], t.units, t.calendar)],"
                  "t.standard_name, t.axis, list(d['extrapolation'].dimensions), [k for k in d.variables if '2020' in k],"
                  "[[float(h[s, k, j, i]) for s in range(3)] for k, j, i in ((0, 5, 5), (1, 10, 3))],"
                  "[[float(d['x'][i]), float(d['y'][j]), float(d['z'][k])] for k, j, i in ((0, 5, 5), (1, 10, 3))]]))")
        python = "/usr/bin/python3"  # Debian's netCDF4
        if subprocess.run([python, "-c", "import netCDF4"], capture_output=True).returncode != 0:
            self.skipTest("netCDF4 is not installed")
        done = subprocess.run([python, "-c", script, self.folder / "t.nc"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        dimensions, dates, standard_name, axis, plain, own, values, centers = json.loads(done.stdout)
        self.assertEqual(dimensions, ["time", "z", "y", "x"])
        self.assertEqual((dates, standard_name, axis), (times, "time", "T"))
        self.assertEqual((plain, own), (["z", "y", "x"], []))
        for of_times, center in zip(values, centers):
            for i, value in enumerate(of_times):
                self.assertAlmostEqual(value, head(center, i), 3)
        self.succeed("export", "t.nc", "back.csv", "-q")
        with open(self.folder / "back.csv", newline="") as file:
            row = next(r for r in csv.DictReader(file) if r["head@2020-01-11"])
        place = tuple(float(row[a]) for a in "XYZ")
        for i, time in enumerate(times):
            self.assertAlmostEqual(float(row["head@" + time]), head(place, i), 3)

    def test_times_that_are_no_dates_are_numbers_of_the_axis(self):
        self.samples("s.csv", [10, 2, 7.5])
        self.build()
        self.succeed("export", "m.gpkg", "t.nc", "-tr", "100", "-q")
        told = json.loads(subprocess.run(["gdalinfo", "-json", f'NETCDF:"{self.folder / "t.nc"}":head'],
                                         capture_output=True, text=True, check=True).stdout)
        self.assertEqual(told["metadata"][""]["NETCDF_DIM_time_VALUES"], "{2,7.5,10}")
        self.assertEqual(told["metadata"][""]["time#labels"], "2;7.5;10")


if __name__ == "__main__":
    unittest.main()
