#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules by which ArcGIS takes a netCDF file as a voxel layer ("Supported voxel formats", doc.arcgis.com), and those of
the CF conventions 1.8 that such a file touches, each a test: check_netcdf.py FILE.nc"""
import re
import shutil
import subprocess
import sys
import unittest

import netCDF4
import numpy
from osgeo import gdal, osr

gdal.UseExceptions()
PATH = sys.argv.pop(1)


class Rules(unittest.TestCase):
    def setUp(self):
        self.file = netCDF4.Dataset(PATH)
        self.addCleanup(self.file.close)
        self.fields = [v for v in self.file.variables.values() if v.ndim == 3]

    def test_the_file_says_which_conventions_it_keeps(self):
        self.assertEqual(self.file.Conventions, "CF-1.8")

    def test_axes_are_dimension_variables_with_units(self):
        for axis in "xyz":
            self.assertEqual(self.file[axis].dimensions, (axis,))
            self.assertEqual(self.file[axis].units, "m")
            self.assertEqual(self.file[axis].axis, axis.upper())

    def test_z_says_which_way_is_up(self):
        self.assertEqual(self.file["z"].positive, "up")

    def test_steps_are_equal_and_ascending_in_double_precision(self):
        for axis in "xyz":
            places = self.file[axis][:].data
            self.assertEqual(places.dtype, numpy.float64)
            steps = numpy.diff(places)
            self.assertGreater(steps.min(), 0)
            self.assertLess(numpy.ptp(steps), 1e-12 * abs(places).max())

    def test_variables_are_in_the_order_z_y_x(self):
        self.assertGreater(len(self.fields), 2)
        for field in self.fields:
            self.assertEqual(field.dimensions, ("z", "y", "x"))

    def test_there_are_no_auxiliary_coordinates_nor_bounds(self):
        known = {"x", "y", "z", "crs", *(field.name for field in self.fields)}
        self.assertEqual(set(self.file.variables), known)
        for field in [*self.fields, *(self.file[axis] for axis in "xyz")]:
            self.assertFalse({"coordinates", "bounds", "ancillary_variables"} & set(field.ncattrs()))

    def test_names_are_letters_digits_and_underscores(self):
        for name in self.file.variables:
            self.assertRegex(name, "^[A-Za-z_][A-Za-z0-9_]*$")

    def test_every_variable_names_its_grid_mapping(self):
        for field in self.fields:
            self.assertEqual(field.grid_mapping, "crs")
        for axis in "xy":
            self.assertEqual(self.file[axis].standard_name, f"projection_{axis}_coordinate")

    def test_the_grid_mapping_names_projection_ellipsoid_wkt_and_esris_string(self):
        crs = self.file["crs"]
        self.assertEqual(crs.ndim, 0)
        self.assertEqual(crs.grid_mapping_name, "transverse_mercator")
        self.assertAlmostEqual(crs.longitude_of_central_meridian, 27)
        self.assertAlmostEqual(crs.scale_factor_at_central_meridian, 0.9996)
        self.assertAlmostEqual(crs.inverse_flattening, 298.257222101)
        self.assertTrue(crs.esri_pe_string.startswith("PROJCS["))
        self.assertIn("3067", crs.crs_wkt)

    def test_gdal_finds_place_and_system(self):
        file = gdal.Open(f'NETCDF:"{PATH}":{self.fields[0].name}')
        x, y = self.file["x"][:], self.file["y"][:]
        self.assertEqual(file.GetGeoTransform()[0], x[0] - (x[1] - x[0]) / 2)
        self.assertEqual(file.GetGeoTransform()[3], y[-1] + (y[1] - y[0]) / 2)
        reference = osr.SpatialReference()
        reference.ImportFromEPSG(3067)
        self.assertTrue(file.GetSpatialRef().IsSame(reference, ["CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS"]))

    def test_categories_are_integers_with_flag_meanings(self):
        categories = [field for field in self.fields if field.dtype == numpy.int32]
        self.assertEqual(sorted(field.name for field in categories), ["lithology", "region"])
        for field in categories:
            meanings = field.flag_meanings.split()
            self.assertEqual(list(field.flag_values), list(range(len(meanings))))
            used = numpy.unique(field[:].compressed())
            self.assertTrue(set(used) <= set(range(len(meanings))))

    def test_missing_values_are_marked_and_no_number_is_left_that_is_none(self):
        for field in self.fields:
            self.assertIn("_FillValue", field.ncattrs())
            self.assertTrue(numpy.isfinite(field[:].compressed()).all())

    def test_continuous_variables_have_units(self):
        for field in self.fields:
            if field.dtype == numpy.float32:
                self.assertTrue(field.units)

    @unittest.skipUnless(shutil.which("ncdump"), "no ncdump")
    def test_ncdump_reads_all_of_it(self):
        done = subprocess.run(["ncdump", "-v", "z", PATH], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(re.search(r"data:\s+z = ", done.stdout))


if __name__ == "__main__":
    unittest.main()
