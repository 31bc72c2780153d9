// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/onto/place_mesh.hpp"

#include "tess/samples.hpp"

namespace terratet {

std::vector<Vec3> PlaceMesh::cell_centers() const {
    std::vector<Vec3> centers;
    centers.reserve(ends.size());
    std::size_t begin = 0;
    for (const std::int64_t end_number : ends) {
        const auto end = static_cast<std::size_t>(end_number);
        Vec3 sum;
        for (std::size_t i = begin; i < end; ++i) {
            sum = sum + points[static_cast<std::size_t>(nodes[i])];
        }
        centers.push_back(begin == end ? Vec3{missing, missing, missing} : sum / static_cast<double>(end - begin));
        begin = end;
    }
    return centers;
}

}  // namespace terratet
