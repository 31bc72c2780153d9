// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/logs/well_file.hpp"

#include "io/base/library_failure.hpp"
#include "tess/error.hpp"

namespace terratet {

WellFile read_well_file(const Source& source) {
    return naming_file(source.describe(), [&] {
        switch (well_format(source.path)) {
            case WellFormat::las:
                return read_las(source);
            case WellFormat::ags:
                return read_ags(source);
            case WellFormat::gef:
                return read_gef(source);
            case WellFormat::gocad:
                return read_gocad_well(source);
            case WellFormat::rms:
                return read_rms_well(source);
            case WellFormat::none:
                break;
        }
        throw InputError(source.describe() + ": is no well log that is known (LAS, AGS, GEF, GOCAD well, RMS well)");
    });
}

}  // namespace terratet
