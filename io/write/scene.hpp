// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What stands in the scene, before any byte of glTF. Coordinates are metres from the
/// scene's origin, y up: (east, up, −north).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/write/clipped_mesh.hpp"
#include "io/write/color_map.hpp"
#include "io/export.hpp"

namespace terratet {

/// From the model's frame to the scene's.
class SceneFrame {
  public:
    /// The origin is near the middle of the extent, where single precision is finest, on a round number.
    explicit SceneFrame(const Model& model);

    [[nodiscard]] Vec3 position(const Vec3& local) const {
        return turned(frame_.to_world_size(local - local_origin_)) * frame_.metres_per_unit;
    }
    /// Of the model's frame to one of the scene's, not of unit length.
    [[nodiscard]] Vec3 normal(const Vec3& local) const { return turned(frame_.to_local_size(local)); }
    [[nodiscard]] const Vec3& origin() const { return origin_; }  ///< in true coordinates

  private:
    [[nodiscard]] static Vec3 turned(const Vec3& v) { return {v.x, v.z, -v.y}; }

    const Frame& frame_;
    Vec3 origin_;
    Vec3 local_origin_;
};

/// How values become colours, and what a legend says about it.
class Coloring {
  public:
    /// Throws UsageError for a property or a map that does not exist.
    Coloring(const ModelView& view, const std::string& property, const std::string& map);

    /// None when the model has no property at all: everything is then drawn in one colour.
    [[nodiscard]] bool has_property() const { return property_ != nullptr; }
    [[nodiscard]] std::size_t index() const { return index_; }
    [[nodiscard]] const Property& property() const { return *property_; }
    [[nodiscard]] bool categorical() const { return property_ && property_->kind == Kind::categorical; }

    /// Ends of the map in measured units: the 2nd and 98th percentile of the vertices' values, so that an outlier does
    /// not leave one colour for all the rest.
    [[nodiscard]] double low() const;
    [[nodiscard]] double high() const;
    [[nodiscard]] Color at(double measured) const;
    [[nodiscard]] Color at_fraction(double t) const { return map_.at(t); }
    [[nodiscard]] const std::string& map_name() const { return map_name_; }

  private:
    const Property* property_ = nullptr;
    std::size_t index_ = 0;
    ColorMap map_;
    std::string map_name_;
    double low_ = 0;  ///< in the property's scale
    double high_ = 1;
};

/// Triangles to draw as one node. Columns in step with positions.
struct ScenePart {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
    std::vector<std::vector<double>> values;  ///< [property], measured units, and of the tessellation's surfaces a last
                                              ///< one, the extrapolation; empty: no values here
    bool colored = false;                     ///< by the values of the colouring's property
    Color color{1, 1, 1};                     ///< otherwise
    double opacity = 1;
    bool double_sided = true;
    bool lit = true;
};

/// "domain boundary": the extent's faces, the ground and the domain's walls, seen from within. A viewer that culls back
/// faces looks into an open box from any direction, at what is inside and at the faces behind it. Then "region N", or
/// its name, for each region that meets a fault: its walls there, seen from outside; with the domain boundary they
/// enclose it. Parts without triangles may be among them.
std::vector<ScenePart> tessellation_surfaces(const ModelView& view, const SceneFrame& frame);

/// A prepared fault's or horizon's sheet, as far as the model goes.
ScenePart fault_sheet(const Model& model, std::size_t index, const SceneFrame& frame);

/// All boreholes as tubes; without triangles when there are none.
ScenePart borehole_tubes(const ModelView& view, const Coloring& coloring, const SceneFrame& frame);

/// GLB, or glTF with its buffer embedded: one file either way.
std::string to_gltf(const std::vector<ScenePart>& parts, const Model& model, const Coloring& coloring,
                    const SceneFrame& frame, bool binary);

}  // namespace terratet
