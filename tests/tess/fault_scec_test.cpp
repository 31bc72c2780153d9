// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tests/tess/fault_cases.hpp"
#include "tests/tess/scec.hpp"

namespace terratet {
namespace {

using testing::box_of;
using testing::scec_surfaces;

struct Tally {
    int used = 0;
    int overlapping = 0;
    std::size_t triangles = 0;
    std::size_t certified = 0;
    std::size_t crossing = 0;
};

/// Whatever becomes of them, the accounts are complete and add up (F4).
void check_accounts(const std::vector<Surface>& surfaces, const BarrierPreparation& preparation, Tally& tally) {
    REQUIRE(preparation.accounts.size() == surfaces.size());
    for (const BarrierAccount& account : preparation.accounts) {
        INFO(account.name << ": " << account.reason);
        const double sum = account.area_used + account.area_trimmed + account.area_outside + account.area_refused;
        REQUIRE(std::abs(sum - account.area_in) <= 1e-6 * account.area_in);
        REQUIRE(account.area_outside <= 1e-6 * account.area_in);
        REQUIRE((account.used || !account.reason.empty()));
        REQUIRE(account.deviation_median <= account.deviation_p95);
        REQUIRE(account.deviation_p95 <= account.deviation_max);
        tally.used += account.used ? 1 : 0;
        const bool close = account.reason.find("overlaps") != std::string::npos ||
                           account.reason.find("runs alongside") != std::string::npos;
        tally.overlapping += close ? 1 : 0;
        tally.triangles += account.triangles;
        tally.certified += account.certified;
    }
}

/// The sheets with common points again.
SheetComplex complex_of(const std::vector<Barrier>& faults) {
    SheetComplex complex;
    std::map<Vec3, std::uint32_t> place;
    for (std::uint32_t f = 0; f < faults.size(); ++f) {
        for (Triangle t : faults[f].sheet.triangles) {
            for (std::uint32_t& v : t) {
                const Vec3& p = faults[f].sheet.vertices[v];
                const auto [entry, fresh] = place.try_emplace(p, static_cast<std::uint32_t>(complex.points.size()));
                if (fresh) {
                    complex.points.push_back(p);
                }
                v = entry->second;
            }
            complex.triangles.push_back(t);
            complex.sheet.push_back(f);
        }
    }
    return complex;
}

struct Wedges {
    double sharpest_deg = 180;
    double length = 0;  ///< of all junctions
};

/// Where sheets meet.
Wedges wedges(const SheetComplex& complex) {
    Wedges result;
    const EdgeTable edges(complex.triangles);
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        if (of_edge.size() > 1 && !is_smooth(complex, of_edge)) {
            const double angle = wedge_angle(complex, of_edge, e.a, e.b) * 180 / std::numbers::pi;
            result.sharpest_deg = std::min(result.sharpest_deg, angle);
            result.length += distance(complex.points[e.a], complex.points[e.b]);
        }
    }
    return result;
}

/// Of six points over each of `count` places on sheets, those that are told to be on the wrong side (F2). Where the
/// sheet bends back between place and point, the point is on the other one.
std::size_t told_wrong(const std::vector<Barrier>& faults, int count) {
    const BarrierQuery proximity(faults);
    testing::Random random(5);
    std::size_t wrong = 0;
    for (int i = 0; i < count; ++i) {
        const auto f = static_cast<std::size_t>(random.below(faults.size()));
        const auto number = static_cast<std::int32_t>(f);
        const Surface& sheet = faults[f].sheet;
        const Triangle& t = sheet.triangles[random.below(sheet.triangles.size())];
        const Vec3 a = sheet.vertices[t[0]];
        const Vec3 n = cross(sheet.vertices[t[1]] - a, sheet.vertices[t[2]] - a);
        const double u = random(0.01, 0.97);
        const Vec3 x = a + u * (sheet.vertices[t[1]] - a) + random(0.01, 0.98 - u) * (sheet.vertices[t[2]] - a);
        if (length(n) <= 1) {
            continue;
        }
        for (const double away : {1e-7, 1e-3, 0.1}) {
            for (const std::int8_t side : {std::int8_t{1}, std::int8_t{-1}}) {
                const Vec3 step = side * faults[f].spacing / length(n) * n;
                const Vec3 p = x + away * step;
                const bool bends_back = away > 1e-7 && proximity.crosses(number, x + 1e-7 * step, p);
                wrong += !bends_back && proximity.side_of(number, p) != side ? 1 : 0;
            }
        }
    }
    return wrong;
}

}  // namespace

TEST_CASE("F1: each fourth of 97 real faults alone is used or refused, and no foreign edge crosses the used") {
    const std::vector<Surface> surfaces = scec_surfaces();
    if (surfaces.empty()) {
        WARN("SKIPPED: public data scec_cfm is absent");
        return;
    }
    REQUIRE(surfaces.size() == 97);
    Tally tally;
    for (std::size_t k = 0; k < surfaces.size(); k += 4) {
        INFO(surfaces[k].name);
        const Box3 extent = box_of({surfaces[k]});
        const BarrierPreparation preparation = prepare_barriers({surfaces[k]}, extent, {}, 1500);
        check_accounts({surfaces[k]}, preparation, tally);
        const Box3 hull = extent.grown(hull_margin({}, 1500));
        tally.crossing += testing::count_crossings(preparation.barriers, hull, 500, 1, 3).crossing;
    }
    CHECK(tally.crossing == 0);
    CHECK(tally.used >= 23);  // of 25
}

TEST_CASE("F4: of 87 real faults with their alternative versions each is used, or refused for a reason") {
    std::vector<Surface> surfaces = scec_surfaces("scec_cfm/native");
    if (surfaces.empty()) {
        WARN("SKIPPED: public data scec_cfm is absent");
        return;
    }
    REQUIRE(surfaces.size() == 87);
    const Box3 extent = box_of(surfaces);
    const BarrierPreparation preparation = prepare_barriers(surfaces, extent, {}, extent.diagonal() / 100);
    Tally tally;
    check_accounts(surfaces, preparation, tally);
    CHECK(tally.used >= 20);
    CHECK(tally.overlapping >= 15);
    const Box3 hull = extent.grown(hull_margin({}, extent.diagonal() / 100));
    CHECK(testing::count_crossings(preparation.barriers, hull, 2000, 1, 3).crossing == 0);
}

namespace {

/// A fault and its neighbours, alternative versions among them.
std::vector<Surface> group(std::vector<Surface> all, std::size_t number) {
    const Vec3 middle = bounding_box(all[number * all.size() / 30].vertices).center();
    std::ranges::stable_sort(
        all, {}, [&](const Surface& surface) { return distance(bounding_box(surface.vertices).center(), middle); });
    all.resize(25 + number % 6);
    return all;
}

/// Prepares the group and counts what crosses. Returns what came of it, a line of a table.
std::string prepare_group(std::size_t number, SeedMode mode, double spacing) {
    const std::vector<Surface> surfaces = group(scec_surfaces(), number);
    const Box3 extent = box_of(surfaces);
    BarrierOptions options;
    options.mode = mode;
    INFO("group " << number << (mode == SeedMode::paired ? ", paired" : ", exact"));
    const std::clock_t begin = std::clock();
    const BarrierPreparation preparation = prepare_barriers(surfaces, extent, {}, spacing, options);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    Tally tally;
    check_accounts(surfaces, preparation, tally);
    CHECK(tally.used > 0);
    CHECK(testing::count_crossings(preparation.barriers, extent.grown(hull_margin(options, spacing)), 1000, 1, 3)
              .crossing == 0);
    std::map<std::string, int> reasons;
    for (const BarrierAccount& account : preparation.accounts) {
        if (!account.used) {
            ++reasons[account.reason.substr(0, account.reason.find_first_of(":'(,"))];
        }
    }
    std::ostringstream line;
    line << "| " << number << " | " << (mode == SeedMode::paired ? "paired" : "exact") << " | " << surfaces.size()
         << " | " << tally.triangles << " | " << seconds << " | " << tally.used << " |";
    for (const auto& [reason, count] : reasons) {
        line << " " << count << " " << reason << ";";
    }
    line << " |\n";
    return line.str();
}

}  // namespace

TEST_CASE("F1, F4: of real neighbours, alternatives among them, some are used and nothing crosses them") {
    if (scec_surfaces().empty()) {
        WARN("SKIPPED: public data scec_cfm is absent");
        return;
    }
    prepare_group(5, SeedMode::exact, 6000);
    prepare_group(20, SeedMode::paired, 6000);
}

TEST_CASE("F1, F4: so it is of thirty groups of 25 to 30 at half the spacing", "[.][long]") {
    if (scec_surfaces().empty()) {
        WARN("SKIPPED: public data scec_cfm is absent");
        return;
    }
    for (std::size_t number = 0; number < 30; ++number) {
        std::cout << prepare_group(number, SeedMode::paired, 3000) << std::flush;
        std::cout << prepare_group(number, SeedMode::exact, 3000) << std::flush;
    }
}

TEST_CASE("F1, F2: fifteen real faults that meet make one conforming model, most of it certified") {
    std::vector<Surface> surfaces;
    for (Surface& surface : scec_surfaces()) {
        for (const char* part :
             {"VNTB-Ventura_fault_steep", "PPTV-Pitas_Point_fault_east", "RDMT-Red_Mountain_fault_S_strand",
              "VNTB-Southern_San_Cayetano_fault_steep", "ORFZ-MULT-Oak_Ridge", "ORFZ-OFFS-Mid_Channel",
              "ORFZ-SFNV-Northridge_Frew", "SCLV-Del_Valle", "SCLV-Holser", "SCFZ-TOPA-San_Cayetano",
              "MSNH-Mission_Hills", "SFNV-Northridge_Hills", "SFNV-San_Fernando", "SSFZ-MULT-Santa_Susana",
              "SSRZ-MULT-Simi"}) {
            if (surface.name.find(part) != std::string::npos) {
                surfaces.push_back(std::move(surface));
                break;
            }
        }
    }
    if (surfaces.empty()) {
        WARN("SKIPPED: public data scec_cfm is absent");
        return;
    }
    REQUIRE(surfaces.size() == 15);
    const Box3 extent = box_of(surfaces);
    BarrierOptions options;
    options.mode = SeedMode::exact;
    const BarrierPreparation preparation = prepare_barriers(surfaces, extent, {}, 1000, options);
    Tally tally;
    check_accounts(surfaces, preparation, tally);
    CHECK(tally.used == 15);
    CHECK(static_cast<double>(tally.certified) >= 0.9 * static_cast<double>(tally.triangles));
    const Box3 hull = extent.grown(hull_margin(options, 1000));
    const auto counted = testing::count_crossings(preparation.barriers, hull, 20000, 1, 3);
    CHECK(counted.paired > 100'000);
    CHECK(counted.crossing == 0);

    const SheetComplex complex = complex_of(preparation.barriers);
    CHECK(crossing_triangles(complex).empty());
    const Wedges measured = wedges(complex);
    CHECK(measured.length > 200'000);
    CHECK(measured.sharpest_deg >= 10);
    CHECK(told_wrong(preparation.barriers, 170'000) == 0);
}

}  // namespace terratet
