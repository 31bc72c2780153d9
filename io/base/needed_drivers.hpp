// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which of GDAL's drivers there are in a program of ours.

namespace terratet {

/// For a program that uses GDAL through Terratet alone: takes out all of its drivers but those that readers and writers
/// use, so that a file which has another opened (an overview beside a raster, say) finds none. Some call servers that
/// the file names, some hang on hostile files. Once, at the start.
void keep_needed_gdal_drivers();

}  // namespace terratet
