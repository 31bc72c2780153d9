# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fault blocks: their names and volumes, in the report and in outputs."""
import json
import unittest

from terratet import Case

class Regions(Case):
    def setUp(self):
        super().setUp()
        rows = [f"{x},{y},{z},{x + z}" for x in (10, 90, 160) for y in (10, 100, 190) for z in (-90, -50, -10)]
        self.write("s.csv", "x,y,z,v\n" + "\n".join(rows) + "\n")
        fault = [f"f,{130 + 0.5 * z},{y},{z}" for y in range(-60, 280, 20) for z in range(-160, 80, 20)]
        self.write("f.csv", "fault,x,y,z\n" + "\n".join(fault) + "\n")
        self.inputs = ["--samples", "s.csv", "--faults", "f.csv", "-s_srs", "local", "-te", "0", "0", "-100", "200", "200", "0",
                       "--lmin", "20"]

    def test_names_and_volumes_are_in_the_report_and_names_in_the_outputs(self):
        self.succeed("convert", *self.inputs, "--region-name", "10,10,-10=west of it", "--region-name", "190,10,-90=east, 2nd",
                     "--report", "r.json", "m.gpkg", "m.vtu", "m.gltf")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["final"]["regions"], 2)
        volume = {region["name"]: region["volume"] for region in report["regions"]}
        self.assertAlmostEqual(volume["west of it"] / (105 * 200 * 100), 1, 9)
        self.assertAlmostEqual(volume["east, 2nd"] / (95 * 200 * 100), 1, 9)
        field_data = (self.folder / "m.vtu").read_bytes().split(b"</FieldData>")[0].decode()
        self.assertIn(" ".join(str(byte) for byte in b"west of it\0"), field_data)
        nodes = [node.get("name") for node in json.loads((self.folder / "m.gltf").read_text())["nodes"]]
        self.assertLessEqual({"west of it", "east, 2nd"}, set(nodes))
        self.assertIn("west of it", self.succeed("info", "m.gpkg").stdout)
        self.succeed("export", "m.gpkg", "again.vtu")  # the names are in the model
        self.assertTrue((self.folder / "again.vtu").read_bytes() == (self.folder / "m.vtu").read_bytes())

    def test_a_block_without_samples_is_named_and_a_place_on_the_fault_is_of_the_side_asked_for(self):
        rows = [f"{x},{y},{z},{x + z}" for x in (10, 50, 90) for y in (10, 100, 190) for z in (-90, -50, -10)]
        self.write("s.csv", "x,y,z,v\n" + "\n".join(rows) + "\n")
        fault = [f"f,120,{y},{z}" for y in range(-60, 280, 20) for z in range(-160, 80, 20)]
        self.write("f.csv", "fault,x,y,z\n" + "\n".join(fault) + "\n")
        said = self.succeed("convert", *self.inputs, "--region-name", "190,10,-90=east", "--report", "r.json", "m.gpkg", "m.vtu").stderr
        self.assertRegex(" ".join(said.split()), r"Block [01], east \(1\.\d+ M m³\) holds no sample: no values there")
        self.assertEqual(said.count("holds no sample"), 1)
        regions = json.loads((self.folder / "r.json").read_text())["regions"]
        self.assertEqual({r["name"] == "east": r["without_values"] for r in regions}, {True: ["v"], False: []})
        self.write("p.csv", "x,y,z\n120,100,-50\n120,93,-41\n")  # the + side is the east: a surface across y looks to +x

        def values(*side):
            rows = self.succeed("query", "m.gpkg", "value", "p.csv", *side, "-q", "--no-sd").stdout.splitlines()
            return [row.split(",")[3] for row in rows[1:]]

        self.assertEqual(values(), ["", ""])
        self.assertEqual(values("--side", "+"), ["", ""])
        for value in values("--side", "-"):
            self.assertLess(abs(float(value)), 200)

    def test_names_for_nothing_are_refused(self):
        for text, saying in (("1,2=x", "is not x,y,z=NAME"), ("1,2,3=", "is not x,y,z=NAME"), ("1,2,z=a", "'z' is not a number")):
            self.fail_with(2, "build", *self.inputs, "--region-name", text, "-o", "m.gpkg", saying=saying)
        self.fail_with(2, "build", *self.inputs, "--region-name", "10,10,500=sky", "-o", "m.gpkg", saying="'sky' lies in no region")


if __name__ == "__main__":
    unittest.main()
