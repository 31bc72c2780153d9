# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C in the middle: one line, exit code 1, nothing left behind."""
import json
import os
import signal
import subprocess
import unittest

from terratet import PROGRAM, Case, twin_inputs


class Interrupt(Case):
    def interrupt_at(self, stage, *arguments):
        """Sends SIGINT at the first line of progress of a stage."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments), "--progress", "json"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        sent, lines = False, []
        for line in process.stderr:
            if line.startswith("{"):
                if not sent and json.loads(line)["stage"] == stage:
                    process.send_signal(signal.SIGINT)
                    sent = True
            else:
                lines.append(line)
        self.assertEqual(process.stdout.read(), "")
        process.stdout.close()
        process.stderr.close()
        code = process.wait()
        self.assertTrue(sent, f"stage {stage} was never reported")
        return code, lines

    def test_nothing_is_left_behind(self):
        inputs = twin_inputs()
        inputs[inputs.index("60m")] = "12m"  # some seconds
        code, lines = self.interrupt_at("refine", "convert", *inputs, "m.gpkg", "m.vtu", "m.vdb")
        self.assertEqual(code, 1, lines)
        self.assertEqual(lines, ["terratet: interrupted; nothing was written\n"])
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
