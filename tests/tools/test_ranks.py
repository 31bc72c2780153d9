# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several processes at one command, as mpirun starts them: the same bytes, one voice, one exit code. Skips where the
program is made without MPI. With TERRATET_RANKS=1,2,4,8 by so many processes instead of two."""
import hashlib
import os
import random
import shutil
import subprocess
import unittest

from terratet import Case, PROGRAM, twin_inputs

COUNTS = [int(n) for n in os.environ.get("TERRATET_RANKS", "2").split(",")]
WITH_MPI = "MPI" in subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout
LIMIT = 110


@unittest.skipUnless(WITH_MPI and shutil.which("mpirun"), "the program is made without MPI (-DTERRATET_MPI=ON)")
class SeveralRanks(Case):
    model = None

    def setUp(self):
        super().setUp()
        if SeveralRanks.model is None:
            self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
            SeveralRanks.model = (self.folder / "m.gpkg").read_bytes()
        self.write("m.gpkg", SeveralRanks.model)

    def by_ranks(self, count, *arguments, text=""):
        words = ["mpirun", "-q", "-n", str(count), "--oversubscribe", "--allow-run-as-root", PROGRAM, *map(str, arguments)]
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, input=text, timeout=LIMIT)

    def same_at_any_count(self, *arguments, outputs=(), text=""):
        """With and without mpirun: what is printed, and what is in the files."""
        def left(done):
            self.assertEqual(done.returncode, 0, done.stderr)
            of_files = [hashlib.sha256((self.folder / name).read_bytes()).hexdigest() for name in outputs]
            for name in outputs:
                self.assertGreater((self.folder / name).stat().st_size, 1000)
                (self.folder / name).unlink()
            return done.stdout, of_files

        alone = left(subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                                    input=text, timeout=LIMIT))
        before = self.listing()
        for count in COUNTS:
            same = left(self.by_ranks(count, *arguments, text=text)) == alone  # a difference of long texts takes minutes
            self.assertTrue(same, f"{count} ranks: something else")
        self.assertEqual(self.listing(), before)
        return alone[0]

    def test_all_voxels_have_the_same_bytes(self):
        outputs = ["a.vdb", "a.nc", "a.tif", "a.csv"]
        for more in ([], ["--values", "estimator", "--uncertainty"]):
            self.same_at_any_count("export", "m.gpkg", *outputs[:3], "a.csv,of=BLOCKS", "-tr", 20 if more else 9, "-q", *more,
                                   outputs=outputs)

    def test_values_at_a_grid_and_at_a_mesh_have_the_same_bytes(self):
        self.succeed("export", "m.gpkg", "g.nc", "g.vtu", "-tr", "20", "-q")
        self.same_at_any_count("resample", "m.gpkg", "--onto", "g.nc", "a.nc", "a.vdb", "a.csv", "-q",
                               outputs=["a.nc", "a.vdb", "a.csv"])
        self.same_at_any_count("resample", "m.gpkg", "--onto", "g.vtu", "a.vtu", "a.csv", "-q", outputs=["a.vtu", "a.csv"])
        self.same_at_any_count("export", "g.nc", "b.vdb", "-q", outputs=["b.vdb"])

    def test_what_is_no_voxels_is_written_once(self):
        self.same_at_any_count("export", "m.gpkg", "a.vtu", "a.vdb", "-tr", 40, outputs=["a.vtu", "a.vdb"])

    def test_values_are_the_same_from_a_file_and_from_standard_input(self):
        at = random.Random(1)
        table = "x,y,z\n" + "".join(f"{at.uniform(525100, 525900)},{at.uniform(6791500, 6792500)},{at.uniform(-990, 0)}\n"
                                    for _ in range(5000))
        self.write("p.csv", table)
        of_file = self.same_at_any_count("query", "m.gpkg", "value", "p.csv", "-q")
        self.assertEqual(self.same_at_any_count("query", "m.gpkg", "value", "-", "-q", text=table), of_file)
        self.assertEqual(len(of_file.splitlines()), 5001)
        few = self.same_at_any_count("query", "m.gpkg", "value", "--at", "525500,6792000,-200", "-q", "--estimator", "natural")
        self.assertEqual(len(few.splitlines()), 2)

    def test_a_query_of_another_verb_is_answered_once(self):
        self.same_at_any_count("query", "m.gpkg", "nearest", "--at", "525500,6792000,-200", "-k", 3, "-q")

    def test_errors_of_estimators_are_the_same(self):
        self.same_at_any_count("validate", "m.gpkg", "--estimator", "idw", "--estimator", "natural", "--estimator",
                               "kriging:model=exponential", "--report", "v.json", "-q", outputs=["v.json"])

    def test_one_message_and_its_exit_code(self):
        self.write("there.vdb", "x")
        self.write("bad.gpkg", "no model")
        self.write("few.csv", "a,b\n1,2\n")
        for code, arguments in [(2, ["export", "m.gpkg", "a.xyz"]), (2, ["export", "m.gpkg", "a.vdb", "--no-such"]),
                                (1, ["export", "m.gpkg", "there.vdb"]), (3, ["export", "bad.gpkg", "a.vdb"]),
                                (2, ["export", "m.gpkg", "a.vdb", "-tr", "0.01"]),
                                (3, ["query", "m.gpkg", "value", "few.csv"]), (3, ["validate", "bad.gpkg"]),
                                (2, ["query", "m.gpkg", "value", "--at", "1,2,3", "--estimator", "magic"])]:
            alone = self.run_terratet(*arguments)
            self.assertEqual(alone.returncode, code, alone.stderr)
            before = self.listing()
            for count in COUNTS:
                done = self.by_ranks(count, *arguments)
                own = [line for line in done.stderr.splitlines() if line.startswith("terratet: ")]
                self.assertEqual((done.returncode, own, done.stdout), (code, alone.stderr.splitlines(), ""), arguments)
                self.assertEqual(self.listing(), before)

    def test_a_full_disk_at_rank_0_ends_all(self):
        limited = f"ulimit -f 20000; exec '{PROGRAM}' export m.gpkg a.csv,of=BLOCKS -tr 8 -q"
        words = ["mpirun", "-q", "-n", "2", "--oversubscribe", "--allow-run-as-root", "bash", "-c", limited]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=LIMIT)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(sum(line.startswith("terratet: cannot write") for line in done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "a.csv").exists())


if __name__ == "__main__":
    unittest.main()
