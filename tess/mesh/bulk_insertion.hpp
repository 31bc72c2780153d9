// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Many points into a triangulation, in CGAL's own order for that, asking on the way whether to go on.

#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "tess/base/poll.hpp"

namespace terratet::delaunay {

/// The points with their vertices' info; they are left in another order.
template <class Triangulation>
void insert(Triangulation& triangulation, std::vector<std::pair<typename Triangulation::Point, std::uint32_t>>& points,
            PatientPoll& go_on) {
    using Places = CGAL::First_of_pair_property_map<std::pair<typename Triangulation::Point, std::uint32_t>>;
    using Order = CGAL::Spatial_sort_traits_adapter_3<typename Triangulation::Geom_traits, Places>;
    CGAL::spatial_sort(points.begin(), points.end(), Order());
    typename Triangulation::Cell_handle near;
    for (const auto& [point, info] : points) {
        go_on();
        const typename Triangulation::Vertex_handle vertex = triangulation.insert(point, near);
        vertex->info() = info;
        near = vertex->cell();
    }
}

}  // namespace terratet::delaunay
