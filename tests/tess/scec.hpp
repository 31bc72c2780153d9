// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Real faults: the SCEC Community Barrier Model's western Transverse Ranges, Salton and Elsinore surfaces, 97 TSurf
/// files.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "tess/surface.hpp"
#include "tests/support.hpp"

namespace terratet::testing {

/// As much of a TSurf as these files use; io has the real reader.
inline Surface read_tsurf_file(const std::filesystem::path& path) {
    Surface surface;
    surface.name = path.stem().string();
    surface.file = path.filename().string();
    std::ifstream in(path);
    std::map<long, std::uint32_t> place;
    double up = 1;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "ZPOSITIVE") {
            words >> word;
            up = word == "Depth" ? -1 : 1;
        } else if (word == "VRTX" || word == "PVRTX") {
            long id = 0;
            Vec3 p;
            words >> id >> p.x >> p.y >> p.z;
            place[id] = static_cast<std::uint32_t>(surface.vertices.size());
            surface.vertices.push_back({p.x - 307200, p.y - 3788800, up * p.z});
        } else if (word == "ATOM" || word == "PATOM") {
            long id = 0;
            long of = 0;
            words >> id >> of;
            place[id] = place.at(of);
        } else if (word == "TRGL") {
            long a = 0;
            long b = 0;
            long c = 0;
            words >> a >> b >> c;
            surface.triangles.push_back({place.at(a), place.at(b), place.at(c)});
        }
    }
    return surface;
}

inline std::vector<Surface> scec_surfaces(const std::string& folder) {
    std::vector<Surface> surfaces;
    if (const auto path = public_data(folder)) {
        for (const auto& entry : std::filesystem::directory_iterator(*path)) {
            if (entry.path().extension() == ".ts") {
                surfaces.push_back(read_tsurf_file(entry.path()));
            }
        }
    }
    std::sort(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return surfaces;
}

inline std::vector<Surface> scec_surfaces() {
    std::vector<Surface> surfaces = scec_surfaces("scec_cfm/native");
    std::ranges::move(scec_surfaces("scec_cfm/alt"), std::back_inserter(surfaces));
    std::ranges::sort(surfaces, {}, &Surface::name);
    return surfaces;
}

inline Box3 box_of(const std::vector<Surface>& surfaces) {
    Box3 box;
    for (const Surface& surface : surfaces) {
        for (const Vec3& p : surface.vertices) {
            box.extend(p);
        }
    }
    return box;
}

}  // namespace terratet::testing
