// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/shown_mesh.hpp"

namespace terratet {

bool shows(const OGRGeometry* geometry, const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
    if (!geometry || wkbFlatten(geometry->getGeometryType()) != wkbMultiPolygon) {
        return triangles.empty() && (!geometry || geometry->IsEmpty());
    }
    const OGRMultiPolygon& polygons = *geometry->toMultiPolygon();
    if (static_cast<std::size_t>(polygons.getNumGeometries()) != triangles.size()) {
        return false;
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const OGRLinearRing* const ring = polygons.getGeometryRef(static_cast<int>(i))->getExteriorRing();
        if (!ring || ring->getNumPoints() != 4) {
            return false;
        }
        for (int k = 0; k < 4; ++k) {
            if (Vec3{ring->getX(k), ring->getY(k), ring->getZ(k)} !=
                vertices[triangles[i][static_cast<std::size_t>(k % 3)]]) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace terratet
