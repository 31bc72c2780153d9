// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// OGR's polygons as triangles.

#include <ogrsf_frmts.h>

#include <map>
#include <string>
#include <vector>

#include "tess/surface.hpp"

namespace terratet {

/// Outer ring first; open.
using PolygonRings = std::vector<std::vector<Vec3>>;

/// Without consecutive repetitions of a point.
PolygonRings rings_of(const OGRPolygon& polygon);

/// A surface being put together from polygons, corners at equal positions joined.
class PolygonSurface {
  public:
    /// Returns why the polygon cannot be used; empty when it was.
    std::string add(const PolygonRings& rings);

    /// In canonical order: vertices sorted by coordinates, triangles from their smallest vertex on, sorted.
    [[nodiscard]] Surface finish(std::string name) const;
    [[nodiscard]] bool empty() const { return triangles_.empty(); }

  private:
    std::uint32_t index(const Vec3& p) {
        return index_.emplace(p, static_cast<std::uint32_t>(index_.size())).first->second;
    }
    std::map<Vec3, std::uint32_t> index_;
    std::vector<Triangle> triangles_;
};

/// Calls `use` with every polygon in a geometry; `refuse` with the kind of what holds none. GDAL bounds the nesting.
template <typename Use, typename Refuse>
void for_each_polygon(const OGRGeometry& geometry, const Use& use, const Refuse& refuse) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPolygon || type == wkbTriangle) {
        use(*geometry.toPolygon());
    } else if (type == wkbTIN || type == wkbPolyhedralSurface) {
        for (const OGRPolygon* patch : *geometry.toPolyhedralSurface()) {
            use(*patch);
        }
    } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
        for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
            for_each_polygon(*part, use, refuse);
        }
    } else {
        refuse(OGRGeometryTypeToName(type));
    }
}

}  // namespace terratet
