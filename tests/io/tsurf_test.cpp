// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/read/surfaces/read_surfaces.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Result {
    std::vector<Surface> surfaces;
    Diagnostics diagnostics;
};

Result read(const std::string& path, const std::string& srs = {}) {
    Result result;
    Source source;
    source.path = path;
    source.srs = srs;
    result.surfaces = read_tsurf(source, SurfaceKind::fault, result.diagnostics).surfaces;
    return result;
}

/// Reads a text as if it were the file "some fault.ts".
Result parse(const std::string& text, const std::string& srs = {}) {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "some fault.ts";
    std::ofstream(path, std::ios::binary) << text;
    return read(path, srs);
}

const std::string square = "VRTX 1 0 0 0\nVRTX 2 10 0 1\nVRTX 3 10 10 2\nVRTX 4 0 10 3\nTRGL 1 2 3\nTRGL 1 3 4\n";

std::string object(const std::string& header, const std::string& body) {
    return "GOCAD TSurf 1\n" + header + "TFACE\n" + body + "END\n";
}

/// An independent count: lines by their first word.
struct Count {
    std::size_t objects = 0, vertices = 0, triangles = 0;
};
Count count_lines(const fs::path& path) {
    Count count;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word, next;
        words >> word >> next;
        count.objects += word == "GOCAD" && next == "TSurf";
        count.vertices += word == "VRTX" || word == "PVRTX";
        count.triangles += word == "TRGL";
    }
    return count;
}

Count count_surfaces(const Result& result) {
    Count count;
    count.objects = result.surfaces.size();
    for (const Surface& surface : result.surfaces) {
        count.vertices += surface.vertices.size();
        count.triangles += surface.triangles.size();
    }
    return count;
}

Count check_folder(const fs::path& folder) {
    Count total;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".ts") {
            continue;
        }
        INFO(entry.path());
        REQUIRE(is_gocad(entry.path().string()));
        const Result result = read(entry.path().string());
        const Count expected = count_lines(entry.path()), got = count_surfaces(result);
        CHECK(got.objects == expected.objects);
        CHECK(got.vertices == expected.vertices);
        CHECK(got.triangles == expected.triangles);
        CHECK(result.diagnostics.rejected.empty());
        total.objects += got.objects;
        total.vertices += got.vertices;
        total.triangles += got.triangles;
    }
    return total;
}

bool rejected(const Result& result, std::int64_t line, const std::string& reason) {
    return std::any_of(result.diagnostics.rejected.begin(), result.diagnostics.rejected.end(), [&](const Rejected& r) {
        return r.line == line && r.reason.find(reason) != std::string::npos &&
               r.file.find("some fault.ts") < r.file.size();
    });
}

}  // namespace

TEST_CASE("The SCEC community fault model reads whole, counted by another way") {
    const auto folder = testing::public_data("scec_cfm");
    if (!folder) {
        WARN("SKIPPED: public data not found: scec_cfm");
        return;
    }
    const Count total = check_folder(*folder);
    CHECK(total.objects == 97);
    CHECK(total.vertices == 41479);
    CHECK(total.triangles == 73433);
}

TEST_CASE("TSurf files of LoopStructural and OpenGeode read whole, counted by another way") {
    const auto loop = testing::public_data("loop_implicitbenchmark");
    const auto geode = testing::public_data("opengeode_gocad");
    if (!loop || !geode) {
        WARN("SKIPPED: public data not found: loop_implicitbenchmark, opengeode_gocad");
        return;
    }
    const Count a = check_folder(*loop);
    CHECK(a.objects == 4);
    CHECK(a.vertices == 93 + 237);
    CHECK(a.triangles == 133 + 368);
    // One of these holds an SGrid before its TSurf, with its corners in other files.
    const auto grid = read((*geode / "tests/data/sgrid_tsurf.ts").string());
    CHECK(grid.surfaces.size() == 1);
    CHECK_THAT(grid.diagnostics.notes.back(), Contains("SGrid"));
    // ZPOSITIVE Depth, PVRTX, and a name among other keys.
    const auto depth = read((*geode / "tests/data/ts-2props.ts").string());
    CHECK(depth.surfaces.at(0).name == "test");
    CHECK(depth.surfaces[0].vertices.at(0) == Vec3{-745925.546875, -2618524.8125, 44070.2578125});
    const auto multi = read((*geode / "tests/data/surf2d_multi.ts").string());
    CHECK(multi.surfaces.size() == 2);
    CHECK(count_surfaces(multi).triangles == 92);
}

TEST_CASE("A TSurf's parts, numbering and property values do not matter") {
    const Result plain = parse(object("HEADER {\nname:F\n}\n", square));
    REQUIRE(plain.surfaces.size() == 1);
    const Surface& s = plain.surfaces[0];
    CHECK(s.name == "F");
    CHECK(s.kind == SurfaceKind::fault);
    CHECK(s.vertices == std::vector<Vec3>{{0, 0, 0}, {10, 0, 1}, {10, 10, 2}, {0, 10, 3}});
    CHECK(s.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    const auto same = [&](const std::string& body) {
        const Result r = parse(object("HEADER {\nname:F\n}\n", body));
        return r.surfaces.size() == 1 && r.surfaces[0].vertices == s.vertices &&
               r.surfaces[0].triangles == s.triangles && r.diagnostics.rejected.empty();
    };
    CHECK(same("VRTX 0 0 0 0\nVRTX 1 10 0 1\nVRTX 2 10 10 2\nVRTX 3 0 10 3\nTRGL 0 1 2\nTRGL 0 2 3\n"));
    CHECK(
        same("VRTX 7 0 0 0\nVRTX 18446744073709551615 10 0 1\nVRTX 900000000000 10 10 2\nVRTX 5 0 10 3\n"
             "TRGL 7 18446744073709551615 900000000000\nTRGL 7 900000000000 5\n"));
    CHECK(
        same("PVRTX 1 0 0 0 5.5 -99999 CNXYZ\nPVRTX 2 +10 0e0 1 1 1\nPVRTX 3 1e1 10. 2\nVRTX 4 0 10 3 CNXYZ\n"
             "TRGL 1 2 3 77\nTRGL 1 3 4\nBSTONE 1\nBORDER 5 1 2\n"));
    CHECK(same("TRGL 1 2 3\nTRGL 1 3 4\nVRTX 1 0 0 0\nVRTX 2 10 0 1\nVRTX 3 10 10 2\nVRTX 4 0 10 3\n"));
    CHECK(
        same("VRTX 1 0 0 0\nVRTX 2 10 0 1\nVRTX 3 10 10 2\nTRGL 1 2 3\nTFACE\nATOM 5 1\nPATOM 6 3 9.5\nVRTX 4 0 10 3\n"
             "TRGL 5 6 4\n"));
    std::string windows = "# by hand\n" + square;
    for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) {
        windows.insert(at, "\r");
    }
    CHECK(same(windows));
    // Ids that begin anew in each TFACE belong to their own part.
    const Result anew = parse(object("",
                                     "VRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nTFACE\n"
                                     "VRTX 1 5 0 0\nVRTX 2 6 0 0\nVRTX 3 5 1 0\nTRGL 1 2 3\n"));
    CHECK(anew.surfaces.at(0).triangles == std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}});
}

TEST_CASE("A TSurf's name is found whatever it holds, and the file's name stands in") {
    const auto name = [](const std::string& header) { return parse(object(header, square)).surfaces.at(0).name; };
    CHECK(name("HEADER {\nname: San Andreas, main  \n*solid*color: 1 0 0 1\n}\n") == "San Andreas, main");
    CHECK(name("HEADER {\n*visible:true\nname:\"F \"quoted\" 1\"\n}\n") == "F \"quoted\" 1");
    CHECK(name("HEADER{name:one-line}\n") == "one-line");
    CHECK(name("HEADER { name: brace }\n") == "brace");
    CHECK(name("HEADER {\nname:Ystad\xE9\n}\n") == "Ystad\xC3\xA9");      // Windows-1252
    CHECK(name("HEADER {\nname:Ystad\xC3\xA9\n}\n") == "Ystad\xC3\xA9");  // UTF-8
    CHECK(name("HEADER {\nname:\n}\n") == "some fault");
    CHECK(name("") == "some fault");
    CHECK(name("PROPERTY_CLASS_HEADER p {\nname: default property\n}\n") == "some fault");
}

TEST_CASE("A TSurf's units and direction of z lead to one unit with z up") {
    const auto corner = [](const std::string& system, const std::string& srs = {}) {
        const Result r = parse(object("GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n" +
                                          system + "END_ORIGINAL_COORDINATE_SYSTEM\n",
                                      square),
                               srs);
        return r.surfaces.at(0).vertices.at(2);
    };
    CHECK(corner("AXIS_UNIT \"m\" \"m\" \"m\"\nZPOSITIVE Elevation\n") == Vec3{10, 10, 2});
    CHECK(corner("AXIS_UNIT m m m\nZPOSITIVE Depth\n") == Vec3{10, 10, -2});
    CHECK(corner("ZPOSITIVE Depth\nAXIS_UNIT km km km\n") == Vec3{10000, 10000, -2000});
    CHECK(corner("AXIS_UNIT \"m\" \"m\" \"ft\"\n") == Vec3{10, 10, 2 * 0.3048});
    CHECK(corner("AXIS_UNIT \"unitless\" \"unitless\" \"unitless\"\n") == Vec3{10, 10, 2});
    CHECK(corner("AXIS_UNIT\n") == Vec3{10, 10, 2});
    CHECK(corner("AXIS_UNIT ft ft ft\n", "local:ft") == Vec3{10, 10, 2});
    CHECK(corner("AXIS_UNIT ft ft ft\n", "local") == Vec3{10 * 0.3048, 10 * 0.3048, 2 * 0.3048});
    CHECK(corner("AXIS_UNIT m m ft\n", "EPSG:4326") == Vec3{10, 10, 2 * 0.3048});
    CHECK(
        parse(object("GOCAD_ORIGINAL_COORDINATE_SYSTEM\nAXIS_UNIT km km km\nEND_ORIGINAL_COORDINATE_SYSTEM\n", square))
            .diagnostics.notes.at(0)
            .find("AXIS_UNIT is km km km; converted to metre") != std::string::npos);
}

TEST_CASE("What is wrong in a TSurf is rejected with its line and the rest is used") {
    const Result r = parse(object("HEADER {\nname:F\n}\n", square + "TRGL 1 2 9\n"        // line 12
                                                                    "TRGL 1 2\n"          // 13
                                                                    "TRGL 1 2 2\n"        // 14
                                                                    "TRGL 1 2 -3\n"       // 15
                                                                    "VRTX 5 nan 0 0\n"    // 16
                                                                    "VRTX 6 1e300 0 0\n"  // 17
                                                                    "VRTX 7 1 2\n"        // 18
                                                                    "VRTX 8 1 2 x3\n"     // 19
                                                                    "TRGL 1 2 5\n"        // 20
                                                                    "ATOM 9 99\n"         // 21
                                                                    "VRTX 10 inf 0 0\n"   // 22
                                                                    "GLORP 1 2 3\n"));
    CHECK(r.surfaces.at(0).triangles.size() == 2);
    CHECK(r.surfaces[0].vertices.size() == 4);
    CHECK(rejected(r, 12, "vertex 9, which is not there"));
    CHECK(rejected(r, 13, "three vertex ids"));
    CHECK(rejected(r, 14, "one vertex twice"));
    CHECK(rejected(r, 15, "three vertex ids"));
    CHECK(rejected(r, 16, "numbers within 1e9"));
    CHECK(rejected(r, 17, "numbers within 1e9"));
    CHECK(rejected(r, 18, "three coordinates"));
    CHECK(rejected(r, 19, "three coordinates"));
    CHECK(rejected(r, 20, "vertex 5, which is not there"));
    CHECK(rejected(r, 21, "earlier vertex"));
    CHECK(rejected(r, 22, "numbers within 1e9"));
    CHECK(r.diagnostics.rejected.size() == 11);
    CHECK_THAT(r.diagnostics.notes.back(), Contains("1 lines with unknown keywords") && Contains("GLORP in line 23"));
}

TEST_CASE("A TSurf file cut off anywhere is reported and never yields half a number") {
    const std::string whole = object("HEADER {\nname:F\n}\n",
                                     "VRTX 1 100.25 200.5 -1\nVRTX 2 110.75 200.5 -1\nVRTX 3 100.25 210.125 -1\n"
                                     "TRGL 1 2 3\nVRTX 4 120 220 -1\nTRGL 2 3 4\n");
    const Surface full = parse(whole).surfaces.at(0);
    std::size_t partial = 0;
    for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
        INFO(length);
        try {
            const Result r = parse(whole.substr(0, length));
            ++partial;
            REQUIRE(r.surfaces.size() == 1);
            const Surface& s = r.surfaces[0];
            REQUIRE_FALSE(r.diagnostics.rejected.empty());
            REQUIRE(s.vertices.size() <= 4);
            REQUIRE(std::equal(s.vertices.begin(), s.vertices.end(), full.vertices.begin()));
            REQUIRE(std::equal(s.triangles.begin(), s.triangles.end(), full.triangles.begin()));
        } catch (const InputError& error) {
            REQUIRE_THAT(error.what(), Contains("some fault.ts") && !Contains("\n"));
        }
    }
    CHECK(partial > 30);
    CHECK(parse(whole.substr(0, whole.size() - 1)).diagnostics.rejected.empty());  // END without a line end is whole
}

TEST_CASE("Files that are no TSurf are refused in one clear line") {
    CHECK_THROWS_WITH(read("/nowhere/f.ts"), Contains("/nowhere/f.ts") && Contains("does it exist"));
    CHECK_THROWS_WITH(read("/tmp"), Contains("it is a folder"));
    CHECK_THROWS_WITH(parse(""), Contains("no usable GOCAD TSurf"));
    CHECK_THROWS_WITH(parse("GOCAD PLine 1\nILINE\nVRTX 1 0 0 0\nEND\n"), Contains("span no surface"));
    CHECK_THROWS_WITH(parse(object("", "")), Contains("no usable"));
    CHECK_THROWS_WITH(parse("GOCAD TSurf 1\nVRTX 1 " + std::string(3 << 20, '7')),
                      Contains("line 2") && Contains("1 MiB"));
    testing::Random random(11);
    for (int i = 0; i < 200; ++i) {
        std::string junk;
        for (std::uint64_t k = random.below(4000); k > 0; --k) {
            junk += static_cast<char>(random.below(256));
        }
        CHECK_THROWS_AS(parse(junk), InputError);
        CHECK_THROWS_AS(parse("GOCAD TSurf 1\nTFACE\n" + junk), InputError);
    }
    CHECK_FALSE(is_gocad("/nowhere/f.ts"));
}

TEST_CASE("Damaged TSurf bytes are rejected or refused, never used out of range") {
    testing::Random random(12);
    const std::string whole = object(
        "HEADER {\nname:F\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nAXIS_UNIT m m m\n"
        "END_ORIGINAL_COORDINATE_SYSTEM\n",
        square + "TFACE\nATOM 9 1\nVRTX 10 5 5 5\nTRGL 9 10 2\n");
    for (int i = 0; i < 3000; ++i) {
        std::string text = whole;
        for (std::uint64_t k = 1 + random.below(5); k > 0; --k) {
            text[random.below(text.size())] = static_cast<char>(random.below(256));
        }
        try {
            for (const Surface& s : parse(text).surfaces) {
                for (const Vec3& p : s.vertices) {
                    REQUIRE(is_acceptable(p));
                }
                for (const Triangle& t : s.triangles) {
                    REQUIRE(*std::max_element(t.begin(), t.end()) < s.vertices.size());
                }
            }
        } catch (const InputError&) {
        }
    }
}

TEST_CASE("Rejected records of a TSurf are listed up to a limit and counted beyond") {
    std::string body = square;
    for (int i = 0; i < 5000; ++i) {
        body += "TRGL 1 2 99\n";
    }
    const Result r = parse(object("", body));
    CHECK(r.diagnostics.rejected.size() == 1001);
    CHECK(r.diagnostics.rejected.back().reason == "4000 further records were rejected likewise");
}
