# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""To a tolerance: a thin rich seam that thinning by distance loses."""
import json
import unittest

from terratet import Case


def seam():
    """Four holes of 60 samples a metre apart, 10 in two metres of each."""
    collar, log = ["hole,x,y,z"], ["hole,from,to,au,rock"]
    for hole in range(4):
        collar.append(f"H{hole},{500000 + 40 * (hole % 2)},{6700000 + 40 * (hole // 2)},0")
        log += [f"H{hole},{d},{d + 1},{10 if 30 + hole <= d < 32 + hole else 0.1 + 0.01 * (d % 3)},{'AB'[d // 30]}"
                for d in range(60)]
    return "\n".join(collar) + "\n", "\n".join(log) + "\n"


class Tolerance(Case):
    def build(self, *options):
        collar, log = seam()
        self.write("collar.csv", collar)
        self.write("log.csv", log)
        self.inputs = ["--boreholes", "collar.csv", "--log", "log.csv", "-s_srs", "EPSG:3067", "--property", "au",
                       "--property", "rock:categorical"]
        result = self.succeed("build", *self.inputs, *options, "-o", "m.gpkg", "--report", "r.json", "--overwrite")
        return json.loads((self.folder / "r.json").read_text()), result.stderr.replace("\n          ", " ")

    def test_keeps_what_distance_loses_and_says_how_well(self):
        report, told = self.build("--tolerance", "au=0.5")
        fit = report["fidelity"]["au"]
        samples = report["fidelity"]["rock"]["count"]
        missed = round(report["fidelity"]["rock"]["rms"] ** 2 * samples)
        self.assertIn(f"rock: the class of {samples - missed} of {samples} samples is met", told)
        self.assertEqual(fit["tolerance"], 0.5)
        self.assertGreater(fit["r2"], 0.95)
        self.assertEqual(fit["beyond_tolerance"], sum(fit["reasons"].values()))
        self.assertGreater(report["refine"]["estimates"], 0)
        self.assertIsNone(report["fidelity"]["rock"]["tolerance"])
        criteria = json.loads(self.succeed("info", "--json", "m.gpkg").stdout)["criteria"]
        self.assertEqual(criteria["tolerance au"], 0.5)
        verdicts = json.loads(self.succeed("check", "--json", "m.gpkg").stdout)
        self.assertLessEqual({"T1", "T2"}, {verdict["guarantee"] for verdict in verdicts})
        coarse, told = self.build("--lmin", "10")
        self.assertLess(coarse["fidelity"]["au"]["r2"], 0.9)
        self.assertIsNone(coarse["fidelity"]["au"]["beyond_tolerance"])
        self.assertIn("--tolerance au=", told)

    def test_is_chosen_where_none_of_tolerance_lmin_and_df_max_is_given(self):
        for options in ([], ["--tolerance", "auto"]):
            report, told = self.build(*options)
            self.assertIn("tolerance", report["defaults"])
            self.assertGreater(report["fidelity"]["au"]["r2"], 0.95)
            self.assertAlmostEqual(report["fidelity"]["au"]["tolerance"], report["fidelity"]["au"]["sd"] / 2, places=3)
            self.assertIn("Defaults  --tolerance au=", told)
            digest = self.succeed("info", "--digest", "m.gpkg").stdout
            if options:
                self.assertEqual(digest, by_default)
            by_default = digest
        for options in (["--lmin", "10"], ["--df-max", "au=2"], ["--density", "paper"]):
            report, told = self.build(*options)
            self.assertIsNone(report["fidelity"]["au"]["tolerance"])

    def test_refuses_what_makes_no_sense(self):
        self.build("--lmin", "10")
        for options, saying in ((["au=0"], "au=0"), (["0.5"], "0.5"), (["cu=1"], "cu"), (["rock=1"], "category"),
                                (["auto", "--lmin", "5"], "--lmin")):
            self.fail_with(2, "build", *self.inputs, "--tolerance", *options, "-o", "n.gpkg", saying=saying)


if __name__ == "__main__":
    unittest.main()
