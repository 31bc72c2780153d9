// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes as a well file, by each parser: refused with an InputError, or tables with columns of equal length, whose
// stated columns are there, and paths that go down. The first byte says which parser; the rest is the file.
#include <cpl_vsi.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "io/read/logs/well_file.hpp"
#include "tess/error.hpp"

using namespace terratet;

namespace {

void require(bool holds) {
    if (!holds) {
        std::abort();
    }
}

void check_table(const Table& table) {
    const auto columns = static_cast<int>(table.columns.size());
    require(table.cells.size() == table.columns.size());
    for (const TextColumn& column : table.cells) {
        require(column.size() == table.rows());
    }
    for (const auto& [meaning, column] : table.stated.meanings) {
        require(column >= 0 && column < columns);
    }
    for (const int column : table.stated.asides) {
        require(column >= 0 && column < columns);
    }
    require(table.stated.units.empty() || table.stated.units.size() == table.columns.size());
    require(table.stated.metres_per_depth >= 0 && std::isfinite(table.stated.metres_per_depth));
}

WellFile read(std::uint8_t which, const Source& source) {
    switch (which % 6) {
        case 0:
            return read_las(source);
        case 1:
            return read_ags(source);
        case 2:
            return read_gef(source);
        case 3:
            return read_gocad_well(source);
        case 4:
            return read_rms_well(source);
        default:
            return read_well_file(source);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) {
        return 0;
    }
    Source source;
    source.path = "/vsimem/fuzz.las";
    VSIFCloseL(VSIFileFromMemBuffer(source.path.c_str(), const_cast<GByte*>(data) + 1, size - 1, FALSE));
    try {
        const WellFile file = read(data[0], source);
        check_table(file.collars);
        for (const auto* tables : {&file.surveys, &file.logs}) {
            for (const Table& table : *tables) {
                check_table(table);
                require(table.rows() > 0);
            }
        }
        for (const HolePath& path : file.paths) {
            require(!path.depths.empty() && path.depths.size() == path.points.size() && path.depths.front() >= 0);
            for (std::size_t i = 1; i < path.depths.size(); ++i) {
                require(path.depths[i] > path.depths[i - 1]);
            }
        }
    } catch (const InputError&) {
    } catch (const UsageError&) {
    }
    VSIUnlink(source.path.c_str());
    return 0;
}
