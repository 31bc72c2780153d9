# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever is wrong, the answer is one clear line, the right exit code and no output (the matrix of bad inputs)."""
import os
import unittest

from terratet import Case, TWIN, twin_inputs

USAGE, INPUT, RUNNING = 2, 3, 1
GRID = "x,y,z,grade\n" + "".join(f"{525000 + 10 * i},{6792000 + 10 * j},{10 * k},{i + j + k}\n"
                                 for i in range(3) for j in range(3) for k in range(3))
TSURF = "GOCAD TSurf 1\nHEADER {{\nname:f\n}}\nTFACE\n{}\nEND\n"
TRIANGLE = "VRTX 1 525000 6792000 0\nVRTX 2 525020 6792000 0\nVRTX 3 525000 6792020 20\nTRGL 1 2 3"


class Usage(Case):
    def usage(self, *arguments, saying):
        samples = self.folder / "s.csv"
        if not samples.exists():
            self.write("s.csv", GRID)
        self.fail_with(USAGE, *arguments, saying=saying)

    def convert(self, *arguments, saying):
        self.usage("convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", *arguments, "o.csv", saying=saying)

    def test_command(self):
        self.usage("biuld", saying="did you mean build?")
        self.usage("help", "kriging", saying="there is no help on 'kriging'")

    def test_unknown_option_names_the_nearest(self):
        self.convert("--lmim", "20", saying="did you mean --lmin?")
        self.convert("-s_sr", "EPSG:3067", saying="did you mean --s_srs?")
        self.convert("--frobnicate", saying="terratet help convert")

    def test_impossible_values(self):
        self.convert("--lmin", "nan", saying="--lmin")
        self.convert("--lmin", "inf", saying="--lmin")
        self.convert("--lmin", "-5", saying="--lmin")
        self.convert("--lmin", "20 parsecs", saying="--lmin")
        self.convert("--aspect", "nan", saying="--aspect")
        self.convert("--aspect", "2", saying="aspect")
        self.convert("--radius-edge", "0.1", saying="radius")
        self.convert("--threads", "many", saying="--threads")
        self.convert("--progress", "fancy", saying="--progress")
        self.convert("--estimator", "krigging", saying="natural")
        self.convert("--estimator", "idw:power=nan", saying="power")
        self.convert("--fault-mode", "approximate", saying="--fault-mode")
        self.convert("--te", "0,0,0,1,1", saying="six numbers")
        self.convert("-tr", "0", saying="--voxel-size")
        self.convert("--of", "XYZ", saying="XYZ")
        self.convert("-co", "SHINY=YES", saying="SHINY")
        self.convert("--config", "none.toml", saying="none.toml")

    def test_wrong_crs(self):
        self.usage("convert", "--samples", "s.csv", "-s_srs", "EPSG:banana", "o.csv", saying="EPSG:banana")
        self.convert("-t_srs", "nowhere", saying="nowhere")

    def test_contradictions(self):
        self.convert("--lmin", "20", "--lmax", "10", saying="l")
        self.convert("-te", *"525000 6792000 0 525020 6792020 20".split(), "--pad", "5", saying="--pad")
        self.convert("--df-min", "grade=3", "--df-max", "grade=1", saying="df")
        self.convert("--df-max", "gold=1", saying="gold")
        self.usage("convert", "--log", "s.csv", "o.csv", saying="--boreholes")
        self.usage("convert", "o.csv", saying="no input")
        self.usage("convert", "s.csv", "o.vtu", saying="; s.csv would be written")
        self.usage("build", "--samples", "s.csv", saying="-o")
        self.usage("build", "--samples", "s.csv", "-o", "o.vtu", saying="terratet convert")
        self.usage("convert", "--samples", "s.csv", saying="OUTPUT is missing")

    def test_outputs(self):
        self.usage("convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "o.xyz", saying="o.xyz")
        self.usage("convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "o.csv", "o.csv", saying="twice")
        self.usage("convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "--overwrite", "s.csv", saying="is an input")
        self.assertEqual((self.folder / "s.csv").read_text(), GRID)


class Running(Case):
    def test_existing_output_is_refused_before_anything_is_read(self):
        old = self.write("o.csv", "precious")
        line = self.fail_with(RUNNING, "convert", "--samples", "missing.csv", "-s_srs", "EPSG:3067", "o.csv")
        self.assertIn("--overwrite", line)
        self.assertEqual(old.read_text(), "precious")
        report = self.write("r.json", "precious")
        self.fail_with(RUNNING, "convert", "--samples", "missing.csv", "-s_srs", "EPSG:3067", "p.csv", "--report", "r.json",
                       saying="--overwrite")
        self.assertEqual(report.read_text(), "precious")

    def test_missing_folder_and_folder_as_output(self):
        self.write("s.csv", GRID)
        self.fail_with(RUNNING, "convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "none/o.csv", saying="none")
        (self.folder / "d.csv").mkdir()
        self.fail_with(RUNNING, "convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "--overwrite", "d.csv", saying="d.csv")

    def test_a_bound_exceeded(self):
        self.fail_with(USAGE, "convert", *twin_inputs(), "--max-vertices", "100", "o.csv", saying="--lmax of")
        self.fail_with(USAGE, "convert", *twin_inputs(), "--max-vertices", "1000", "o.csv", saying="--max-vertices 1000")

    def test_standard_output_that_is_full(self):
        self.write("s.csv", GRID)
        with open("/dev/full", "w") as full:
            import subprocess
            from terratet import PROGRAM
            result = subprocess.run([PROGRAM, "info", "s.csv"], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, RUNNING)
        self.assertEqual(len(result.stderr.splitlines()), 1)

    def test_one_of_several_outputs_fails_and_those_written_are_named(self):
        self.write("s.csv", GRID)
        import resource
        import subprocess
        from terratet import PROGRAM
        arguments = [PROGRAM, "convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "--lmin", "5"]
        subprocess.run([*arguments, "-q", "good.csv"], cwd=self.folder, check=True)
        limit = (self.folder / "good.csv").stat().st_size + 1000  # a VTU without compression is larger
        result = subprocess.run(
            [*arguments, "--overwrite", "-co", "COMPRESS=NO", "good.csv", "huge.vtu"], cwd=self.folder, capture_output=True,
            text=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn("written before it: good.csv", result.stderr)
        self.assertTrue((self.folder / "good.csv").exists())
        self.assertEqual(sorted(os.listdir(self.folder)), ["good.csv", "s.csv"])


class Input(Case):
    def samples(self, text, *arguments, saying="s.csv"):
        self.write("s.csv", text)
        return self.fail_with(INPUT, "convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", *arguments, "o.csv", saying=saying)

    def faults(self, text, name="f.ts", saying=None):
        self.write("s.csv", GRID)
        self.write(name, text)
        return self.fail_with(INPUT, "convert", "--samples", "s.csv", "--faults", name, "-s_srs", "EPSG:3067", "o.csv",
                              saying=saying or name)

    def test_missing_file_and_folder(self):
        for option in ("--samples", "--boreholes", "--faults"):
            self.fail_with(INPUT, "convert", option, "none.csv", "-s_srs", "EPSG:3067", "o.csv", saying="none.csv")
        (self.folder / "d").mkdir()
        self.fail_with(INPUT, "convert", "--samples", "d", "-s_srs", "EPSG:3067", "o.csv", saying="d")
        self.fail_with(INPUT, "info", "none.gpkg", saying="none.gpkg")
        self.fail_with(INPUT, "check", "none.gpkg", saying="none.gpkg")
        self.fail_with(INPUT, "export", "none.gpkg", "o.vtu", saying="none.gpkg")
        self.fail_with(INPUT, "export", TWIN / "fracture.gpkg", "o.vtu", saying="fracture.gpkg")
        self.fail_with(INPUT, "info", "--digest", TWIN / "log.csv", saying="log.csv")

    def test_no_crs(self):
        self.write("s.csv", GRID)
        self.fail_with(INPUT, "convert", "--samples", "s.csv", "o.csv", saying="-s_srs")

    def test_empty_tables(self):
        self.samples("")
        self.samples("x,y,z,grade\n")
        self.samples("\n\n\n")

    def test_no_coordinates_and_no_numeric_column(self):
        self.samples("a,b,c\n1,2,3\n")
        self.samples("x,y,z,rock\n1,2,3,granite\n4,5,6,gneiss\n", saying="rock")

    def test_no_usable_row(self):
        self.samples("x,y,z,grade\nnorth,east,up,high\n")
        self.samples("x,y,z,grade\nnan,1,2,3\ninf,1,2,3\n1e300,1,2,3\n")

    def test_text_in_a_number_is_skipped_and_reported_or_refused_when_strict(self):
        dirty = GRID + "525005,6792005,5,n/a\n525001,oops,5,3\n"
        self.samples(dirty, "--strict", saying="s.csv")
        self.write("s.csv", dirty)
        result = self.succeed("convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "o.csv")
        self.assertIn("oops", result.stderr)

    def test_binary_rubbish(self):
        self.samples(bytes(range(256)) * 40)
        self.faults(bytes(range(256)) * 40)

    def test_tsurf_index_out_of_range(self):
        self.faults(TSURF.format(TRIANGLE.replace("TRGL 1 2 3", "TRGL 1 2 99")))

    def test_tsurf_giant_index_and_counts(self):
        self.faults(TSURF.format(TRIANGLE.replace("TRGL 1 2 3", "TRGL 1 2 18446744073709551616")))
        self.faults(TSURF.format(TRIANGLE.replace("VRTX 3", "VRTX 4000000000")))

    def test_tsurf_truncated(self):
        self.faults("GOCAD TSurf 1\nHEADER {\nname:f\n")
        self.faults(TSURF.format("VRTX 1 525000 6792000"))

    def test_tsurf_with_numbers_that_are_none(self):
        self.faults(TSURF.format(TRIANGLE.replace("525020", "nan")))
        self.faults(TSURF.format(TRIANGLE.replace("525020", "1e400")))

    def test_damaged_model(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg", "-q")
        whole = (self.folder / "m.gpkg").read_bytes()
        os.remove(self.folder / "m.gpkg")
        for share in (0.0, 0.3, 0.9):
            self.write("cut.gpkg", whole[:int(len(whole) * share)])
            self.fail_with(INPUT, "export", "cut.gpkg", "o.vtu", saying="cut.gpkg")
            self.fail_with(INPUT, "check", "cut.gpkg", saying="cut.gpkg")

    def test_missing_layer_and_column(self):
        self.write("s.csv", GRID)
        self.fail_with(INPUT, "convert", "--samples", "s.csv,layer=nope", "-s_srs", "EPSG:3067", "o.csv", saying="nope")
        self.fail_with(USAGE, "convert", "--samples", "s.csv", "--columns", "x=EASTING", "-s_srs", "EPSG:3067", "o.csv",
                       saying="EASTING")


if __name__ == "__main__":
    unittest.main()
