// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One row after the other into a layer of the model file: by OGR into a new model (model_layer.hpp), by SQLite into
/// one that is edited (stored_edit.cpp). A layer's columns are written down once (model_schema.hpp) and serve both, and
/// reading as well.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <ogr_geometry.h>

#include "tess/geometry.hpp"

namespace terratet {

/// A column's place in its layer.
using Column = int;

class RowWriter {
  public:
    virtual ~RowWriter() = default;

    /// Columns, all before the first row.
    virtual Column number(const std::string& name) = 0;
    virtual Column integer(const std::string& name) = 0;
    virtual Column text(const std::string& name) = 0;
    virtual Column bytes(const std::string& name) = 0;

    /// Makes the layer, where there is none. Throws Error, naming the file, as do all functions that write.
    virtual void create() = 0;

    /// Cells of the row to come; what is not set is null.
    virtual void set(Column column, double value) = 0;  ///< NaN is null
    virtual void set(Column column, std::int64_t value) = 0;
    virtual void set(Column column, const std::string& value) = 0;
    virtual void set(Column column, std::span<const std::byte> value) = 0;
    virtual void set_point(const Vec3& position) = 0;
    virtual void set_geometry(std::unique_ptr<OGRGeometry> geometry) = 0;

    /// Writes the row.
    virtual void write() = 0;

    /// After the last one.
    virtual void finish() {}
};

}  // namespace terratet
