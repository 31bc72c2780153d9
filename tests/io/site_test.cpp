// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read_site.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>

#include "io/read_table.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;

namespace {

std::string written(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

/// A site with what was said while reading it.
struct Read {
    Site site;
    Diagnostics diagnostics;
    ReadCounts counts;

    [[nodiscard]] bool noted(const std::string& text) const {
        return std::ranges::any_of(diagnostics.notes,
                                   [&](const std::string& note) { return note.find(text) != std::string::npos; });
    }
    /// Lines of rejections with this in their reason.
    [[nodiscard]] std::vector<std::int64_t> rejected(const std::string& text = "") const {
        std::vector<std::int64_t> lines;
        for (const Rejected& rejection : diagnostics.rejected) {
            if (rejection.reason.find(text) != std::string::npos) {
                lines.push_back(rejection.line);
            }
        }
        return lines;
    }
    [[nodiscard]] Vec3 world(std::size_t sample) const { return site.frame.to_world(site.samples.positions[sample]); }
};

Read read(const SiteInputs& inputs) {
    Read result;
    result.site = read_site(inputs, result.diagnostics, result.counts);
    return result;
}

std::string error_of(const SiteInputs& inputs) {
    try {
        read(inputs);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

/// Collars, surveys and logs given as text, in a local frame unless told otherwise.
class Case {
  public:
    SiteInputs inputs;

    Case() { inputs.source_crs = "local"; }
    Case& collars(const std::string& text) { return add(inputs.boreholes, "collars", text); }
    Case& survey(const std::string& text) { return add(inputs.surveys, "survey", text); }
    Case& log(const std::string& text) { return add(inputs.logs, "log", text); }
    Case& samples(const std::string& text) { return add(inputs.samples, "samples", text); }
    Case& faults(const std::string& text) { return add(inputs.faults, "faults", text); }

  private:
    Case& add(std::vector<Source>& sources, const std::string& name, const std::string& text) {
        sources.push_back({written(folder_ / (name + std::to_string(sources.size()) + ".csv"), text)});
        return *this;
    }
    testing::TemporaryFolder folder_;
};

bool near(const Vec3& a, const Vec3& b, double tolerance) {
    return distance(a, b) <= tolerance;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool same(const Site& a, const Site& b) {
    const auto same_hole = [](const Borehole& p, const Borehole& q) {
        return p.id == q.id && p.collar == q.collar && p.path == q.path && p.path_depth == q.path_depth;
    };
    return a.frame == b.frame && a.properties == b.properties &&
           std::ranges::equal(a.boreholes, b.boreholes, same_hole) && a.samples.positions == b.samples.positions &&
           a.samples.borehole == b.samples.borehole && same_bits(a.samples.depth, b.samples.depth) &&
           same_bits(a.samples.length, b.samples.length) &&
           std::ranges::equal(a.samples.values, b.samples.values, same_bits) && a.surfaces == b.surfaces;
}

/// The same text with its rows, but not its header, in another order.
std::string shuffled(const std::string& text, testing::Random& random) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    for (std::size_t i = lines.size() - 1; i > 1; --i) {
        std::swap(lines[i], lines[1 + random.below(i)]);
    }
    std::string result;
    for (const std::string& line : lines) {
        result += line + "\n";
    }
    return result;
}

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

constexpr const char* two_collars = "BHID,X,Y,Z\nA,100,200,50\nB,300,400,60\n";

}  // namespace

// --- Real data -----------------------------------------------------------------------------------------------------

TEST_CASE("Babbitt: 399 holes in feet read whole, at the places an independent program finds") {
    const auto folder = testing::public_data("pygslib/doc/source/Tutorial_1/Babbitt");
    if (!folder) {
        WARN("public data absent: skipped");
        return;
    }
    SiteInputs inputs;
    inputs.boreholes = {{(*folder / "collar_BABBITT.csv").string()}};
    inputs.surveys = {{(*folder / "survey_BABBITT.csv").string()}};
    inputs.logs = {{(*folder / "assay_BABBITT.csv").string()}};
    inputs.source_crs = "EPSG:26791";
    const Read babbitt = read(inputs);
    CHECK(babbitt.counts.boreholes == 399);
    CHECK(babbitt.diagnostics.rejected.empty());
    // 35,616 rows, 11,926 of which have no assay at all.
    CHECK(babbitt.counts.samples == 23690);
    CHECK(babbitt.noted("11926 of 35616 records have no value"));
    CHECK(babbitt.noted("column DIP is read as positive downwards"));
    REQUIRE(babbitt.site.properties.size() == 4);
    CHECK(babbitt.site.properties[0].name == "CU");
    CHECK(std::ranges::count_if(babbitt.site.samples.values[0], [](double v) { return !std::isnan(v); }) == 23685);
    CHECK(std::ranges::count_if(babbitt.site.samples.values[3], [](double v) { return !std::isnan(v); }) == 24);
    CHECK(babbitt.site.frame.unit == "US survey foot");

    // By numpy: textbook formula at stations, Gauss–Legendre integration of the turning tangent between them.
    struct Place {
        std::size_t sample;
        const char* hole;
        double depth;
        Vec3 position;
    };
    const std::vector<Place> places{{0, "34873", 2516.2, {2296021.09, 414095.85, -926.2}},
                                    {5000, "B1-102", 1240, {2295497.69, 418358.994129, 376.451287}},
                                    {12345, "B1-244", 1690, {2302261.204956, 421815.948594, -89.214460}},
                                    {20000, "B1-367", 1640, {2294018.244702, 418592.807220, -38.306012}},
                                    {23689, "RMC-66225", 1115, {2290684.77, 417975.58, 485.1}}};
    for (const Place& place : places) {
        INFO(place.hole);
        const auto owner = static_cast<std::size_t>(babbitt.site.samples.borehole[place.sample]);
        CHECK(babbitt.site.boreholes[owner].id == place.hole);
        CHECK(babbitt.site.samples.depth[place.sample] == Approx(place.depth));
        CHECK(near(babbitt.world(place.sample), place.position, 2e-6));
    }

    // The same in metres: every length shrinks by the foot, straight holes keep their shape.
    inputs.target_crs = "EPSG:26915";
    const Read metric = read(inputs);
    CHECK(metric.counts.samples == 23690);
    CHECK(metric.noted("depths along its holes are taken in US survey foot"));
    constexpr double foot = 1200.0 / 3937.0;
    CHECK(metric.site.samples.depth[0] == Approx(2516.2 * foot));
    CHECK(metric.world(0).z == Approx(-926.2 * foot).margin(1e-6).epsilon(0));
    for (const std::size_t i : {5000U, 12345U, 20000U}) {
        const double drop = metric.world(i).z - metric.world(0).z;
        CHECK(drop == Approx((babbitt.world(i).z - babbitt.world(0).z) * foot).margin(1e-6).epsilon(0));
        const double across = distance(metric.world(i), metric.world(0));
        CHECK(across == Approx(distance(babbitt.world(i), babbitt.world(0)) * foot).epsilon(5e-4));
    }
}

TEST_CASE("ddh_qaqc: our mid-points are those another program wrote beside the assays") {
    const auto folder = testing::public_data("ddh_qaqc/data");
    if (!folder) {
        WARN("public data absent: skipped");
        return;
    }
    SiteInputs inputs;
    inputs.boreholes = {{(*folder / "collar.csv").string()}};
    inputs.surveys = {{(*folder / "survey.csv").string()}};
    inputs.logs = {{(*folder / "assay.csv").string()}};
    inputs.properties = {"Au", "xm", "ym", "zm"};
    inputs.source_crs = "local";
    const Read ddh = read(inputs);
    REQUIRE(ddh.counts.samples == 1882);
    CHECK(ddh.counts.boreholes == 29);
    double worst = 0;
    for (std::size_t i = 0; i < ddh.site.samples.size(); ++i) {
        const auto& values = ddh.site.samples.values;
        worst = std::max(worst, distance(ddh.world(i), {values[1][i], values[2][i], values[3][i]}));
    }
    INFO("largest distance " << worst << " after 98 m of hole");
    CHECK(worst < 0.032);  // the other program interpolates angles; at stations the methods agree
    CHECK(worst > 0.001);
}

TEST_CASE("Demo1 under other column names gives the site that ddh_qaqc gives") {
    const auto ours = testing::public_data("pygslib/pygslib/data/Demo1/data");
    const auto theirs = testing::public_data("ddh_qaqc/data");
    if (!ours || !theirs) {
        WARN("public data absent: skipped");
        return;
    }
    const auto inputs = [](const std::filesystem::path& folder) {
        SiteInputs result;
        result.boreholes = {{(folder / "collar.csv").string()}};
        result.surveys = {{(folder / "survey.csv").string()}};
        result.logs = {{(folder / "assay.csv").string()}};
        result.properties = {"Au"};
        result.source_crs = "local";
        return result;
    };
    const Read demo = read(inputs(*ours));
    CHECK(demo.counts.boreholes == 29);
    CHECK(demo.counts.samples == 1882);
    CHECK(demo.diagnostics.rejected.empty());
    CHECK(demo.site.samples.positions == read(inputs(*theirs)).site.samples.positions);
}

TEST_CASE("workbooks: sheets of one file, classes, units from headers, tables without header") {
    const auto folder = testing::public_data("subsurface/tests/data/borehole");
    if (!folder) {
        WARN("public data absent: skipped");
        return;
    }
    const std::string wells = (*folder / "wells-database-small.xlsx").string();
    SiteInputs inputs;
    inputs.boreholes = {{wells, "collar"}};
    inputs.surveys = {{wells, "survey"}};
    inputs.logs = {{wells, "geology"}};
    inputs.properties = {"GEOL:categorical"};
    inputs.source_crs = "EPSG:32632";
    const Read book = read(inputs);
    CHECK(book.counts.boreholes > 5);
    CHECK(book.counts.samples > 5);
    CHECK(book.site.boreholes.front().id == "NC-01");
    CHECK(std::ranges::is_sorted(book.site.properties[0].classes));
    CHECK(book.noted("INCL is read as inclination from the downward vertical"));

    SiteInputs bare;
    bare.boreholes = {{(*folder / "borehole_collar.xlsx").string()}};
    bare.logs = {{(*folder / "borehole_assays.xlsx").string()}, {(*folder / "borehole_lith.xlsx").string()}};
    bare.columns = {{"id", "Field1"}, {"x", "Field2"}, {"y", "Field3"}, {"z", "Field4"}, {"length", "Field5"}};
    bare.properties = {"Cu", "LITHOLOGY:categorical"};
    bare.source_crs = "EPSG:32629";
    const Read assays = read(bare);
    CHECK(assays.counts.boreholes == 2);
    CHECK(assays.site.properties[0].unit == "%");
    CHECK(assays.site.properties[1].classes.size() == 11);
    CHECK(assays.noted("2 of 2 holes have no survey and no direction"));
    CHECK(assays.site.boreholes[1].path_depth.back() == 508.4);
}

TEST_CASE("swissgeol: semicolons, trailing separators, missing heights and coordinates") {
    const auto folder = testing::public_data("swissgeol/tests/api/TestData");
    if (!folder) {
        WARN("public data absent: skipped");
        return;
    }
    const auto collars = [&](const std::string& name) {
        SiteInputs inputs;
        inputs.boreholes = {{(*folder / name).string()}};
        inputs.source_crs = "EPSG:2056";
        return inputs;
    };
    const Read holes = read(collars("testdata.csv"));
    CHECK(holes.counts.boreholes == 6);
    CHECK(holes.site.boreholes[0].id == "Unit_Test_1");
    CHECK(holes.site.frame.to_world(holes.site.boreholes[0].collar) == Vec3{2618962, 1144995, 640.7726659});
    CHECK_THAT(error_of(collars("minimal_testdata.csv")), Contains("height") && Contains("--columns z="));
    CHECK_THAT(error_of(collars("no_data_but_required_headers.csv")), Contains("no row"));
    CHECK_THAT(error_of(collars("not_a_json_file.csv")), Contains("no column for x"));
    SiteInputs empty = collars("maxValidationErrorsExceeded.csv");
    empty.columns = {{"z", "total_depth"}};
    CHECK_THAT(error_of(empty), Contains("none of its 1244 rows") && Contains("LocationY is empty"));
    SiteInputs words = collars("geometry_xyz_invalid_data.csv");
    words.samples = std::exchange(words.boreholes, {});
    words.properties = {"MD_m"};
    const Read points = read(words);
    CHECK(points.rejected("'NOT A DOUBLE' is not a number") == std::vector<std::int64_t>{4});
    CHECK(points.counts.samples == 3);
}

// --- Formats and coordinate systems --------------------------------------------------------------------------------

TEST_CASE("collars of a GeoPackage and a Shapefile give the site that their CSV gives") {
    GDALAllRegister();
    const testing::TemporaryFolder folder;
    Case csv;
    csv.collars("HOLE_ID,X,Y,Z\nKR1,208000.5,6797000.25,7\nKR2,208100,6797100,8\n")
        .log("HOLE_ID,FROM,TO,K\nKR1,0,10,1e-9\nKR2,5,10,1e-8\n");
    csv.inputs.source_crs = "EPSG:3067";
    const Read expected = read(csv.inputs);
    for (const auto& [driver, name] : {std::pair{"GPKG", "c.gpkg"}, std::pair{"ESRI Shapefile", "c.shp"}}) {
        INFO(driver);
        GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName(driver)->Create((folder / name).c_str(), 0, 0, 0,
                                                                                       GDT_Unknown, nullptr);
        OGRSpatialReference reference;
        reference.importFromEPSG(3067);
        OGRLayer* layer = dataset->CreateLayer("c", &reference, wkbPoint25D, nullptr);
        OGRFieldDefn id("HOLE_ID", OFTString);
        layer->CreateField(&id);
        for (const auto& [hole, point] :
             {std::pair{"KR2", OGRPoint(208100, 6797100, 8)}, std::pair{"KR1", OGRPoint(208000.5, 6797000.25, 7)}}) {
            const OGRFeatureUniquePtr feature{OGRFeature::CreateFeature(layer->GetLayerDefn())};
            feature->SetField("HOLE_ID", hole);
            feature->SetGeometry(&point);
            REQUIRE(layer->CreateFeature(feature.get()) == OGRERR_NONE);
        }
        GDALClose(dataset);
        SiteInputs inputs = csv.inputs;
        inputs.boreholes = {{folder / name}};
        inputs.source_crs.clear();
        Read actual = read(inputs);
        CHECK_THAT(actual.site.frame.crs_name, Contains("TM35FIN"));
        actual.site.frame.crs_wkt = expected.site.frame.crs_wkt;  // a Shapefile's loses the code
        actual.site.frame.crs_name = expected.site.frame.crs_name;
        CHECK(same(actual.site, expected.site));
    }
}

TEST_CASE("coordinate columns that differ from a layer's points in a known CRS are not believed") {
    Case geojson;
    geojson.inputs.source_crs.clear();
    const testing::TemporaryFolder folder;
    geojson.inputs.boreholes = {{written(
        folder / "c.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"HOLE_ID":"KR1","EAST":208000,)"
        R"("NORTH":6797000,"ELEV":7},"geometry":{"type":"Point","coordinates":[21.55,61.2]}}]})")}};
    const Read result = read(geojson.inputs);
    CHECK(result.noted("EAST and NORTH differ from the points of the layer"));
    CHECK(result.noted("EPSG:32634"));
    const Vec3 collar = result.site.frame.to_world(result.site.boreholes[0].collar);
    CHECK(collar.x == Approx(529500).margin(500).epsilon(0));
    CHECK(collar.z == 7);
}

TEST_CASE("inputs in feet, metres and degrees meet in one projected frame") {
    // The same place in three systems: what is at one point must come out at one point.
    const Vec3 feet{2296021.09, 414095.85, 1590};
    std::vector<Vec3> metric{feet};
    CrsTransform(parse_crs("EPSG:26791"), parse_crs("EPSG:26915")).apply(metric);
    std::vector<Vec3> degrees = metric;
    CrsTransform(parse_crs("EPSG:26915"), parse_crs("EPSG:4269")).apply(degrees);
    char text[3][200];
    std::snprintf(text[0], 200, "ID,X,Y,Z\nH,%.6f,%.6f,%.6f\n", feet.x, feet.y, feet.z);
    std::snprintf(text[1], 200, "X,Y,Z,V\n%.6f,%.6f,%.6f,2\n", metric[0].x, metric[0].y, metric[0].z);
    std::snprintf(text[2], 200, "LON,LAT,Z,V\n%.10f,%.10f,%.6f,3\n", degrees[0].x, degrees[0].y, degrees[0].z);
    Case mixed;
    mixed.collars(text[0]).log("ID,DEPTH,V\nH,0,1\n").samples(text[1]).samples(text[2]);
    mixed.inputs.source_crs = "EPSG:26915";
    mixed.inputs.boreholes[0].srs = "EPSG:26791";
    mixed.inputs.samples[1].srs = "EPSG:4269";

    const Read first = read(mixed.inputs);  // the first projected one is the frame's: feet
    CHECK_THAT(first.site.frame.crs_name, Contains("EPSG:26791"));
    REQUIRE(first.counts.samples == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(near(first.world(i), feet, 0.01));
    }
    mixed.inputs.target_crs = "EPSG:26915";
    const Read chosen = read(mixed.inputs);
    CHECK(chosen.site.frame.unit == "metre");
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(near(chosen.world(i), metric[0], 0.01));
    }
    CHECK(chosen.world(0).z == Approx(1590 * 1200.0 / 3937.0));
}

TEST_CASE("longitude and latitude go to the UTM zone of their middle, and azimuths count from true north there") {
    Case geographic;
    geographic.collars("ID,LON,LAT,ELEV\nA,21.5,61.2,10\nB,21.6,61.3,12\n")
        .survey("ID,DEPTH,AZ,DIP\nA,0,0,0\nB,0,90,-45\n")
        .log("ID,DEPTH,V\nA,1000,1\nB,100,2\n");
    geographic.inputs.source_crs = "EPSG:4326";
    const Read result = read(geographic.inputs);
    CHECK_THAT(result.site.frame.crs_name, Contains("EPSG:32634"));
    CHECK(result.noted("EPSG:32634"));
    // Level and due north from A: the end keeps A's longitude.
    std::vector<Vec3> end{result.world(0)};
    CrsTransform(parse_crs("EPSG:32634"), parse_crs("EPSG:4326")).apply(end);
    CHECK(end[0].x == Approx(21.5).margin(2e-6).epsilon(0));
    CHECK(end[0].y > 61.2);
    CHECK(result.world(1).z == Approx(12 - 100 * std::sqrt(0.5)).margin(1e-6).epsilon(0));
}

TEST_CASE("azimuths count from grid, true or magnetic north as told") {
    Case hole;
    hole.collars("ID,X,Y,Z\nA,208000,6797000,0\n").survey("ID,MD,AZ,DIP\nA,0,0,0\n").log("ID,MD,V\nA,1000,1\n");
    hole.inputs.source_crs = "EPSG:3067";
    CHECK(near(read(hole.inputs).world(0), {208000, 6798000, 0}, 1e-6));
    const double true_north =
        CrsTransform(parse_crs("EPSG:3067"), parse_crs("EPSG:3067")).convergence_deg({208000, 6797000, 0});
    CHECK(true_north > 4);
    const auto bearing = [&] {
        const Vec3 way = read(hole.inputs).world(0) - Vec3{208000, 6797000, 0};
        return std::atan2(way.x, way.y) * 180 / std::acos(-1.0);
    };
    hole.inputs.azimuth = AzimuthReference::true_north;
    CHECK(bearing() == Approx(true_north).margin(1e-6).epsilon(0));
    hole.inputs.azimuth = AzimuthReference::magnetic;
    hole.inputs.declination_deg = 7.5;
    CHECK(bearing() == Approx(true_north + 7.5).margin(1e-6).epsilon(0));
}

TEST_CASE("depths are in the unit of the collars' system, or as told") {
    Case hole;
    hole.collars("ID,X,Y,Z,EOH\nA,2296021.09,414095.85,1590,300\n").log("ID,FROM,TO,V\nA,100,200,1\n");
    hole.inputs.source_crs = "EPSG:26791";
    hole.inputs.target_crs = "EPSG:26915";
    const double foot = 1200.0 / 3937.0;
    CHECK(read(hole.inputs).site.samples.depth[0] == Approx(150 * foot));
    CHECK(read(hole.inputs).site.samples.length[0] == Approx(100 * foot));
    CHECK(read(hole.inputs).site.boreholes[0].path_depth.back() == Approx(300 * foot));
    hole.inputs.depth_unit = "m";
    CHECK(read(hole.inputs).site.samples.depth[0] == 150);
    hole.inputs.target_crs = "";
    CHECK(read(hole.inputs).site.samples.depth[0] == Approx(150 / foot));
    hole.inputs.depth_unit = "ft";
    CHECK(read(hole.inputs).site.samples.depth[0] == 150);
    hole.inputs.depth_unit = "fathom";
    CHECK_THROWS_AS(read(hole.inputs), UsageError);
}

TEST_CASE("X3: every position of a site is snapped, round an origin that is a multiple of 1024") {
    Case hole;
    hole.collars("ID,X,Y,Z\nA,208000.123,6797000.456,7.89\n")
        .survey("ID,MD,AZ,DIP\nA,0,33,-61\nA,100,35,-58\n")
        .log("ID,FROM,TO,V\nA,0,3.3,1\nA,50,51.7,2\nA,99,140,3\n")
        .samples("X,Y,Z,V\n208010.1,6797020.2,-30.3,4\n");
    hole.inputs.source_crs = "EPSG:3067";
    const Read result = read(hole.inputs);
    const Frame& frame = result.site.frame;
    CHECK(frame.origin.x == 207872);
    CHECK(std::fmod(frame.origin.y, 1024) == 0);
    CHECK(frame.origin.z == 0);
    for (const Vec3& position : result.site.samples.positions) {
        CHECK(frame.snapped(position) == position);
    }
    for (const Vec3& position : result.site.boreholes[0].path) {
        CHECK(frame.snapped(position) == position);
    }
    CHECK(result.world(3) == Vec3{208010.1, 6797020.2, -30.3});
    CHECK(result.site.boreholes[0].path_depth.back() == 140);
}

// --- Conventions ---------------------------------------------------------------------------------------------------

TEST_CASE("dips go down by the majority of their signs, by name, or as told, and the choice is noted") {
    const auto bottom = [](const std::string& header, const std::string& dips, DipConvention convention, Read* out) {
        Case hole;
        hole.collars("ID,X,Y,Z\nA,0,0,0\nB,0,0,0\nC,0,0,0\n").log("ID,MD,V\nA,100,1\n");
        std::string survey = "ID,MD,AZ," + header + "\n";
        std::istringstream stream(dips);
        for (const char* id : {"A", "B", "C"}) {
            std::string dip;
            stream >> dip;
            survey += std::string(id) + ",0,90," + dip + "\n";
        }
        hole.survey(survey);
        hole.inputs.dip = convention;
        Read result = read(hole.inputs);
        const Vec3 position = result.world(0);
        if (out != nullptr) {
            *out = std::move(result);
        }
        return position;
    };
    const double down = -100 * std::sin(std::acos(-1.0) / 3);
    Read result;
    CHECK(bottom("DIP", "60 90 -10", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("column DIP is read as positive downwards from the horizontal (2 values above zero, 1 below"));
    CHECK(bottom("DIP", "-60 -90 10", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("negative downwards"));
    CHECK(bottom("DIP", "60 -90 -10", DipConvention::automatic, nullptr).z == Approx(-down));
    CHECK(bottom("INCLINATION", "30 0 5", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("inclination from the downward vertical"));
    CHECK(bottom("INCLINATION", "-60 -90 -80", DipConvention::automatic, &result).z == Approx(down));
    CHECK(result.noted("negative downwards"));
    CHECK(bottom("DIP", "30 0 170", DipConvention::inclination, nullptr).z == Approx(down));
    CHECK(bottom("INCL", "60 0 5", DipConvention::down_positive, nullptr).z == Approx(down));
    CHECK(bottom("DIP", "-60 1 1", DipConvention::down_negative, nullptr).z == Approx(down));
}

TEST_CASE("a hole without survey goes in its collar's direction, or else straight down, noted") {
    Case holes;
    holes.collars("ID,X,Y,Z,AZIMUTH,DIP\nA,0,0,0,90,-45\nB,10,0,0,,\nC,20,0,0,0,-90\nD,30,0,0,0,-60\n")
        .survey("ID,MD,AZ,DIP\nC,50,0,-90\nD,20,90,0\n")
        .log("ID,MD,V\nA,100,1\nB,100,2\nC,100,3\nD,100,4\n");
    const Read result = read(holes.inputs);
    CHECK(near(result.world(0), {100 * std::sqrt(0.5), 0, -100 * std::sqrt(0.5)}, 1e-9));
    CHECK(near(result.world(1), {10, 0, -100}, 1e-9));
    CHECK(near(result.world(2), {20, 0, -100}, 1e-9));
    CHECK(near(result.world(3), {130, 0, 0}, 1e-9));  // a survey counts, from the collar on
    CHECK(result.noted("1 of 4 holes have no survey and go straight in their collar's direction"));
    CHECK(result.noted("1 of 4 holes have no survey and no direction and are taken for vertical"));
}

// --- Properties ----------------------------------------------------------------------------------------------------

TEST_CASE("properties: every numeric column, or those asked for with scale, unit and classes") {
    Case hole;
    hole.collars(two_collars)
        .log(
            "BHID,FROM,TO,CU,Au (ppm),ROCK,NOTE,YEAR\nA,0,1,1,0.5,granite,,\nA,1,2,2,,gneiss,x,\nB,0,1,,0,granite,y,7\n"
            "B,1,2,4,2,NA,z,\nB,2,3,,,,w,\n");
    const Read all = read(hole.inputs);
    REQUIRE(all.site.properties.size() == 3);
    CHECK(all.site.properties[0].name == "CU");
    CHECK(all.site.properties[1].name == "Au (ppm)");
    CHECK(all.site.properties[1].unit == "ppm");
    CHECK(all.site.properties[2].name == "YEAR");
    CHECK(all.counts.samples == 4);
    CHECK(all.noted("1 of 5 records have no value"));

    hole.inputs.properties = {"rock:categorical", "Au:log10", "CU:unit=%"};
    const Read chosen = read(hole.inputs);
    REQUIRE(chosen.site.properties.size() == 3);
    CHECK(chosen.site.properties[0].classes == std::vector<std::string>{"gneiss", "granite"});
    CHECK(same_bits(chosen.site.samples.values[0], {1, 0, 1, missing}));
    CHECK(chosen.site.properties[1].scale == Scale::log10);
    CHECK(chosen.site.properties[1].unit == "ppm");
    CHECK(same_bits(chosen.site.samples.values[1], {0.5, missing, missing, 2}));
    CHECK(chosen.noted("1 values are not positive"));
    CHECK(chosen.site.properties[2].unit == "%");

    hole.inputs.properties = {"ZN"};
    CHECK_THROWS_WITH(read(hole.inputs), Contains("ZN") && Contains("CU, Au (ppm)"));
    hole.inputs.properties = {"ROCK"};
    CHECK_THAT(error_of(hole.inputs), Contains("ROCK holds no number") && Contains("ROCK:categorical"));
}

TEST_CASE("properties of several logs share names in any case, and lack what their log lacks") {
    Case hole;
    hole.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,2,1\n").log("BHID,DEPTH,cu,K\nA,5,2,3\nB,5,,4\n");
    const Read result = read(hole.inputs);
    REQUIRE(result.site.properties.size() == 2);
    CHECK(same_bits(result.site.samples.values[0], {1, 2, missing}));
    CHECK(same_bits(result.site.samples.values[1], {missing, 3, 4}));
    CHECK(result.site.samples.depth == std::vector<double>{1, 5, 5});
    CHECK(result.site.samples.length == std::vector<double>{2, 0, 0});
}

TEST_CASE("placeholders are missing unless the column goes as low; bounds of censored values count; both noted") {
    Case hole;
    hole.collars(two_collars)
        .log("BHID,DEPTH,K,SP\nA,1,-999,-999\nA,2,<1e-12,-150\nA,3,-999.25,-20\nA,4,5,n/a\nA,5,>= 7,-\nA,6,-5,NULL\n");
    const Read result = read(hole.inputs);
    CHECK(same_bits(result.site.samples.values[0], {missing, 1e-12, missing, 5, 7, -5}));
    CHECK(same_bits(result.site.samples.values[1], {-999, -150, -20, missing, missing, missing}));
    CHECK(result.noted("column K: 1 cells of -999 are taken for no value"));
    CHECK(result.noted("column K: 1 cells of -999.25 are taken for no value"));
    CHECK(result.noted("column SP: 1 cells of -999 are kept"));
    CHECK(result.noted("column K: 2 censored values"));
    CHECK(result.diagnostics.rejected.empty());
}

TEST_CASE("a column of words with a few numbers is no property unless asked for, and that is said") {
    Case hole;
    hole.collars(two_collars).log("BHID,DEPTH,K,LITH\nA,1,1,F\nA,2,2,3\nA,3,3,Qz\n");
    const Read result = read(hole.inputs);
    REQUIRE(result.site.properties.size() == 1);
    CHECK(result.noted("column LITH has numbers in only 1 of 3 cells and is left out"));
    hole.inputs.properties = {"LITH"};
    const Read asked = read(hole.inputs);
    CHECK(asked.rejected("column LITH") == std::vector<std::int64_t>{2, 4});
    CHECK(asked.counts.samples == 1);
}

// --- Dirty records -------------------------------------------------------------------------------------------------

TEST_CASE("every dirty record is listed with its line and reason, and the clean ones are used") {
    Case dirty;
    dirty
        .collars(
            "BHID,X,Y,Z,EOH\nA,0,0,0,50\nB,10,0,0,\nA,0,0,5,\nC,1e12,0,0,\nD,nan,0,0,\nE,,0,0,\n,5,5,5,\nF,x,0,0,\n"
            "G,inf,0,0,\nNOLOG,30,0,0,x\n")
        .survey(
            "BHID,AT,AZ,DIP\nA,0,0,90\nA,10,0,95\nA,-5,0,90\nA,x,0,90\nZZ,0,0,90\nA,20,abc,80\nA,30,,80\nA,0,0,80\n"
            "A,40,720,80\nA,45,0,\nB,0,,90\n")
        .log(
            "BHID,FROM,TO,CU,NI\nA,0,1,1,1\nA,3,2,1,1\nA,-1,0,1,1\nA,x,9,1,1\nZZ,0,1,1,1\nA,5,6,abc,1\nA,6,8,2,1\n"
            "A,7,9,3,1\nA,6,8,4,1\n,0,1,1,1\nB,0,,1,1\nB,1,1e9,1,1\nB,4,5,,\nB,6,7,inf,\n");
    const Read result = read(dirty.inputs);
    const auto lines = [&](const std::string& file, const std::string& text) {
        std::vector<std::int64_t> found;
        for (const Rejected& rejection : result.diagnostics.rejected) {
            if (rejection.file.find(file) != std::string::npos && rejection.reason.find(text) != std::string::npos) {
                found.push_back(rejection.line);
            }
        }
        return found;
    };
    using Lines = std::vector<std::int64_t>;
    CHECK(lines("collars", "a second collar") == Lines{4});
    CHECK(lines("collars", "beyond 1e+09") == Lines{5});
    CHECK(lines("collars", "'nan' is not a number") == Lines{6});
    CHECK(lines("collars", "X is empty") == Lines{7});
    CHECK(lines("collars", "no id") == Lines{8});
    CHECK(lines("collars", "'x' is not a number") == Lines{9});
    CHECK(lines("collars", "'inf' is not a number") == Lines{10});
    CHECK(lines("collars", "").size() == 7);
    CHECK(lines("survey", "'95' is no") == Lines{3});
    CHECK(lines("survey", "negative depth -5") == Lines{4});
    CHECK(lines("survey", "'x' is not a number") == Lines{5});
    CHECK(lines("survey", "hole ZZ has no collar") == Lines{6});
    CHECK(lines("survey", "'abc' is no azimuth") == Lines{7});
    CHECK(lines("survey", "no azimuth beside the dip 80") == Lines{8});
    CHECK(lines("survey", "different station at depth 0") == Lines{9});
    CHECK(lines("survey", "'720' is no azimuth") == Lines{10});
    CHECK(lines("survey", "'' is no number") == Lines{11});
    CHECK(lines("survey", "").size() == 9);
    CHECK(lines("log", "from 3 is below to 2") == Lines{3});
    CHECK(lines("log", "negative depth -1") == Lines{4});
    CHECK(lines("log", "column FROM: 'x' is not a number") == Lines{5});
    CHECK(lines("log", "hole ZZ has no collar") == Lines{6});
    CHECK(lines("log", "column CU: 'abc' is not a number; the record's other values are used") == Lines{7});
    CHECK(lines("log", "overlaps the one on line 8") == Lines{9, 10});
    CHECK(lines("log", "no id") == Lines{11});
    CHECK(lines("log", "column TO is empty") == Lines{12});
    CHECK(lines("log", "deeper than any hole") == Lines{13});
    CHECK(lines("log", "column CU: 'inf'") == Lines{15});
    CHECK(lines("log", "").size() == 11);
    CHECK(result.noted("2 of 14 records have no value"));

    CHECK(result.counts.boreholes == 3);
    CHECK(result.site.boreholes[0].collar == Vec3{0, 0, 0});
    CHECK(result.site.boreholes[2].path.size() == 1);
    REQUIRE(result.counts.samples == 3);
    CHECK(result.site.samples.depth == std::vector<double>{0.5, 5.5, 7});
    CHECK(same_bits(result.site.samples.values[0], {1, missing, 2}));
    CHECK(same_bits(result.site.samples.values[1], {1, 1, 1}));
}

TEST_CASE("strict: the first dirty record is fatal, an unassayed interval is not") {
    Case hole;
    hole.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\nA,1,2,\nA,9,8,1\n");
    hole.inputs.strict = true;
    CHECK_THAT(error_of(hole.inputs), Contains("line 4") && Contains("from 9 is below to 8"));
    Case clean;
    clean.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\nA,1,2,\n");
    clean.inputs.strict = true;
    CHECK(read(clean.inputs).counts.samples == 1);
}

TEST_CASE("bad inputs are each refused with one clear message") {
    const testing::TemporaryFolder folder;
    const auto with = [](auto&& change) {
        Case good;
        good.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\n");
        change(good);
        return error_of(good.inputs);
    };
    CHECK_THAT(with([](Case& c) { c.inputs.boreholes[0].path += ".gone"; }), Contains("not found"));
    CHECK_THAT(with([&](Case& c) { c.inputs.logs[0].path = folder.path().string(); }), Contains("folder"));
    CHECK_THAT(with([](Case& c) { c.log(""); }), Contains("empty"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,FROM,TO,CU\n"); }), Contains("no row"));
    CHECK_THAT(with([](Case& c) { c.log(std::string("\0\1\2\3binary", 10)); }), Contains("binary"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,FROM,TO,ROCK\nA,0,1,granite\n"); }),
               Contains("no numeric column") && Contains("ROCK") && Contains(":categorical"));
    CHECK_THAT(with([](Case& c) { c.log("FROM,TO,CU\n0,1,1\n"); }), Contains("hole's id") && Contains("id=NAME"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,CU\nA,1\n"); }), Contains("depths"));
    CHECK_THAT(with([](Case& c) { c.log("BHID,FROM,TO,CU\nZ,0,1,1\n"); }),
               Contains("none of its 1 rows is usable") && Contains("line 2") && Contains("hole Z has no collar"));
    CHECK_THAT(with([](Case& c) { c.survey("BHID,AT,AZ\nA,0,0\n"); }), Contains("no column for dip"));
    CHECK_THAT(with([](Case& c) { c.collars("BHID,X,Y\nC,1,2\n"); }), Contains("height"));
    CHECK_THAT(with([](Case& c) { c.collars("BHID,X,Y,Z\nC,1e12,2,3\n"); }), Contains("beyond 1e+09"));
    CHECK_THAT(with([](Case& c) { c.inputs.source_crs = ""; }), Contains("-s_srs"));
    CHECK_THAT(with([](Case& c) { c.inputs.source_crs = "EPSG:4326"; }),
               Contains("no longitude and latitude") && Contains("EPSG:4326"));
    CHECK_THAT(with([](Case& c) { c.inputs.target_crs = "EPSG:3067"; }), Contains("no transformation from local"));
    CHECK_THAT(with([](Case& c) {
                   c.inputs.boreholes.clear();
                   c.inputs.source_crs = "";
                   c.collars("BHID,LON,LAT,Z\nA,21,61,0\n");
               }),
               Contains("-s_srs") && Contains("EPSG:4326"));
    CHECK_THAT(with([](Case& c) {
                   c.inputs.boreholes.clear();
                   c.inputs.source_crs = "EPSG:3067";
                   c.collars("BHID,LON,LAT,Z\nA,21,61,0\n");
               }),
               Contains("hold degrees") && Contains("srs=EPSG:4326"));
}

TEST_CASE("requests that cannot be met are told apart from bad inputs") {
    Case good;
    good.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\n");
    const auto usage = [&](auto&& change) {
        SiteInputs inputs = good.inputs;
        change(inputs);
        try {
            read(inputs);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string("no UsageError");
    };
    CHECK_THAT(usage([](SiteInputs& i) { i.boreholes.clear(); }), Contains("--boreholes"));
    CHECK_THAT(usage([](SiteInputs& i) { i = {}; }), Contains("no input"));
    CHECK_THAT(usage([](SiteInputs& i) { i.target_crs = "EPSG:4326"; }), Contains("degrees"));
    CHECK_THAT(usage([](SiteInputs& i) { i.target_crs = "EPSG:nope"; }), Contains("not understood"));
    CHECK_THAT(usage([](SiteInputs& i) { i.columns = {{"id", "NUMMER"}}; }), Contains("NUMMER"));
    CHECK_THAT(usage([](SiteInputs& i) { i.columns = {{"nummer", "BHID"}}; }), Contains("no such meaning"));
    CHECK_THAT(usage([](SiteInputs& i) { i.source_crs = "EPSG:2225+5703"; }), Contains("another unit"));
}

// --- Order and surfaces --------------------------------------------------------------------------------------------

TEST_CASE("R6: the order of rows does not matter") {
    testing::Random random(42);
    std::string collars = "BHID,X,Y,Z\n";
    std::string survey = "BHID,AT,AZ,DIP\n";
    std::string log = "BHID,FROM,TO,CU,ROCK\n";
    std::string loose = "X,Y,Z,CU\n";
    for (int hole = 0; hole < 12; ++hole) {
        const std::string id = "H" + std::to_string(hole) + ",";
        collars += id + std::to_string(random(2e5, 3e5)) + "," + std::to_string(random(6.7e6, 6.8e6)) + ",10\n";
        for (int i = 0; i < 5; ++i) {
            survey += id + std::to_string(20 * i) + "," + std::to_string(random(0, 360)) + "," +
                      std::to_string(random(40, 90)) + "\n";
        }
        for (int i = 0; i < 20; ++i) {
            log += id + std::to_string(5 * i) + "," + std::to_string(5 * i + (i % 7 == 0 ? 6 : 5)) + "," +
                   (i % 5 == 0 ? "" : std::to_string(random(0, 9))) + ",R" + std::to_string(random.below(4)) + "\n";
        }
        loose += "250000,6750000," + std::to_string(hole % 3) + "," + std::to_string(random.below(3)) + "\n";
    }
    const auto site_of = [&](const std::string& c, const std::string& s, const std::string& l, const std::string& p) {
        Case result;
        result.collars(c).survey(s).log(l).samples(p);
        result.inputs.source_crs = "EPSG:3067";
        result.inputs.properties = {"CU", "ROCK:categorical"};
        return read(result.inputs).site;
    };
    const Site expected = site_of(collars, survey, log, loose);
    CHECK(expected.samples.size() > 200);
    CHECK(std::ranges::is_sorted(expected.boreholes, {}, &Borehole::id));
    for (int trial = 0; trial < 5; ++trial) {
        CHECK(same(expected, site_of(shuffled(collars, random), shuffled(survey, random), shuffled(log, random),
                                     shuffled(loose, random))));
    }
}

TEST_CASE("R6: Babbitt with its rows shuffled is the same site") {
    const auto folder = testing::public_data("pygslib/doc/source/Tutorial_1/Babbitt");
    if (!folder) {
        WARN("public data absent: skipped");
        return;
    }
    testing::Random random(1);
    const auto site_of = [&](bool shuffle) {
        Case babbitt;
        const auto text = [&](const char* name) {
            const std::string whole = text_of((*folder / name).string());
            return shuffle ? shuffled(whole, random) : whole;
        };
        babbitt.collars(text("collar_BABBITT.csv")).survey(text("survey_BABBITT.csv")).log(text("assay_BABBITT.csv"));
        babbitt.inputs.source_crs = "EPSG:26791";
        return read(babbitt.inputs).site;
    };
    CHECK(same(site_of(false), site_of(true)));
}

TEST_CASE("faults come into the frame of the samples") {
    Case site;
    site.samples("X,Y,Z,V\n582673.75,5275653.28,484,1\n")
        .faults(
            "FAULT,X,Y,Z\nF,2296000,414000,1500\nF,2296100,414000,1500\nF,2296000,414100,1600\nF,2296100,414100,"
            "1600\n");
    site.inputs.source_crs = "EPSG:26915";
    site.inputs.faults[0].srs = "EPSG:26791";
    const Read result = read(site.inputs);
    CHECK(result.counts.faults == 1);
    REQUIRE(result.site.surfaces.size() == 1);
    REQUIRE(result.site.surfaces[0].vertices.size() == 4);
    Box3 box;
    for (const Vec3& vertex : result.site.surfaces[0].vertices) {
        box.extend(result.site.frame.to_world(vertex));
        CHECK(result.site.frame.snapped(vertex) == vertex);
    }
    CHECK(box.lo.z == Approx(1500 * 1200.0 / 3937.0));
    CHECK(box.hi.z == Approx(1600 * 1200.0 / 3937.0));
    CHECK(box.size().x == Approx(100 * 1200.0 / 3937.0).epsilon(0.02));
    CHECK(box.lo.x == Approx(582667).margin(40).epsilon(0));
}

TEST_CASE("reading reports its progress and can be cancelled") {
    Case good;
    good.collars(two_collars).log("BHID,FROM,TO,CU\nA,0,1,1\n");
    Diagnostics diagnostics;
    ReadCounts counts;
    double last = 0;
    read_site(good.inputs, diagnostics, counts, [&](std::string_view, double fraction) {
        CHECK(fraction >= last);
        last = fraction;
        return true;
    });
    CHECK(last == 1);
    CHECK_THROWS_AS(read_site(good.inputs, diagnostics, counts, [](std::string_view, double) { return false; }),
                    Cancelled);
}
