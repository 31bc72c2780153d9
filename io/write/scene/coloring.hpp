// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How values become colours, and what a legend says about it.

#include <string>
#include <vector>

#include "io/export.hpp"
#include "io/style/color_map.hpp"
#include "io/style/color_range.hpp"
#include "io/style/number_text.hpp"

namespace terratet {

struct LegendTick {
    double value = 0;     ///< measured
    double fraction = 0;  ///< of the map, 0…1
    std::string label;
};

/// Round numbers in the range: for log10 decades, with 2 and 5 between where there are few.
std::vector<LegendTick> legend_ticks(const Property& property, const ColorRange& range);

class Coloring {
  public:
    /// Throws UsageError for a property or a map that does not exist.
    Coloring(const ModelView& view, const std::string& property, const std::string& map);

    /// None when the model has no property at all: fault blocks are then told apart.
    [[nodiscard]] bool has_property() const { return property_ != nullptr; }
    [[nodiscard]] std::size_t index() const { return index_; }
    [[nodiscard]] const Property& property() const { return *property_; }
    [[nodiscard]] bool categorical() const { return property_ != nullptr && property_->kind == Kind::categorical; }

    /// Ends of the map in measured units.
    [[nodiscard]] double low() const;
    [[nodiscard]] double high() const;
    [[nodiscard]] const ColorRange& range() const { return range_; }
    [[nodiscard]] Color at(double measured) const;
    [[nodiscard]] Color at_fraction(double t) const { return map_.at(t); }
    [[nodiscard]] const std::string& map_name() const { return map_name_; }

  private:
    const Property* property_ = nullptr;
    std::size_t index_ = 0;
    ColorMap map_;
    std::string map_name_;
    ColorRange range_;
};

}  // namespace terratet
