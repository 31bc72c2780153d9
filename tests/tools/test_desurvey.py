# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten thousand random holes against a program of its own: methods, units, conventions of dip, references of azimuth."""
import math
import random
import sqlite3
import struct
import unittest

from terratet import Case

FOOT = 0.3048


def tangent(azimuth, inclination):
    a, i = math.radians(azimuth), math.radians(inclination)
    return (math.sin(i) * math.sin(a), math.sin(i) * math.cos(a), -math.cos(i))


def angle(u, v):
    """By the chord: 2 asin(|u - v| / 2), precise where the cosine is not."""
    return 2 * math.asin(min(1.0, math.dist(u, v) / 2))


def between(u, v, fraction):
    turn = angle(u, v)
    if turn < 1e-9:
        return u
    a, b = math.sin((1 - fraction) * turn) / math.sin(turn), math.sin(fraction * turn) / math.sin(turn)
    return tuple(a * p + b * q for p, q in zip(u, v))


def arc(u, v, length):
    """Where minimum curvature leads from tangent u to v."""
    turn = angle(u, v)
    ratio = 1 + turn * turn / 12 + turn ** 4 / 120 if turn < 1e-3 else 2 / turn * math.tan(turn / 2)
    return tuple(length / 2 * ratio * (p + q) for p, q in zip(u, v))


def place(collar, stations, depth, method):
    """`stations`: (depth, azimuth, inclination), ascending."""
    stations = [(0, *stations[0][1:]), *stations] if stations[0][0] > 0 else stations
    at = collar
    for k, (start, *direction) in enumerate(stations):
        u = tangent(*direction)
        last = k + 1 == len(stations)
        end = depth if last else min(depth, stations[k + 1][0])
        length = end - start
        if last or method == "tangential":
            step = tuple(length * p for p in u)
        else:
            leg, v = stations[k + 1][0] - start, tangent(*stations[k + 1][1:])
            if method == "minimum-curvature":
                step = arc(u, between(u, v, length / leg), length)
            else:
                first = min(length, leg / 2)
                step = tuple(first * p + (length - first) * q for p, q in zip(u, v))
        at = tuple(a + s for a, s in zip(at, step))
        if last or depth <= stations[k + 1][0]:
            return at


class Desurvey(Case):
    def check(self, method, convention, declination, unit, holes, seed):
        draw = random.Random(seed)
        collars, surveys, logs, expected = ["hole,x,y,z"], ["hole,depth,azimuth,dip"], ["hole,depth,v"], {}
        dips = {"down-positive": lambda i: 90 - i, "down-negative": lambda i: i - 90, "inclination": lambda i: i}[convention]
        metres = FOOT if unit == "ft" else 1
        for h in range(holes):
            collar = tuple(round(draw.uniform(-2000, 2000), 3) for _ in range(3))
            collars.append(f"H{h},{','.join(map(repr, collar))}")
            depth, stations = round(draw.choice([0, 0, draw.uniform(0, 30)]), 3), []
            azimuth, inclination = draw.uniform(0, 360), draw.choice([0, 90, 180, draw.uniform(0, 180)])
            for _ in range(draw.randint(1, 6)):
                dip = round(dips(inclination), 6)
                stations.append((depth * metres, round(azimuth, 6) + declination, {"down-positive": 90 - dip, "down-negative": 90 + dip,
                                                                                   "inclination": dip}[convention]))
                surveys.append(f"H{h},{depth!r},{round(azimuth, 6)!r},{dip!r}")
                depth = round(depth + draw.uniform(1, 100), 3)
                azimuth, inclination = (azimuth + draw.uniform(-40, 40)) % 360, min(180, max(0, inclination + draw.uniform(-30, 30)))
            for _ in range(2):
                at = round(draw.uniform(0, depth + 50), 3)
                key = len(expected)
                logs.append(f"H{h},{at!r},{key}")
                expected[key] = place(collar, stations, at * metres, method)
        for name, rows in (("c.csv", collars), ("s.csv", surveys), ("l.csv", logs)):
            self.write(name, "\n".join(rows) + "\n")
        self.succeed("build", "--boreholes", "c.csv", "--survey", "s.csv", "--log", "l.csv", "--property", "v", "-s_srs", "local", "--desurvey",
                     method, "--dip-convention", convention, "--azimuth", f"magnetic:{declination}", "--depth-unit", unit, "--lmin", "2000",
                     "--lmax", "8000", "--estimator", "nearest", "--z-scale", "1", "-q", "--overwrite", "-o", "m.gpkg")
        base = sqlite3.connect(self.folder / "m.gpkg")
        worst = 0
        count = 0
        for point, value in base.execute("SELECT geom, v FROM samples"):
            begin = 8 + {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[point[3] >> 1 & 7] + 5
            worst = max(worst, math.dist(struct.unpack("<3d", point[begin:begin + 24]), expected[round(value)]))
            count += 1
        base.close()
        self.assertEqual(count, len(expected))
        self.assertLess(worst, 1e-6)
        return worst

    def test_ten_thousand_holes_go_where_an_independent_program_says(self):
        cases = [("minimum-curvature", "down-positive", 0, "m"), ("minimum-curvature", "inclination", -7.5, "ft"),
                 ("tangential", "down-negative", 12.25, "m"), ("balanced-tangential", "inclination", 0, "ft")]
        for seed, case in enumerate(cases):
            with self.subTest(case):
                self.check(*case, 2500, seed)


if __name__ == "__main__":
    unittest.main()
