# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits of a stored model by the command: what they change, what they leave, and the way back."""
import csv
import hashlib
import json
import math
import sqlite3
import subprocess
import unittest

from terratet import Case


class Edits(Case):
    def setUp(self):
        super().setUp()
        holes = {f"H{i}{j}": (30 + 60 * i, 30 + 60 * j) for i in range(4) for j in range(4)}
        self.write("collar.csv", "id,x,y,z\n" + "".join(f"{h},{x},{y},0\n" for h, (x, y) in holes.items()))
        self.write("log.csv", "id,depth,v,rock\n" + "".join(
            f"{h},{d},{x + 0.1 * y - d},{'clay' if d < 50 else 'rock'}\n" for h, (x, y) in holes.items() for d in range(0, 100, 5)))
        fault = [f"F,{115 + 0.3 * z},{y},{z}" for y in range(-60, 300, 15) for z in range(-160, 60, 15)]
        self.write("f.csv", "fault,x,y,z\n" + "\n".join(fault) + "\n")
        self.succeed("build", "--boreholes", "collar.csv", "--log", "log.csv", "--faults", "f.csv", "-s_srs", "local",
                     "--property", "v", "--property", "rock:categorical", "-te", 0, 0, -100, 240, 240, 0, "--lmin", 12, "-o", "m.gpkg",
                     "-q")

    def digest(self, path="m.gpkg"):
        return self.succeed("info", path, "--digest").stdout.strip()

    def export(self, name):
        self.succeed("export", "m.gpkg", name, "--overwrite", "-q")
        return (self.folder / name).read_bytes()

    def vertices(self):
        self.succeed("export", "m.gpkg", "v.csv", "--overwrite", "-q")
        with open(self.folder / "v.csv", newline="") as file:
            return {(float(r["x"]), float(r["y"]), float(r["z"])): r for r in csv.DictReader(file)}

    def check(self):
        self.assertNotIn("BROKEN", self.succeed("check", "m.gpkg", "-q").stdout)

    def edit(self, *words):
        return json.loads(self.succeed("edit", "m.gpkg", *words, "--json", "-q").stdout)

    def test_x1_x2_every_verb_changes_what_it_says_and_undo_restores_the_same_exports(self):
        self.write("more.csv", "id,x,y,z\nN1,100,200,0\n")
        self.write("morelog.csv", "id,depth,v,rock\n" + "".join(f"N1,{d},5,gravel\n" for d in range(0, 60, 5)))
        self.write("loose.csv", "x,y,z,v\n120.5,60.25,-33,7\n")
        self.write("g.csv", "fault,x,y,z\n" + "".join(f"G,{x},{200 + 0.4 * z},{z}\n" for x in range(130, 220, 10) for z in range(-80, -10, 10)))
        self.write("f2.csv", "fault,x,y,z\n" + "".join(f"F,{120 + 0.3 * z},{y},{z}\n" for y in range(-60, 300, 15) for z in range(-160, 60, 15)))
        verbs = [["move-borehole", "H11", "--by", "-5,3,0"], ["move-borehole", "H22", "--to", "150,160,1"], ["remove-borehole", "H00"],
                 ["add-boreholes", "--boreholes", "more.csv", "--log", "morelog.csv"], ["add-samples", "loose.csv"],
                 ["remove-samples", "--where", "borehole = 'H33' AND depth > 40"], ["add-fault", "g.csv"],
                 ["set-resolution", "100,100,-80,160,160,-20=6,24"], ["set-resolution", "0,0,-100,80,80,0=30,120"],
                 ["refine", "--box", "20,20,-60,70,70,-20"], ["replace-fault", "F", "f2.csv"], ["remove-fault", "G"]]
        digests, exports = [self.digest()], [self.export("a.vtu")]
        for words in verbs:
            with self.subTest(words=words):
                done = self.edit(*words)
                self.assertEqual(done["edit"], len(digests))
                self.assertGreater(done["vertices"]["removed"] + done["vertices"]["added"], 0)
                digests.append(self.digest())
                exports.append(self.export("a.vtu"))
                self.assertNotEqual(digests[-1], digests[-2])
        self.check()
        self.assertIn("gravel", self.succeed("info", "m.gpkg").stdout)
        for i in reversed(range(len(verbs))):
            self.succeed("edit", "m.gpkg", "undo", "-q")
            self.assertEqual(self.digest(), digests[i])
        self.assertTrue(self.export("a.vtu") == exports[0])
        self.succeed("edit", "m.gpkg", "redo", len(verbs), "-q")
        self.assertEqual(self.digest(), digests[-1])
        self.assertTrue(self.export("a.vtu") == exports[-1])
        history = list(csv.DictReader(self.succeed("edit", "m.gpkg", "history").stdout.splitlines()))
        self.assertEqual([row["arguments"] for row in history[1:4]],
                         ["move-borehole H11 --by=-5,3,0", "move-borehole H22 --to=150,160,1", "remove-borehole H00"])

    def test_x1_what_lies_farther_than_three_lmax_from_a_moved_hole_stays(self):
        before = self.vertices()
        self.succeed("edit", "m.gpkg", "move-borehole", "H00", "--by", "4,4,0", "-q")
        after = self.vertices()
        far = [p for p in before if math.hypot(p[0] - 30, p[1] - 30) > 3 * 48 + 10]
        self.assertGreater(len(far), 50)
        for p in far:
            self.assertEqual({k: before[p][k] for k in ("id", "role", "side")}, {k: after[p][k] for k in ("id", "role", "side")})
        moved = [p for p, r in after.items() if r["role"] == "sample" and (p[0], p[1]) == (34, 34)]
        self.assertGreater(len(moved), 3)
        self.assertFalse([p for p in after if (p[0], p[1]) == (30, 30) and after[p]["role"] == "sample"])
        self.check()

    def test_a_dry_run_and_what_fails_change_no_byte(self):
        def content():
            return hashlib.sha256((self.folder / "m.gpkg").read_bytes()).hexdigest()

        before = content()
        said = json.loads(self.succeed("edit", "m.gpkg", "remove-fault", "F", "--dry-run", "-q").stdout)
        self.assertIsNone(said["edit"])
        self.assertGreater(said["seeds"]["removed"], 10)
        for words, saying in ((["remove-fault", "X"], "there is F"), (["move-borehole", "nope", "--by", "1,1"], "there is no borehole 'nope'"),
                              (["mvoe-borehole", "H00"], "did you mean move-borehole?"), (["set", "lmxa=3"], "did you mean lmax?"),
                              (["remove-samples", "--where", "depth >"], "is no condition"), (["undo"], "nothing to undo"),
                              (["move-borehole", "H00"], "--by dx,dy[,dz] or --to"), (["set", "lmin=500"], "lmax")):
            self.fail_with(2, "edit", "m.gpkg", *words, saying=saying)
        self.fail_with(3, "edit", "m.gpkg", "add-fault", "none.ts", saying="none.ts")
        self.write("s.json", json.dumps([["remove-borehole", "H00"], ["remove-borehole", "H00"]]))
        self.fail_with(2, "edit", "m.gpkg", "--script", "s.json", saying="H00")
        self.assertEqual(content(), before)

    def test_a_script_is_one_edit(self):
        before = self.digest()
        self.write("s.json", json.dumps([["remove-fault", "F"], ["move-borehole", "H12", "--by", "5,0,0"],
                                         ["set-resolution", "0,0,-50,50,50,0=6,24"]]))
        self.succeed("edit", "m.gpkg", "--script", "s.json", "-q")
        self.check()
        self.assertEqual(len(self.succeed("edit", "m.gpkg", "history").stdout.splitlines()), 3)
        self.succeed("edit", "m.gpkg", "undo", "-q")
        self.assertEqual(self.digest(), before)

    def test_set_builds_with_the_new_option_and_comes_back(self):
        before = self.digest()
        count = len(self.vertices())
        self.succeed("edit", "m.gpkg", "set", "lmax=24", "-q")
        self.assertGreater(len(self.vertices()), count)
        self.check()
        self.succeed("edit", "m.gpkg", "undo", "-q")
        self.assertEqual(self.digest(), before)

    def test_other_programs_tables_and_an_r_tree_survive(self):
        def ask(statement):
            done = subprocess.run(["ogrinfo", "-q", "-sql", statement, "m.gpkg"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return done.stdout

        ask("SELECT CreateSpatialIndex('vertices', 'geom')")
        with sqlite3.connect(self.folder / "m.gpkg") as data:
            data.execute("CREATE TABLE notes (text TEXT)")
        self.succeed("edit", "m.gpkg", "move-borehole", "H11", "--by", "5,3,0", "-q")
        with sqlite3.connect(self.folder / "m.gpkg") as data:
            count = data.execute("SELECT count(*) FROM vertices").fetchone()[0]
            self.assertEqual(data.execute("SELECT count(*) FROM rtree_vertices_geom").fetchone()[0], count)
            self.assertEqual(data.execute("SELECT feature_count FROM gpkg_ogr_contents WHERE table_name = 'vertices'").fetchone()[0], count)
            self.assertEqual(data.execute("SELECT count(*) FROM notes").fetchone()[0], 0)
        found = subprocess.run(["ogrinfo", "-q", "-spat", "94.5", "92.5", "95.5", "93.5", "m.gpkg", "vertices"], cwd=self.folder,
                               capture_output=True, text=True).stdout
        self.assertGreater(found.count("OGRFeature"), 2)


if __name__ == "__main__":
    unittest.main()
