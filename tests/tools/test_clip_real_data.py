# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with real faults that end at the extent, read by VTK."""
import unittest

from test_clip import ClipCase
from test_real_data import SCEC, made_up_wells


class ClipRealData(ClipCase):
    @unittest.skipUnless(SCEC.exists(), "public data set scec_cfm is not there")
    def test_real_faults_through_the_extent_leave_few_sharp_cells_and_all_are_counted(self):
        files = [path for path in sorted(SCEC.rglob("*.ts"))
                 if any(part in path.name for part in ("ORFZ-MULT-Oak_Ridge", "SCFZ-TOPA-San_Cayetano", "SSFZ-MULT-Santa_Susana"))]
        collars, log = made_up_wells((225500, 3777000, 382700, 3828600), 40)
        extent = (290000, 3790000, -12000, 350000, 3815000, 0)
        self.succeed("build", "--boreholes", self.write("collar.csv", collars), "--log", self.write("log.csv", log),
                     *[argument for path in files[:3] for argument in ("--faults", path)], "-s_srs", "EPSG:32611", "-te", *extent,
                     "--property", "value", "--estimator", "idw", "--fault-spacing", "3000", "--lmin", "2500", "--lmax", "10000", "--z-scale", "1", "-o", "m.gpkg")
        account = self.export("clip.vtu")
        shapes = self.check("clip.vtu", extent, 2500)
        for key in ("cells", "below_1_deg", "below_10_deg", "short_edges"):
            self.assertEqual(shapes[key], account[key], key)
        self.assertLess(account["other"] + account["as_tessellated"], 0.001 * shapes["cells"])


if __name__ == "__main__":
    unittest.main()
