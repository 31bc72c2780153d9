// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real faults: the SCEC Community Fault Model's western Transverse Ranges, Salton and Elsinore surfaces, 97 TSurf
// files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

/// As much of a TSurf as these files use; io has the real reader.
Surface read_tsurf_file(const std::filesystem::path& path) {
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

std::vector<Surface> scec_surfaces() {
    std::vector<Surface> surfaces;
    for (const char* folder : {"scec_cfm/native", "scec_cfm/alt"}) {
        if (const auto path = testing::public_data(folder)) {
            for (const auto& entry : std::filesystem::directory_iterator(*path)) {
                if (entry.path().extension() == ".ts") {
                    surfaces.push_back(read_tsurf_file(entry.path()));
                }
            }
        }
    }
    std::sort(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return surfaces;
}

Box3 box_of(const std::vector<Surface>& surfaces) {
    Box3 box;
    for (const Surface& surface : surfaces) {
        for (const Vec3& p : surface.vertices) {
            box.extend(p);
        }
    }
    return box;
}

struct Tally {
    int used = 0;
    int overlapping = 0;
    int trimmed = 0;
    std::size_t crossing = 0;
};

void prepare_and_count(const std::vector<Surface>& surfaces, double spacing, std::size_t background, Tally& tally) {
    const Box3 extent = box_of(surfaces);
    const FaultPreparation preparation = prepare_faults(surfaces, extent, {}, spacing);
    REQUIRE(preparation.accounts.size() == surfaces.size());
    for (const FaultAccount& account : preparation.accounts) {
        const double sum = account.area_used + account.area_trimmed + account.area_outside + account.area_refused;
        REQUIRE(std::abs(sum - account.area_in) <= 1e-6 * account.area_in);
        REQUIRE(account.area_outside <= 1e-6 * account.area_in);
        tally.used += account.used ? 1 : 0;
        tally.overlapping += account.reason.find("overlaps") != std::string::npos ? 1 : 0;
        tally.trimmed += account.area_trimmed > 0 ? 1 : 0;
    }
    const Box3 hull = extent.grown(hull_margin({}, spacing));
    tally.crossing += testing::count_crossings(preparation.faults, hull, background, 1, 3).crossing;
}

}  // namespace

TEST_CASE("F1: 97 real faults, each alone, are used or refused, and no foreign edge crosses the used") {
    const std::vector<Surface> surfaces = scec_surfaces();
    if (surfaces.empty()) {
        WARN("public data scec_cfm is absent");
        return;
    }
    REQUIRE(surfaces.size() == 97);
    Tally tally;
    for (const Surface& surface : surfaces) {
        INFO(surface.name);
        prepare_and_count({surface}, 1500, 500, tally);
        REQUIRE(tally.crossing == 0);
    }
    CHECK(tally.used == 62);
}

TEST_CASE("F1: 97 real faults in their 26 groups are used, trimmed or refused, and no foreign edge crosses the used") {
    std::map<std::string, std::vector<Surface>> groups;  // region and fault zone
    for (Surface& surface : scec_surfaces()) {
        groups[surface.name.substr(0, 9)].push_back(std::move(surface));
    }
    if (groups.empty()) {
        WARN("public data scec_cfm is absent");
        return;
    }
    Tally tally;
    for (const auto& [name, surfaces] : groups) {
        INFO(name);
        prepare_and_count(surfaces, 2000, 1000, tally);
        REQUIRE(tally.crossing == 0);
    }
    CHECK(tally.used == 49);
    CHECK(tally.overlapping == 20);
    CHECK(tally.trimmed == 15);
}

}  // namespace terratet
