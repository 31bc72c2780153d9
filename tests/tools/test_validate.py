# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cross-validation from the command line: its table, its JSON, its charts."""
import json
import unittest
import xml.etree.ElementTree as xml

from terratet import Case, TWIN, twin_inputs

SITE = ["--boreholes", TWIN / "collar.csv", "--survey", TWIN / "survey.csv", "--log", TWIN / "log.csv",
        "--property", "K:log10:unit=m/s", "-s_srs", "EPSG:3067"]
FAST = ["--estimator", "idw", "--estimator", "kriging:model=exponential", "--estimator", "nearest"]


class Validate(Case):
    def test_table_json_and_charts_say_the_same(self):
        result = self.succeed("validate", *SITE, *FAST, "--report", "v.json", "--plot", "v.svg")
        report = json.loads((self.folder / "v.json").read_text())
        self.assertEqual(report["input"]["boreholes"], 4)
        [k] = report["properties"]
        self.assertEqual((k["name"], k["unit"], k["samples"]), ("K", "decades", 1292))
        self.assertEqual([e["estimator"] for e in k["estimators"]], ["idw", "kriging:model=exponential", "nearest"])
        for e in k["estimators"]:
            self.assertEqual(e["folds"], 4)
            self.assertEqual(e["count"] + e["without_value"], 1292)
            self.assertGreater(e["rmse"], e["mae"])
            self.assertGreaterEqual(e["within_1.96sd"], e["within_1sd"])
            self.assertEqual((e["calibration"]["boreholes"], e["calibration"]["samples"]), (4, 1292))
            row = [line for line in result.stdout.splitlines() if line.split()[:1] == [e["estimator"]]]
            self.assertEqual(row[0].split()[1], "%.4g" % e["rmse"])
            self.assertEqual(row[0].split()[5:7], ["%.1f" % (100 * e[k]) for k in ("within_1sd", "within_half_width")])
        self.assertIn("in 95 %: within", result.stdout)
        self.assertEqual([e["deviation"] for e in k["estimators"]], ["cross-validated", "kriging", "cross-validated"])
        variogram = k["variogram"]
        self.assertIn("ratio3=%r" % variogram["ratio3"], k["estimators"][1]["specification"])
        self.assertTrue(all(lag["pairs"] > 0 for lag in variogram["along"] + variogram["across"]))
        self.assertIn("Variogram, exponential: nugget", result.stdout)
        root = xml.parse(self.folder / "v.svg").getroot()
        titles = [text.text for text in root.iter("{http://www.w3.org/2000/svg}text")]
        for title in ("K: idw", "K: kriging:model=exponential", "measured K (decades)"):
            self.assertIn(title, titles)

    def test_a_model_is_validated_as_its_inputs_are_faults_apart(self):
        inputs = [a for a in twin_inputs() if a != "--faults" and not str(a).endswith("fracture.ts")]
        self.succeed("build", *inputs, "-o", "m.gpkg")
        of_model = self.succeed("validate", "m.gpkg", *FAST).stdout
        self.assertEqual(of_model, self.succeed("validate", *SITE, *FAST, "--threads", "1").stdout)
        with_fault = self.succeed("validate", *SITE, *FAST, "--faults", TWIN / "fracture.ts").stdout
        self.assertNotEqual(of_model, with_fault)

    def seam(self):
        """10 in a layer of two metres that dips to the east, cut by 16 holes 60 m apart."""
        with (self.folder / "collar.csv").open("w") as collars, (self.folder / "log.csv").open("w") as log:
            collars.write("hole,x,y,z,length\n")
            log.write("hole,from,to,au\n")
            for k in range(16):
                x, y = 60 * (k // 4) + 3 * (k % 3), 60 * (k % 4) + 2 * (k % 5)
                collars.write(f"H{k},{500000 + x},{6700000 + y},0,80\n")
                for d in range(80):
                    log.write(f"H{k},{d},{d + 1},{10 if 40 <= d + .5 - .05 * x < 42 else .1 + .001 * (7 * d % 40)}\n")
        return ["--boreholes", "collar.csv", "--log", "log.csv", "--property", "au", "-s_srs", "EPSG:3067"]

    def test_an_anisotropy_is_chosen_told_and_kept_and_none_switches_it_off(self):
        site = self.seam()
        built = self.succeed("build", *site, "--lmin", "30", "-o", "m.gpkg", "--report", "r.json")
        said = " ".join(built.stdout.split() + built.stderr.split())
        self.assertRegex(said, r"Estimator au: natural, across a plane that dips (2.[5-9]|3)[.\d]*° to \d+[.\d]*° at 0.02 of")
        chosen = json.loads((self.folder / "r.json").read_text())["estimator"]["chosen"]["au"]
        self.assertLess(chosen["rms"], 0.9 * chosen["rms_plain"])
        self.assertEqual((chosen["better_folds"], chosen["folds"]), (5, 5))
        self.assertIn("ratio3=0.02", chosen["estimator"])
        places = ["x,y,z"] + [f"{500000 + x},{6700000 + y},{-41 - .05 * x}" for x in range(10, 180, 9) for y in range(10, 180, 9)]
        (self.folder / "places.csv").write_text("\n".join(places) + "\n")

        def mean(*options):
            rows = self.succeed("query", "m.gpkg", "value", "places.csv", "-q", "--no-sd", *options).stdout.splitlines()[1:]
            return sum(float(row.split(",")[3]) for row in rows) / len(rows)
        own = mean()
        self.assertGreater(own, 9)
        self.assertEqual(mean("--estimator", "natural"), own)
        self.assertLess(mean("--estimator", "natural:anisotropy=none"), 4)

    def test_suggest_shows_what_was_tried_and_what_auto_takes(self):
        site = self.seam()
        result = self.succeed("validate", *site, "--estimator", "natural", "--suggest", "--report", "v.json")
        [au] = json.loads((self.folder / "v.json").read_text())["properties"]
        tried = {t["estimator"]: t for t in au["suggestion"]["tried"]}
        for method in ("natural", "natural:smooth", "kriging", "idw"):
            self.assertIn(method, tried)
            self.assertIn(f"  {method} ", result.stdout)
        taken = au["suggestion"]["estimator"]
        self.assertEqual(tried[taken]["rms"], min(t["rms"] for t in tried.values()))
        self.assertIn(f"Suggested (--estimator): {taken}", result.stdout)
        self.assertIn("    as natural:", result.stdout)

    def test_a_hard_horizon_parts_what_is_left_out_from_beyond_it(self):
        """1 above a contact and 10 below: without the other side every hole is found again exactly."""
        holes = [(x, y) for x in range(0, 500, 100) for y in range(0, 500, 100)]
        rows = ["x,y,z,K,rock"] + [f"{x},{y},{z},{1 if z > -50.5 else 10},{'clay' if z > -50.5 else 'sand'}"
                                   for x, y in holes for z in range(-100, 0, 4)]
        (self.folder / "samples.csv").write_text("\n".join(rows) + "\n")
        (self.folder / "contact.ts").write_text(
            "GOCAD TSurf 1\nHEADER {\nname:contact\n}\nTFACE\nVRTX 1 -900 -900 -50.5\nVRTX 2 1400 -900 -50.5\n"
            "VRTX 3 1400 1400 -50.5\nVRTX 4 -900 1400 -50.5\nTRGL 1 2 3\nTRGL 1 3 4\nEND\n")
        site = ["--samples", "samples.csv", "--surface", "contact.ts", "-s_srs", "EPSG:3067",
                "--property", "K", "--property", "rock:categorical"]

        def scores(*arguments):
            estimators = ["--estimator", "natural:anisotropy=none", "--estimator", "idw:anisotropy=none"]
            report = json.loads(self.succeed("validate", *arguments, *estimators, "--report", "-").stdout)
            self.assertEqual(report["input"]["faults"], 0)
            k, rock = (p["estimators"] for p in report["properties"])
            return [e["rmse"] for e in k], [e["accuracy"] for e in rock]

        for soft in (scores(*site), scores(*site, "--horizon", "soft")):
            self.assertGreater(min(soft[0]), 0.1)
            self.assertLess(max(soft[1]), 1)
        hard = scores(*site, "--horizon", "hard")
        self.assertLess(max(hard[0]), 1e-9)
        self.assertEqual(hard[1], [1, 1])
        mixed = scores(*site, "--horizon", "hard=rock")
        self.assertEqual((mixed[0], mixed[1]), (soft[0], hard[1]))
        self.fail_with(2, "validate", *site, "--horizon", "hard=Au", saying="there is no property 'Au'")
        self.fail_with(2, "validate", *site, "--horizon", "firm", saying="firm")

    def test_what_cannot_be_done_is_said(self):
        self.fail_with(2, "validate", *SITE, "--estimator", "krigging", saying="kriging")
        self.fail_with(2, "validate", *SITE, "--estimator", "kriging:range=-1", saying="above 0")
        self.fail_with(2, "validate", saying="no input")
        self.fail_with(3, "validate", "nothing.gpkg", saying="not found")


if __name__ == "__main__":
    unittest.main()
