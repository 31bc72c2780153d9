# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The main job from end to end, at a coarse resolution."""
import csv
import json
import math
import unittest

from terratet import Case, TWIN, twin_inputs

REPORT_KEYS = {
    "terratet": None,
    "input": {"boreholes", "samples", "faults", "rejected"},
    "frame": {"crs", "origin"},
    "defaults": set(),
    "preprocess": {"samples_kept", "samples_deleted", "samples_near_faults", "seeds", "domain_vertices"},
    "faults": None,
    "initial": {"vertices", "tetrahedra", "skinny_percent", "flat_percent", "bad_percent"},
    "refine": {"inserted", "moved", "removed", "bound", "skipped"},
    "final": {"vertices", "tetrahedra", "gap_tetrahedra", "bad_percent", "dihedral_deg", "edge_m", "fault_crossing_edges",
              "delaunay", "regions", "below"},
    "regions": None,
    "fidelity": {"K"},
    "estimator": {"name", "options", "fallbacks"},
    "outputs": None,
    "seconds": {"read", "density", "boundary", "refine", "estimate", "write", "total"},
    "peak_memory_bytes": None,
}


class Twin(Case):
    def test_convert_writes_every_format_and_a_complete_report(self):
        outputs = ["m.gpkg", "m.vtu", "m.glb", "m.gltf", "m.vdb", "m.csv"]
        result = self.succeed("convert", *twin_inputs(), "--report", "report.json", *outputs)
        self.assertEqual(result.stdout, "")
        self.assertIn("Wrote", result.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual([key for key in REPORT_KEYS], list(report))
        for key, members in REPORT_KEYS.items():
            if members is not None:
                self.assertLessEqual(members, set(report[key]), key)
        self.assertLessEqual({"min", "p1", "p5", "median"}, set(report["final"]["dihedral_deg"]))
        self.assertLessEqual({"min", "max"}, set(report["final"]["edge_m"]))
        self.assertLessEqual({"rms", "max", "count"}, set(report["fidelity"]["K"]))
        self.assertEqual(report["input"]["samples"], 1292)
        kept = report["preprocess"]
        self.assertEqual(kept["samples_kept"] + kept["samples_deleted"] + kept["samples_near_faults"], 1292)
        self.assertIs(report["final"]["delaunay"], True)
        self.assertEqual(report["final"]["fault_crossing_edges"], 0)
        self.assertEqual(report["fidelity"]["K"]["count"], 1292)
        fault = report["faults"][0]
        parts = sum(fault["area_" + part] for part in ("used", "outside", "trimmed", "refused"))
        self.assertAlmostEqual(parts / fault["area_in"], 1, 6)
        for output in report["outputs"]:
            self.assertEqual(output["bytes"], (self.folder / output["path"]).stat().st_size, output)
        self.assertEqual([output["path"] for output in report["outputs"]], outputs)
        self.assertEqual(self.listing(), sorted(str(self.folder / name) for name in [*outputs, "report.json"]))

    def test_at_the_papers_resolution_density_edition_keeps_about_as_many_samples(self):
        inputs = twin_inputs()
        inputs[inputs.index("60m")] = "20m"
        result = self.succeed("convert", *inputs, "--lmax", "80m", "--report", "-", "-q", "m.csv")
        kept = json.loads(result.stdout)["preprocess"]["samples_kept"]
        self.assertTrue(160 <= kept <= 172, kept)

    def test_build_then_export_equals_convert(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "built.vtu", "built.csv")
        self.succeed("convert", *twin_inputs(), "converted.vtu", "converted.csv")
        for suffix in ("vtu", "csv"):
            self.assertEqual((self.folder / f"built.{suffix}").read_bytes(),
                             (self.folder / f"converted.{suffix}").read_bytes(), suffix)

    def test_info_and_check_read_the_model(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg", "-q")
        info = json.loads(self.succeed("info", "--json", "m.gpkg").stdout)
        self.assertEqual((info["kind"], info["boreholes"], info["samples"]), ("model", 4, 1292))
        self.assertEqual(info["properties"][0]["scale"], "log10")
        self.assertEqual(info["criteria"]["lmin"], 60)
        self.assertEqual(info["extent"], [525130, 6791500, -990, 525870, 6792500, 10])
        self.assertRegex(self.succeed("info", "--digest", "m.gpkg").stdout, r"^[0-9a-f]{64}\n$")
        verdicts = json.loads(self.succeed("check", "--json", "m.gpkg").stdout)
        self.assertTrue(all(verdict["holds"] for verdict in verdicts))
        self.assertLessEqual({"D1", "D2", "V1", "F1", "R3", "R5"}, {verdict["guarantee"] for verdict in verdicts})
        self.assertEqual(len(self.succeed("check", "m.gpkg").stdout.splitlines()), len(verdicts))

    def test_info_tells_tables_from_surfaces(self):
        table = json.loads(self.succeed("info", "--json", TWIN / "log.csv").stdout)
        self.assertEqual((table["kind"], table["rows"]), ("table", 1292))
        self.assertEqual([column["name"] for column in table["columns"]], ["hole", "from", "to", "K"])
        for name in ("fracture.ts", "fracture.gpkg"):
            surfaces = json.loads(self.succeed("info", "--json", TWIN / name).stdout)
            self.assertEqual(surfaces["kind"], "surfaces")
            self.assertEqual(surfaces["surfaces"][0]["triangles"], 840)
            self.assertAlmostEqual(surfaces["surfaces"][0]["dip"], 60, 2)

    def test_the_fracture_is_the_same_from_points_tsurf_and_geopackage(self):
        for name in ("fracture.ts", "fracture.gpkg"):
            self.succeed("convert", *twin_inputs(faults=name), name + ".csv")
        self.assertEqual(*((self.folder / f"fracture.{kind}.csv").read_bytes() for kind in ("ts", "gpkg")))
        self.succeed("build", *twin_inputs(faults="fracture.csv"), "-o", "points.gpkg")
        self.succeed("check", "points.gpkg")

    def test_a_recipe_says_the_same_as_options(self):
        recipe = self.write("recipe.toml", f"""
boreholes = "{TWIN / 'collar.csv'}"
survey = "{TWIN / 'survey.csv'}"
log = ["{TWIN / 'log.csv'}"]
faults = "{TWIN / 'fracture.ts'}"
property = "K:log10:unit=m/s"
s_srs = "EPSG:3067"
extent = "525130,6791500,-990,525870,6792500,10"
lmin = "60m"
estimator = "idw"
""")
        self.succeed("convert", "--config", recipe, "recipe.csv")
        self.succeed("convert", *twin_inputs(), "options.csv")
        self.assertEqual((self.folder / "recipe.csv").read_bytes(), (self.folder / "options.csv").read_bytes())

    def test_progress_as_json_goes_to_standard_error(self):
        result = self.succeed("convert", *twin_inputs(), "-q", "--progress", "json", "m.csv")
        steps = [json.loads(line) for line in result.stderr.splitlines()]
        self.assertGreater(len(steps), 3)
        self.assertTrue(all(0 <= step["fraction"] <= 1 for step in steps))

    def test_quiet_says_nothing(self):
        result = self.succeed("convert", *twin_inputs(), "-q", "m.csv")
        self.assertEqual((result.stdout, result.stderr), ("", ""))

    def test_strict_turns_unmet_criteria_into_exit_code_4_and_keeps_the_output(self):
        result = self.run_terratet("convert", *twin_inputs(), "--strict", "--aspect", "3.5", "m.csv", "--report", "r.json")
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertTrue((self.folder / "m.csv").exists())
        self.assertGreater(sum(json.loads((self.folder / "r.json").read_text())["refine"]["skipped"].values()), 0)


class Resolution(Case):
    def flat_site(self):
        """5 km × 5 km × 100 m, at heights of a plateau."""
        rows = ["x,y,z,T"]
        for i in range(36):
            for k in range(11):
                x, y, z = 500000 + 1000 * (i % 6) + 37 * (i // 6), 6700000 + 1000 * (i // 6), 3010.3 - 9.7 * k
                rows.append(f"{x},{y},{z},{math.sin(x / 900) + k / 5}")
        return self.write("flat.csv", "\n".join(rows) + "\n")

    def test_flat_sites_are_tessellated_in_stretched_z_and_written_unstretched(self):
        build = ["convert", "--samples", self.flat_site(), "-s_srs", "EPSG:3067", "--estimator", "idw",
                 "-te", "499900", "6699900", "2900", "505300", "6705100", "3020"]
        plain = self.succeed(*build, "--lmin", "100", "plain.csv")
        self.assertIn("--z-scale", plain.stderr)
        done = self.succeed(*build, "--lmin", "200", "--z-scale", "24", "--report", "report.json", "m.gpkg", "m.vtu", "m.csv",
                            "m.vdb", "m.glb")
        self.assertNotIn("consider --z-scale", done.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["frame"]["z_scale"], 24)
        self.assertLess(report["final"]["bad_percent"], 5)
        with open(self.folder / "m.csv", newline="") as file:
            heights = [float(row["z"]) for row in csv.DictReader(file)]
        self.assertEqual((min(heights), max(heights)), (2900, 3020))
        self.assertGreater(len(set(heights)), 100)
        self.assertNotIn("BROKEN", self.succeed("check", "m.gpkg").stdout)
        self.succeed("export", "m.gpkg", "again.vtu", "again.csv")
        for name in ("vtu", "csv"):
            self.assertEqual((self.folder / f"m.{name}").read_bytes(), (self.folder / f"again.{name}").read_bytes())

    def test_a_box_and_a_block_may_have_their_own_resolution(self):
        inputs = twin_inputs()
        self.succeed("build", *inputs, "--resolution", "525300,6791900,-600,525500,6792100,-400=15m,60m",
                     "--resolution", "525200,6792300,-100=90m,360m", "-o", "m.gpkg")
        check = self.succeed("check", "m.gpkg")
        self.assertNotIn("BROKEN", check.stdout)
        for wrong in ("1,2=3,4", "1,2,3=4", "1,2,3=9,4", "0,0,0,1,1,1=x,y", "5,5,5,1,1,1=1,2"):
            self.fail_with(2, "build", *inputs, "--resolution", wrong, "-o", "n.gpkg")
        self.fail_with(2, "build", *inputs, "--resolution", "0,0,0=10,40", "-o", "n.gpkg")

if __name__ == "__main__":
    unittest.main()
