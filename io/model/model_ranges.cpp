// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "interp/estimator_plan.hpp"
#include "io/base/crs.hpp"
#include "io/base/lower_case.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/storable.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

class Ranges {
  public:
    Ranges(const Model& model, std::string file) : model_(model), file_(std::move(file)) {}

    void frame();
    void properties(const std::vector<std::string>& columns, const std::vector<std::string>& censored_columns);
    void criteria();
    void barrier_options();
    void domain();
    void regions();
    void estimator();

  private:
    [[noreturn]] void fail(const char* key, const std::string& what) const {
        throw InputError(file_ + ": layer " + schema::meta + ", key " + key + ": " + what +
                         "; no model can have been built with it");
    }
    void require(bool good, const char* key, const char* name, double found, const char* wanted) const {
        if (!good) {
            char text[40];
            std::snprintf(text, sizeof text, "%.17g", found);
            fail(key, std::string(name) + " is " + text + ", not " + wanted);
        }
    }
    /// A length that may be 0 for a default.
    void require_length(double found, const char* key, const char* name) const {
        require(found >= 0 && found <= max_coordinate, key, name, found, "a length from 0 to 1e9");
    }
    void require_texts() const;
    void require_box(const Box3& box, const char* name) const;
    /// As the command would refuse it; what is only for people who give options reads well enough.
    template <class Check>
    void require_as_given(const char* key, const Check& check) const {
        try {
            check();
        } catch (const UsageError& error) {
            fail(key, error.what());
        }
    }

    const Model& model_;
    std::string file_;
};

void Ranges::require_texts() const {
    std::vector<std::pair<const char*, std::string>> texts = {
        {"frame", model_.frame.crs_wkt}, {"frame", model_.frame.crs_name}, {"frame", model_.frame.unit}};
    for (const Property& property : model_.properties) {
        texts.insert(texts.end(), {{"properties", property.name}, {"properties", property.unit}});
        for (const std::string& name : property.classes) {
            texts.emplace_back("properties", name);
        }
    }
    for (const RegionName& named : model_.region_names) {
        texts.emplace_back("regions", named.name);
    }
    for (const auto& [key, text] : texts) {
        if (!is_storable(text)) {
            fail(key, "a text holds a NUL");
        }
    }
}

void Ranges::frame() {
    require_texts();
    const Frame& f = model_.frame;
    require(f.metres_per_unit >= 1e-6 && f.metres_per_unit <= 1e6, "frame", "metres_per_unit", f.metres_per_unit,
            "between 1e-6 and 1e6");
    require(f.z_scale >= 1e-3 && f.z_scale <= 1e3, "frame", "z_scale", f.z_scale, "between 0.001 and 1000");
    for (int axis = 0; axis < 3; ++axis) {
        require(std::abs(f.origin[axis]) <= max_coordinate, "frame", "origin", f.origin[axis], "a place within 1e9");
    }
    if (!f.crs_wkt.empty()) {
        require_as_given("frame", [&] { parse_crs(f.crs_wkt); });
    }
}

void Ranges::properties(const std::vector<std::string>& columns, const std::vector<std::string>& censored_columns) {
    std::set<std::string> names;
    for (const Property& property : model_.properties) {
        if (property.name.empty() || !names.insert(property.name).second) {
            fail("properties", "the name \"" + property.name + "\" is empty or occurs twice");
        }
        const bool categorical = property.kind == Kind::categorical;
        const std::set<std::string> classes(property.classes.begin(), property.classes.end());
        if (classes.size() != property.classes.size() || (!categorical && !classes.empty())) {
            fail("properties", "a class of " + property.name + " occurs twice, or it is no category");
        }
        if (categorical && property.scale == Scale::log10) {
            fail("properties", property.name + " is a category with a logarithm");
        }
    }
    std::set<std::string> taken = schema::reserved_columns();
    for (const auto* list : {&columns, &censored_columns}) {
        for (const std::string& column : *list) {
            const bool none = list == &censored_columns && column.empty();
            if (!none && (column.empty() || !taken.insert(lower_case(column)).second)) {
                fail("properties", "the column \"" + column + "\" has another meaning, or occurs twice");
            }
        }
    }
}

void Ranges::criteria() {
    const Criteria& c = model_.criteria;
    require(c.l_min > 0 && c.l_min <= max_coordinate, "criteria", "l_min", c.l_min, "a length above 0, up to 1e9");
    require(c.l_max >= c.l_min && c.l_max <= 10 * max_coordinate, "criteria", "l_max", c.l_max,
            "a length from l_min to 1e10");
    require_as_given("criteria", [&] { validate(c); });
    if (c.variation.size() > model_.properties.size()) {  // what is known of a property's uncertainty has none
        fail("criteria", "there are " + std::to_string(c.variation.size()) + " limits of variation for " +
                             std::to_string(model_.properties.size()) + " properties");
    }
    for (const VariationLimits& limits : c.variation) {
        if (!is_finite(limits.trend)) {
            fail("criteria", "the trend of a property is not finite");
        }
    }
    for (const FinePlace& place : c.fine) {
        require(place.l_min > 0 && place.l_min <= max_coordinate, "criteria", "l_min of a fine place", place.l_min,
                "a length above 0, up to 1e9");
        if (!is_acceptable(place.position)) {
            fail("criteria", "a fine place is none within 1e9");
        }
    }
    for (const ResolutionOverride& part : c.overrides) {
        require(part.l_max <= 10 * max_coordinate, "criteria", "l_max of a part", part.l_max, "a length up to 1e10");
        if (part.where == ResolutionOverride::Where::box ? !is_acceptable(part.box.lo) || !is_acceptable(part.box.hi)
                                                         : !is_acceptable(part.point)) {
            fail("criteria", "a part with its own resolution is no place within 1e9");
        }
    }
}

void Ranges::barrier_options() {
    const BarrierOptions& o = model_.barrier_options;
    require_length(o.spacing, "fault_options", "spacing");
    require_length(o.width, "fault_options", "width");
    require_length(o.snap, "fault_options", "snap");
}

void Ranges::require_box(const Box3& box, const char* name) const {
    for (int axis = 0; axis < 3; ++axis) {
        require(std::abs(box.lo[axis]) <= max_coordinate, "domain", name, box.lo[axis], "a box within 1e9");
        require(std::abs(box.hi[axis]) <= max_coordinate, "domain", name, box.hi[axis], "a box within 1e9");
        require(box.lo[axis] < box.hi[axis], "domain", name, box.hi[axis] - box.lo[axis], "long along each axis");
    }
}

void Ranges::domain() {
    const Domain& d = model_.domain;
    require_box(d.extent, "extent");
    require_box(d.hull, "hull");
    for (int axis = 0; axis < 3; ++axis) {
        require(d.hull.lo[axis] <= d.extent.lo[axis] && d.hull.hi[axis] >= d.extent.hi[axis], "domain", "hull",
                d.hull.lo[axis], "a box that holds the extent");
    }
    for (const auto& ring : d.outline) {
        if (ring.size() < 3 || !std::all_of(ring.begin(), ring.end(), is_acceptable)) {
            fail("domain", "a ring of the outline has fewer than three corners, or one beyond 1e9");
        }
    }
}

void Ranges::regions() {
    for (const RegionName& named : model_.region_names) {
        if (!is_acceptable(named.point)) {
            fail("regions", "the point of \"" + named.name + "\" is no place within 1e9");
        }
    }
}

void Ranges::estimator() {
    require_as_given("estimator", [&] { parse_estimator_plan(model_.estimator); });
}

}  // namespace

void require_ranges(const Model& model, const std::vector<std::string>& columns,
                    const std::vector<std::string>& censored_columns, const std::string& file) {
    Ranges ranges(model, file);
    ranges.frame();
    ranges.properties(columns, censored_columns);
    ranges.criteria();
    ranges.barrier_options();
    ranges.domain();
    ranges.regions();
    ranges.estimator();
}

}  // namespace terratet
