# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C in the middle: one line, exit code 1, nothing left behind."""
import json
import os
import random
import signal
import subprocess
import time
import unittest

from terratet import PROGRAM, Case, twin_inputs


THREADS = 2
PROMISED = 0.3  # seconds


def processor_seconds(process):
    """What a process has used so far."""
    with open(f"/proc/{process.pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


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

    def test_so_it_is_while_faults_lose_their_width(self):
        self.succeed("build", *twin_inputs(), "--fault-mode", "exact", "-o", "m.gpkg")
        for stage in ("collapse faults", "mend cells"):
            code, lines = self.interrupt_at(stage, "export", "--fault-gap", "collapse", "m.gpkg", "m.vtu")
            self.assertEqual((code, lines), (1, ["terratet: interrupted; nothing was written\n"]), stage)
            self.assertEqual(os.listdir(self.folder), ["m.gpkg"])

    def stop_after(self, seconds, *arguments):
        """Sends SIGTERM then; returns how long the program took to end, by the clock and of a processor, and whether
        it was interrupted; None when it had ended before."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        try:
            process.wait(seconds)
            process.stderr.close()
            return None
        except subprocess.TimeoutExpired:
            used = processor_seconds(process)
            os.kill(process.pid, signal.SIGTERM)
        begin = time.monotonic()
        said = process.stderr.read()
        process.stderr.close()
        _, status, usage = os.wait4(process.pid, 0)
        took = time.monotonic() - begin, usage.ru_utime + usage.ru_stime - used
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode == -signal.SIGTERM:  # before it had begun
            return None
        self.assertIn(process.returncode, (0, 1), said)
        if process.returncode == 1:
            *before, last = said.splitlines()
            self.assertTrue(all(line.startswith("Voxels ") for line in before), said)  # sizes are said beforehand
            self.assertTrue(last.startswith("terratet: interrupted; "), said)
        return *took, process.returncode == 1

    def test_at_any_moment_it_stops_at_once_and_leaves_whole_files_or_none(self):
        inputs = twin_inputs()
        inputs[inputs.index("60m")] = "16m"  # so long that most of it is left at most moments
        begin = time.monotonic()
        self.succeed("build", *inputs, "-o", "twin.gpkg")
        build_takes = time.monotonic() - begin
        moments = random.Random(3)
        stopped = 0
        at_rest = True
        for command in (["convert", *inputs, "m.gpkg", "m.vtu", "m.gltf"], ["check", "twin.gpkg"],
                        ["export", "twin.gpkg", "m.vdb", "m.csv", "--voxel-size", "5"]):
            clock = []
            for _ in range(4):
                took = self.stop_after(moments.uniform(0.02, build_takes), *command, "--threads", THREADS)
                at_rest = at_rest and os.getloadavg()[0] < os.cpu_count()
                if took is not None:
                    stopped += took[2]
                    clock.append(took[0])
                    self.assertLess(took[1], PROMISED * THREADS)  # a busy machine gives less, so this always holds
                left = set(os.listdir(self.folder)) - {"twin.gpkg"}
                self.assertLessEqual(left, {"m.gpkg", "m.vtu", "m.gltf", "m.vdb", "m.csv"}, command)
                if "m.gpkg" in left:
                    self.succeed("check", "m.gpkg")
                for name in left:
                    os.remove(self.folder / name)
            if at_rest and clock:
                self.assertLess(min(clock), PROMISED, command)
            self.assertLess(max(clock, default=0), 5, command)
        self.assertGreater(stopped, 3)


if __name__ == "__main__":
    unittest.main()
