# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""terratet query MODEL value POINTS: a row for a row, in order, with the model's own estimator."""
import csv
import io
import json
import math
import sqlite3
import subprocess
import unittest

from terratet import Case, PROGRAM, TWIN, twin_inputs


class Query(Case):
    def setUp(self):
        super().setUp()
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")

    def ask(self, text, *arguments):
        points = self.write("points.csv", text)
        return list(csv.reader(io.StringIO(self.succeed("query", "m.gpkg", "value", points, *arguments).stdout)))

    def samples(self):
        """Positions and values of the samples that are vertices, from the model's export."""
        self.succeed("export", "m.gpkg", "v.csv", "--overwrite")
        with open(self.folder / "v.csv") as file:
            return [row for row in csv.DictReader(file) if row["role"] == "sample"]

    def test_on_samples_their_values_come_back_with_no_deviation(self):
        samples = self.samples()
        rows = self.ask("x,y,z\n" + "".join(f"{s['x']},{s['y']},{s['z']}\n" for s in samples))
        self.assertEqual(rows[0], ["x", "y", "z", "K", "K_sd", "K_ci95", "K_extrapolation"])
        self.assertEqual([row[3:] for row in rows[1:]], [[s["K"], "0", "0", "0"] for s in samples])

    def test_rows_stay_in_order_with_all_their_columns_and_bad_ones_are_empty(self):
        text = 'name,Easting,Northing,RL,"a, b"\n"x, ""y""",525500,6792000,-200,1\nbad,,6792000,-200,\nlast,525510,6792010,-210,ü\n'
        rows = self.ask(text)
        self.assertEqual(rows[0], ["name", "Easting", "Northing", "RL", "a, b", "K", "K_sd", "K_ci95", "K_extrapolation"])
        self.assertEqual([row[:5] for row in rows[1:]], list(csv.reader(io.StringIO(text)))[1:])
        self.assertEqual(rows[2][5:], ["", "", "", ""])
        for row in (rows[1], rows[3]):
            self.assertGreater(float(row[5]), 0)
            self.assertGreater(float(row[6]), 0)
            self.assertGreater(float(row[7]), float(row[6]))
        piped = subprocess.run([PROGRAM, "query", "m.gpkg", "value", "-"], input=text, cwd=self.folder, text=True,
                               capture_output=True, check=True)
        self.assertEqual(list(csv.reader(io.StringIO(piped.stdout))), rows)

    def test_values_are_those_of_inverse_distance_by_hand(self):
        """Beyond the fracture's reach nothing is hidden: K from the twelve nearest of all samples, in decades."""
        self.succeed("build", *[a for a in twin_inputs() if a != "--faults" and not str(a).endswith(".ts")], "-o", "n.gpkg")
        listing = subprocess.run(["ogr2ogr", "-f", "CSV", "/vsistdout/", self.folder / "n.gpkg", "samples", "-lco",
                                  "GEOMETRY=AS_XYZ"], capture_output=True, text=True, check=True).stdout
        samples = [tuple(float(row[c]) for c in "XYZK") for row in csv.DictReader(io.StringIO(listing))]
        place = (525480.0, 6791900.0, -333.0)
        near = sorted((math.dist(place, s[:3]), s[3]) for s in samples)[:12]
        weights = [1 / d**2 for d, _ in near]
        expected = 10 ** (sum(w * math.log10(k) for w, (_, k) in zip(weights, near)) / sum(weights))
        points = self.write("p.csv", "x,y,z\n%r,%r,%r\n" % place)
        row = self.succeed("query", "n.gpkg", "value", points).stdout.splitlines()[1].split(",")
        self.assertAlmostEqual(float(row[3]) / expected, 1, places=9)

    def test_other_estimators_and_no_deviations_on_request(self):
        text = "x,y,z\n525500,6792000,-200\n"
        own, other, plain = (self.ask(text, *a)[1] for a in ([], ["--estimator", "nearest"], ["--no-sd"]))
        self.assertNotEqual(own[3], other[3])
        self.assertEqual(plain, [*own[:4], "", "", own[6]])
        for threads in ("1", "3"):
            self.assertEqual(self.ask(text, "--threads", threads)[1], own)

    def test_factors_found_by_a_build_are_stored_and_used_and_otherwise_found_there_and_then(self):
        text = "x,y,z\n525500,6792000,-200\n525450,6791950,-400\n"
        self.succeed("build", *twin_inputs(), "--uncertainty", "--report", "r.json", "-o", "u.gpkg")
        report = json.loads((self.folder / "r.json").read_text())
        known = report["estimator"]["uncertainty"]["K"]
        self.assertEqual((known["boreholes"], known["samples"]), (4, 1292))
        self.assertIn("uncertainty:sd=%r:half_width=%r:" % (known["factor_sd"], known["factor_95"]),
                      json.loads(self.succeed("info", "--json", "u.gpkg").stdout)["estimator"])
        points = self.write("p.csv", text)
        asked = lambda model, *a: list(csv.reader(io.StringIO(self.succeed("query", model, "value", points, *a).stdout)))
        self.assertEqual(asked("u.gpkg"), asked("m.gpkg"))
        # Its own estimator, named: found anew, and the same; another's are others.
        name = report["estimator"]["name"]
        self.assertEqual(asked("u.gpkg", "--estimator", name), asked("m.gpkg"))
        self.assertNotEqual(asked("u.gpkg", "--estimator", "nearest")[1][4:6], asked("m.gpkg")[1][4:6])
        with sqlite3.connect(self.folder / "u.gpkg") as base:
            [[text]] = base.execute("SELECT value FROM terratet_meta WHERE key = 'estimator'")
        self.assertIn(" of K", text)

    def test_a_name_that_the_table_has_already_is_not_used_twice(self):
        rows = self.ask("x,y,K,z,K_sd\n525500,6792000,1e-9,-200,u\n")
        self.assertEqual(rows[0], ["x", "y", "K", "z", "K_sd", "K_estimate", "K_sd_estimate", "K_ci95", "K_extrapolation"])
        self.assertEqual(rows[1][:5], ["525500", "6792000", "1e-9", "-200", "u"])
        self.assertEqual(rows[1][5:], self.ask("x,y,z\n525500,6792000,-200\n")[1][3:])

    def test_what_cannot_be_done_is_said(self):
        points = self.write("p.csv", "a,b\n1,2\n")
        self.fail_with(2, "query", "m.gpkg", "values", points, saying="did you mean value?")
        self.fail_with(2, "query", "m.gpkg", "value", points, "--side", "west", saying="'west' is neither + nor -")
        self.fail_with(3, "query", "m.gpkg", "value", points, saying="no column for x")
        self.fail_with(3, "query", "m.gpkg", "value", "none.csv", saying="none.csv")


if __name__ == "__main__":
    unittest.main()
