# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made from the declarations of the options: usage as JSON, completion, man pages; and what a slip is met with."""
import json
import shutil
import subprocess
import unittest

from terratet import Case


class Usage(Case):
    def usage_json(self):
        return json.loads(self.succeed("--json-usage").stdout)

    def test_the_usage_as_json_holds_every_option_that_the_help_shows(self):
        for command in self.usage_json()["commands"]:
            text = self.succeed("help", command["name"]).stdout
            listed = {line.split()[0].rstrip(",") for line in text.splitlines() if line.startswith("  -")}
            described = {option["names"][0] for group in command["groups"] for option in group["options"]}
            self.assertEqual(listed, described, command["name"])
            for group in command["groups"]:
                for option in group["options"]:
                    self.assertEqual(option["type"] == "switch", option["value"] == "", option)
                    self.assertEqual(option["type"] == "length", option["value"] == "LENGTH", option)

    def completed(self, *words):
        """What bash offers for the last word."""
        script = self.folder / "completion.bash"
        if not script.exists():
            script.write_text(self.succeed("completion", "bash").stdout)
        line = " ".join(f"'{word}'" for word in ("terratet", *words))
        asked = f"source '{script}'; COMP_WORDS=({line}); COMP_CWORD={len(words)}; _terratet; printf '%s\\n' \"${{COMPREPLY[@]}}\""
        return subprocess.run(["bash", "-euc", asked], cwd=self.folder, capture_output=True, text=True, check=True).stdout.split()

    def test_bash_completes_commands_options_topics_and_files(self):
        (self.folder / "collar.csv").touch()
        self.assertEqual(self.completed("conv"), ["convert"])
        self.assertEqual(self.completed("help", "est"), ["estimators"])
        self.assertEqual(self.completed("convert", "--fault-w"), ["--fault-width"])
        self.assertEqual(self.completed("convert", "--boreholes", "col"), ["collar.csv"])
        self.assertEqual(self.completed("convert", "--fault-mode", ""), ["paired", "exact"])
        self.assertEqual(self.completed("export", "m.gpkg", "--color-map", "ci"), ["cividis"])
        self.assertEqual(self.completed("export", "m.gpkg", "--of", "VO"), ["VOXELTILES"])
        for command in self.usage_json()["commands"]:
            for group in command["groups"]:
                names = [name for option in group["options"] for name in option["names"]]
                self.assertLessEqual(set(names), set(self.completed(command["name"], "-")))

    def test_the_shells_themselves_accept_the_scripts(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.folder / f"completion.{shell}"
            script.write_text(self.succeed("completion", shell).stdout)
            if shutil.which(shell) is None:
                print(f"skipped: {shell} is not installed")
                continue
            subprocess.run([shell, "-n", str(script)], check=True)

    def test_a_man_page_tells_all_options_and_hides_no_line_from_roff(self):
        macros = {".TH", ".SH", ".SS", ".TP", ".B", ".BR", ".nf", ".fi"}
        for command in [None, *self.usage_json()["commands"]]:
            page = self.succeed("--man", *([command["name"]] if command else [])).stdout
            for line in page.splitlines():
                self.assertFalse(line.startswith("'"), line)
                self.assertTrue(not line.startswith(".") or line.split()[0] in macros, line)
            for group in command["groups"] if command else []:
                for option in group["options"]:
                    self.assertIn("\\fB" + option["names"][0].replace("-", "\\-") + "\\fR", page)
            if shutil.which("groff"):
                warnings = subprocess.run(["groff", "-man", "-Kutf8", "-ww", "-z"], input=page, capture_output=True, text=True)
                self.assertEqual(warnings.stderr, "")

    def test_the_bare_name_shows_a_short_usage(self):
        result = self.run_terratet()
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout, "")
        self.assertIn("Usage: terratet COMMAND", result.stderr)
        self.assertLess(len(result.stderr.splitlines()), 15)

    def test_a_slip_is_met_with_the_nearest_word_at_every_level(self):
        for arguments, meant in ((["--verison"], "--version"), (["exprot"], "export"), (["help", "estimatros"], "estimators"),
                                 (["convert", "--fault-mod", "exact", "o.vtu"], "--fault-mode"),
                                 (["convert", "--samples", "s.csv", "--fault-mode", "exakt", "o.vtu"], "exact"),
                                 (["completion", "bsh"], "bash")):
            result = self.run_terratet(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(f"did you mean {meant}?", result.stderr)
        samples = self.write("s.csv", "x,y,z,grade\n1,2,3,4\n2,2,3,5\n1,3,3,6\n1,2,5,6\n")
        for arguments, meant in ((["--estimator", "krigng"], "kriging"), (["--estimator", "IDW"], "idw"),
                                 (["--estimator", "idw:powre=3"], "power"), (["--lmin", "20usf"], "usft"),
                                 (["--estimator", "kriging:model=spherica"], "spherical"), (["--of", "vtk"], "VTU"),
                                 (["--color-map", "virids"], "viridis"), (["--property", "grade:lg10"], "log10"),
                                 (["--df-max", "grad=1"], "grade"),
                                 (["--color", "grades"], "grade"), (["--iso", "grad=1"], "grade"),
                                 (["--horizon", "sofd"], "soft"), (["--azimuth", "gird"], "grid"),
                                 (["-co", "COMPRES=YES"], "COMPRESS"), (["--fault-gap", "colapse"], "collapse"),
                                 (["--progress", "jsn"], "json"), (["--columns", "deph=a"], "depth"),
                                 (["--samples", "s.csv,laier=a"], "layer"), (["--density", "papre"], "paper")):
            result = self.run_terratet("convert", "--samples", samples, "-s_srs", "local", *arguments, "o.glb")
            self.assertIn(f"did you mean {meant}?", " ".join(result.stderr.split()), arguments)
            self.assertEqual(result.returncode, 2, arguments)
        self.assertIn("did you mean .vtu?", self.run_terratet("convert", "--samples", samples, "o.vtuu").stderr)
        for verb in ("undo", "remove-borehole"):
            result = self.run_terratet(verb, "m.gpkg")
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"terratet edit MODEL.gpkg {verb}", result.stderr)


if __name__ == "__main__":
    unittest.main()
