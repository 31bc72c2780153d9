// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "io/base/parse_number.hpp"
#include "io/read/tables/csv_file.hpp"
#include "io/read/tables/read_table.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string written(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

Rows rows_of(const Table& table) {
    Rows rows(table.rows());
    for (const auto& column : table.cells) {
        for (std::size_t row = 0; row < rows.size(); ++row) {
            rows[row].emplace_back(column[row]);
        }
    }
    return rows;
}

/// A point layer with a name, a whole number and a real one, in EPSG:3067.
void write_points(const std::string& driver, const std::string& path, OGRwkbGeometryType type, int count = 3) {
    GDALAllRegister();
    GDALDataset* dataset =
        GetGDALDriverManager()->GetDriverByName(driver.c_str())->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    REQUIRE(dataset != nullptr);
    OGRSpatialReference reference;
    reference.importFromEPSG(3067);
    OGRLayer* layer = dataset->CreateLayer("collars", &reference, type, nullptr);
    OGRFieldDefn hole("HOLE_ID", OFTString);
    OGRFieldDefn year("YEAR", OFTInteger);
    OGRFieldDefn grade("GRADE", OFTReal);
    REQUIRE(layer->StartTransaction() == OGRERR_NONE);
    layer->CreateField(&hole);
    layer->CreateField(&year);
    layer->CreateField(&grade);
    for (int i = 0; i < count; ++i) {
        const OGRFeatureUniquePtr feature{OGRFeature::CreateFeature(layer->GetLayerDefn())};
        feature->SetField("HOLE_ID", ("KR0" + std::to_string(i)).c_str());
        feature->SetField("YEAR", 2000 + i);
        if (i != 1) {
            feature->SetField("GRADE", 0.1 * (i + 1));
        }
        OGRPoint point(208000.5 + i, 6797000.25, 7.125);
        if (OGR_GT_HasZ(type) == 0) {
            point.flattenTo2D();
        }
        feature->SetGeometry(&point);
        REQUIRE(layer->CreateFeature(feature.get()) == OGRERR_NONE);
    }
    REQUIRE(layer->CommitTransaction() == OGRERR_NONE);
    GDALClose(dataset);
}

Table table_with(const std::vector<std::string>& columns) {
    Table table;
    table.file = "t.csv";
    table.columns = columns;
    return table;
}

}  // namespace

TEST_CASE("ids of a CSV stay the text they are") {
    const testing::TemporaryFolder folder;
    const Table table = read_table({written(folder / "t.csv", "BHID,V\n0.0,1\n0,2\nDec-35,3\n007 ,4\n1e5,5\n")});
    CHECK(table.columns == std::vector<std::string>{"BHID", "V"});
    CHECK(table.cells[0] == std::vector<std::string>{"0.0", "0", "Dec-35", "007", "1e5"});
    CHECK(table.lines == std::vector<std::int64_t>{2, 3, 4, 5, 6});
}

TEST_CASE("byte-order marks, semicolons, quoted numbers, trailing separators and Windows letters are read") {
    const testing::TemporaryFolder folder;
    const Table bom = read_table({written(folder / "bom.csv", "\xEF\xBB\xBFHOLE;X;;\r\nA;\"1.5\";;\r\nB;2;;\r\n")});
    CHECK(bom.columns == std::vector<std::string>{"HOLE", "X"});
    CHECK(rows_of(bom) == Rows{{"A", "1.5"}, {"B", "2"}});
    CHECK(read_table({written(folder / "l1.csv", "id,x\n\xC4\xE4nekoski,1\n")}).cells[0][0] == "Äänekoski");
    CHECK(read_table({written(folder / "tab.tsv", "id\tx\nA\t1\n")}).cells[1][0] == "1");
    CHECK(read_table({written(folder / "t.txt", "id,x\nA,1\n")}).cells[1][0] == "1");
}

TEST_CASE("lines of a CSV are those an editor shows, past blank lines and quoted line ends") {
    const testing::TemporaryFolder folder;
    const Table table = read_table({written(folder / "t.csv", "id,x\n\nA,1\n\"B\nb\",2\n\n\nC,3")});
    CHECK(table.lines == std::vector<std::int64_t>{3, 4, 8});
    const Table filtered = read_table(parse_source((folder / "t.csv") + ",where=id='C'"));
    CHECK(filtered.lines == std::vector<std::int64_t>{8});
    const Table mac = read_table({written(folder / "mac.csv", "id,x\rA,1\rB,2\r")});
    CHECK(mac.lines == std::vector<std::int64_t>{2, 3});
}

TEST_CASE("a header with a number in it is still a header when it names holes and depths") {
    const testing::TemporaryFolder folder;
    const Table table = read_table({written(folder / "t.csv", "BHID,FROM,TO,2019\nA,0,1,5\n")});
    CHECK(table.columns == std::vector<std::string>{"BHID", "FROM", "TO", "2019"});
    CHECK(table.rows() == 1);
    CHECK(table.lines.front() == 2);
    const Table bare = read_table({written(folder / "bare.csv", "A,0,1,5\nB,0,1,6\n")});
    CHECK(bare.rows() == 2);
    CHECK(bare.lines.front() == 1);
}

TEST_CASE("decimal commas are read as such where they can be nothing else") {
    const testing::TemporaryFolder folder;
    const Table table = read_table({written(folder / "t.csv", "id;x;v\nA;1,5;1,125\nB;2,25;3\n1,7;4;5\n")});
    CHECK(rows_of(table) == Rows{{"A", "1.5", "1.125"}, {"B", "2.25", "3"}, {"1,7", "4", "5"}});
    REQUIRE(table.notes.size() == 1);
    CHECK_THAT(table.notes.front(), Contains("decimal comma") && Contains("x, v"));
    const Table thousands = read_table({written(folder / "k.csv", "id;x;v\nA;1,500;1.5\n")});
    CHECK(rows_of(thousands) == Rows{{"A", "1500", "1.5"}});  // beside a point, it parts thousands
    const Table alone = read_table({written(folder / "a.csv", "id;x\nA;1,500\n")});
    CHECK(rows_of(alone) == Rows{{"A", "1,500"}});
    CHECK(alone.notes.empty());
}

TEST_CASE("GeoPackage and Shapefile give points, CRS and numbers without artefacts") {
    const testing::TemporaryFolder folder;
    for (const auto& [driver, name] :
         {std::pair{"GPKG", "c.gpkg"}, std::pair{"ESRI Shapefile", "c.shp"}, std::pair{"FlatGeobuf", "c.fgb"}}) {
        INFO(driver);
        write_points(driver, folder / name, wkbPoint25D);
        const Table table = read_table({folder / name});
        REQUIRE(rows_of(table).size() == 3);
        const Rows rows = rows_of(table);
        CHECK(std::ranges::count(rows, std::vector<std::string>{"KR00", "2000", "0.1"}) == 1);
        CHECK(std::ranges::count(rows, std::vector<std::string>{"KR01", "2001", ""}) == 1);
        REQUIRE(table.points.size() == 3);
        CHECK(std::ranges::min(table.lines) == 1);
        CHECK(std::ranges::max(table.lines) == 3);
        CHECK(std::ranges::count(table.points, std::optional(Vec3{208001.5, 6797000.25, 7.125})) == 1);
        CHECK_THAT(table.crs.name, Contains("TM35FIN"));
    }
    write_points("GPKG", folder / "flat.gpkg", wkbPoint);
    CHECK(std::isnan(read_table({folder / "flat.gpkg"}).points.front()->z));
}

TEST_CASE("layers are chosen by name, filter or statement") {
    const testing::TemporaryFolder folder;
    write_points("GPKG", folder / "c.gpkg", wkbPoint25D);
    CHECK(read_table(parse_source((folder / "c.gpkg") + ",layer=collars,where=YEAR>2000")).rows() == 2);
    CHECK(
        read_table(parse_source((folder / "c.gpkg") + ",sql=SELECT HOLE_ID, YEAR*2 AS y2 FROM collars")).cells[1][0] ==
        "4000");
    CHECK(read_table(parse_source((folder / "c.gpkg") + ",sql=SELECT YEAR FROM collars WHERE YEAR>2000")).lines ==
          std::vector<std::int64_t>{1, 2});
    CHECK_THROWS_WITH(read_table(parse_source((folder / "c.gpkg") + ",layer=holes")), Contains("layers: collars"));
    CHECK_THROWS_AS(read_table(parse_source((folder / "c.gpkg") + ",where=NOT A FILTER(")), InputError);
    CHECK_THROWS_AS(read_table(parse_source((folder / "c.gpkg") + ",sql=SELECT nothing FROM nowhere")), InputError);
    CHECK_THROWS_WITH(read_table(parse_source((folder / "c.gpkg") + ",where=YEAR>3000")), Contains("no row"));
}

TEST_CASE("a damaged table is refused rather than read in part") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "c.gpkg";
    write_points("GPKG", path, wkbPoint25D, 20000);
    REQUIRE(read_table({path}).rows() == 20000);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(600 * 1024);
    file << std::string(40 * 4096, '\xFF');
    file.close();
    CHECK_THROWS_WITH(read_table({path}), Contains("reading failed after"));
}

TEST_CASE("zipped tables are read in place") {
    const testing::TemporaryFolder folder;
    const std::string inside = "/vsizip/" + (folder / "t.zip") + "/deep/t.csv";
    VSILFILE* file = VSIFOpenL(inside.c_str(), "wb");
    REQUIRE(file != nullptr);
    const std::string text = "id,x\nA,1\nB,2\n";
    VSIFWriteL(text.data(), 1, text.size(), file);
    VSIFCloseL(file);
    const Table table = read_table({inside});
    CHECK(table.rows() == 2);
    CHECK(table.lines == std::vector<std::int64_t>{2, 3});
}

TEST_CASE("what is no table is refused with one clear message") {
    const testing::TemporaryFolder folder;
    std::string binary = "PK\x03\x04";
    binary.resize(3000, '\0');
    const auto message = [](const std::string& path, const std::string& where = "") -> std::string {
        try {
            read_table({.path = path, .where = where});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK_THAT(message(folder / "none.csv"), Contains("none.csv: not found"));
    CHECK_THAT(message(folder.path().string()), Contains("folder"));
    CHECK_THAT(message(written(folder / "empty.csv", "")), Contains("empty"));
    CHECK_THAT(message(written(folder / "header.csv", "id,x,y,z\n")), Contains("no row below its header"));
    CHECK_THAT(message(written(folder / "binary.csv", binary)), Contains("binary"));
    CHECK_THAT(message(written(folder / "binary.dat", binary)), Contains("no table that can be read"));
    CHECK_THAT(message(written(folder / "broken.xlsx", binary)), Contains("no table that can be read"));
    CHECK_THAT(message(written(folder / "broken.gpkg", binary)), Contains("no table that can be read"));
    const std::string wide = written(folder / "utf16.csv", std::string("\xFF\xFEi\0d\0\n\0", 8));
    CHECK_THAT(message(wide), Contains("no row below its header"));
    CHECK_THAT(message(wide, "id > 1"), Contains("UTF-16"));
    CHECK_THAT(message(written(folder / "page.html", "<html><body>no</body></html>")), Contains("no table"));
    CHECK_THAT(message(written(folder / "a.dxf", "0\nSECTION\n")), !Contains("hang"));
    CHECK_THAT(message("PG:host=127.0.0.1 port=1 dbname=none password=secret connect_timeout=1"),
               Contains("no table that can be read") && !Contains("secret"));
}

TEST_CASE("columns are found by the usual aliases in any case, units and punctuation") {
    const Table collar = table_with({"Hole-ID", "Easting [m]", "NORTHING (m)", "rl", "EOH"});
    CHECK(find_column(collar, Meaning::id, {}) == 0);
    CHECK(find_column(collar, Meaning::x, {}) == 1);
    CHECK(find_column(collar, Meaning::y, {}) == 2);
    CHECK(find_column(collar, Meaning::z, {}) == 3);
    CHECK(find_column(collar, Meaning::length, {}) == 4);
    CHECK(find_column(collar, Meaning::dip, {}) == -1);
    for (const char* id : {"BHID", "HOLEID", "HOLE_ID", "dhid", "SITE_ID", "CollarID", "WELL", "UWI", "BORE"}) {
        CHECK(find_column(table_with({"X", id}), Meaning::id, {}) == 1);
    }
    for (const char* depth : {"AT", "DEPTH", "DEPTH_M", "Depth_ft", "MD"}) {
        CHECK(find_column(table_with({"X", depth}), Meaning::depth, {}) == 1);
    }
    for (const char* dip : {"DIP", "INCLINATION", "INCL", "PLUNGE", "DEVI_deg"}) {
        CHECK(find_column(table_with({"X", dip}), Meaning::dip, {}) == 1);
    }
    for (const char* azimuth : {"AZ", "AZIMUTH", "BRG", "DIRECTION", "HAZI_deg"}) {
        CHECK(find_column(table_with({"X", azimuth}), Meaning::azimuth, {}) == 1);
    }
    for (const char* from : {"FROM", "FROM_M", "Depth_From", "TOP"}) {
        CHECK(find_column(table_with({"X", from}), Meaning::from, {}) == 1);
    }
    for (const char* x : {"XCOLLAR", "X", "EAST", "EASTING", "LON", "LocationX"}) {
        CHECK(find_column(table_with({"ID", x}), Meaning::x, {}) == 1);
    }
    for (const char* z : {"Z", "ELEV", "RL", "ZCOLLAR", "elevation_z"}) {
        CHECK(find_column(table_with({"ID", z}), Meaning::z, {}) == 1);
    }
    // A mid-point coordinate is no position of a collar.
    CHECK(find_column(table_with({"DHID", "xm", "ym", "zm"}), Meaning::x, {}) == -1);
    CHECK(find_column(table_with({"depth", "md"}), Meaning::depth, {}) == 1);
}

TEST_CASE("named columns go before aliases, and a misspelt one is told") {
    const Table table = table_with({"BHID", "WELLNO", "X"});
    CHECK(find_column(table, Meaning::id, {{"id", "wellno"}}) == 1);
    CHECK(find_column(table, Meaning::id, {{"id", "OTHER"}}) == 0);  // meant for another table
    CHECK(find_column(table, Meaning::id, {{"id", "OTHER"}, {"id", "WELLNO"}}) == 1);
    CHECK(find_optional_column(table, Meaning::y, {{"y", "NORD"}}) == -1);
    CHECK_THROWS_WITH(find_column(table, Meaning::y, {{"y", "NORD"}}), Contains("NORD") && Contains("WELLNO"));
    CHECK_THROWS_AS(find_column(table, Meaning::y, {{"y", "NORD"}}), UsageError);
    CHECK_THROWS_WITH(find_column(table, Meaning::x, {{"easting", "X"}}), Contains("no such meaning"));
}

TEST_CASE("a number is a whole cell, finite, and without locale") {
    CHECK(parse_number("1.5") == 1.5);
    CHECK(parse_number(" -2e-3 ") == -2e-3);
    CHECK(parse_number("+7") == 7);
    CHECK(parse_number(".5") == .5);
    for (const char* bad : {"", " ", "1,5", "1.5m", "nan", "inf", "-inf", "1e999", "0x1A", "1 2", "+-1", "--", "abc"}) {
        INFO(bad);
        CHECK_FALSE(parse_number(bad));
    }
}

TEST_CASE("headers and numbers of workbooks read well") {
    const auto folder = testing::public_data("subsurface/tests/data/borehole");
    if (!folder) {
        WARN("SKIPPED: public data absent");
        return;
    }
    const Table collars = read_table({(*folder / "wells-database-small.xlsx").string(), "collar"});
    CHECK(collars.columns == std::vector<std::string>{"HOLE", "EAST", "NORT", "ELEV", "EODH"});
    CHECK(rows_of(collars).front() ==
          std::vector<std::string>{"NC-01", "424577.243059", "5477543.62945", "372", "58.83"});
    CHECK(collars.lines.front() == 2);
    const Table bare = read_table({(*folder / "borehole_collar.xlsx").string()});
    CHECK(rows_of(bare).front() == std::vector<std::string>{"foo", "691342.0472", "4164009.011", "134.94", "508.4"});
}

TEST_CASE("the manual lists every alias of every meaning") {
    std::ifstream file(testing::source_dir() / "docs/inputs.md");
    const std::string manual{std::istreambuf_iterator<char>(file), {}};
    for (int i = 0; i <= static_cast<int>(Meaning::name); ++i) {
        const auto meaning = static_cast<Meaning>(i);
        std::string row = "| " + std::string(to_string(meaning)) + " |";
        for (const std::string& alias : aliases(meaning)) {
            CHECK(normal_header(alias) == alias);
            row += " " + alias;
        }
        row += " |\n";
        std::transform(row.begin() + 2, row.end(), row.begin() + 2,
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        const std::string name = to_string(meaning);
        std::copy(name.begin(), name.end(), row.begin() + 2);
        INFO(row);
        CHECK(manual.find(row) != std::string::npos);
    }
}

TEST_CASE("texts are split by what parts their lines most evenly, whatever else they hold") {
    CHECK(separator_of("X;Y;Z\n1,5;2,5;3,5\n") == ';');
    CHECK(separator_of("a,b\n1,2\n") == ',');
    CHECK(separator_of("Hole, name;X\nA, 1;2\nB;3\n") == ';');
    CHECK(separator_of("x\ty\n1,0\t2,0\n") == '\t');
    CHECK(separator_of("# made by hand\nx  y   z\n1 2 3\n4   5 6\n7 8 9\n") == ' ');
    CHECK(separator_of("Hole name\nA\nB\n") == ',');
    const testing::TemporaryFolder folder;
    const Table spaced = read_table({written(folder / "s.txt", "# x y  K\n 1  2 0.5\n3 4   1e-7 \n")});
    CHECK(spaced.columns == std::vector<std::string>{"x", "y", "K"});
    CHECK(rows_of(spaced) == Rows{{"1", "2", "0.5"}, {"3", "4", "1e-7"}});
    const Table more = read_table({written(folder / "m.csv", "id,x\nA,2,600\nB,1,\n")});
    REQUIRE(more.notes.size() == 1);
    CHECK_THAT(more.notes.front(), Contains("1 records have more cells") && Contains("line 2"));
}

TEST_CASE("a quotation mark within a cell is a letter, one that begins a cell must end it") {
    const testing::TemporaryFolder folder;
    const Table table = read_table(
        {written(folder / "q.csv", "id,lat,note\nA,41°17'24\"S,6\" pipe\nB,\"41°17'24\"\"S\",\"a \"b\" c\"\n")});
    CHECK(rows_of(table) == Rows{{"A", "41°17'24\"S", "6\" pipe"}, {"B", "41°17'24\"S", "a \"b\" c"}});
    CHECK_THROWS_WITH(read_table({written(folder / "open.csv", "id,x\nA,1\nB,\"2\nC,3\n")}),
                      Contains("line 3: a quotation mark begins a cell that does not end"));
}

TEST_CASE("a text is split to the same cells wherever its buffer ends") {
    const testing::TemporaryFolder folder;
    std::string text = "id,x,note\r\n";
    Rows rows;
    testing::Random random(7);
    for (int row = 0; row < 30000; ++row) {
        const std::string id = "h" + std::to_string(random.below(1000));
        const std::string note = random.below(3) == 0 ? "a, \"b\"\n" + std::string(random.below(40), 'x') : "";
        std::string quoted = note;
        for (std::size_t k = quoted.find('"'); k != std::string::npos; k = quoted.find('"', k + 2)) {
            quoted.insert(k, 1, '"');
        }
        const std::string x = std::to_string(row);
        rows.push_back({id, x, note});
        while (!rows.back()[2].empty() && rows.back()[2].back() == ' ') {
            rows.back()[2].pop_back();
        }
        text += id + "," + x + (note.empty() ? "," : ",\"" + quoted + "\"") + (random.below(2) == 0 ? "\r\n" : "\n");
    }
    REQUIRE(text.size() > 2 * (1U << 18U));
    CHECK(rows_of(read_table({written(folder / "long.csv", text)})) == rows);
}

TEST_CASE("numbers are read as people group them; what may be either is left") {
    const testing::TemporaryFolder folder;
    const auto column = [&](const std::string& text) { return read_table({written(folder / "n.csv", text)}).cells[1]; };
    using Text = std::vector<std::string>;
    for (const std::string sign : {"'", "’", " ", "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"}) {
        INFO(sign);
        CHECK(column("id;x\nA;2" + sign + "600" + sign + "000.25\nB;-1" + sign + "200\nC;450\n") ==
              Text{"2600000.25", "-1200", "450"});
        CHECK(column("id;x\nA;2" + sign + "600" + sign + "000,25\nB;<1" + sign + "200,5\n") ==
              Text{"2600000.25", "<1200.5"});
    }
    CHECK(column("id;x\nA;2.600.000,25\nB;1.200\n") == Text{"2600000.25", "1200"});
    CHECK(column("id,x\nA,\"2,600,000.25\"\nB,\"1,200\"\n") == Text{"2600000.25", "1200"});
    CHECK(column("id;x\nA;0,5\nB;<0,01\nC;> 12,5\nD;ND\n") == Text{"0.5", "<0.01", ">12.5", "ND"});
    CHECK(column("id;x;y\nA;1.500;2.600.000\nB;2.250;2.600.001\n") == Text{"1500", "2250"});
    CHECK(column("id;x;y\nA;1.500;2,5\nB;2.250;3,5\n") == Text{"1.500", "2.250"});  // a point still is one
    CHECK(column("id;x\nA;1,500\nB;2,250\n") == Text{"1,500", "2,250"});
    CHECK(column("id;x\nA;0.5\nB;0,8\n") == Text{"0.5", "0,8"});
    CHECK(column("id;x\nA;12 34\nB;2021-03-01\n") == Text{"12 34", "2021-03-01"});
    CHECK(column("id;x\nA;1,5e3\nB;,5\n") == Text{"1.5e3", ".5"});
}

TEST_CASE("titles above a header, a separator that is said, units below and blank rows are no records") {
    const testing::TemporaryFolder folder;
    const Rows expected{{"A", "1", "2", "3"}, {"B", "4", "5", "6"}};
    const auto read = [&](const std::string& text) { return read_table({written(folder / "t.csv", text)}); };
    const std::string rows = "A,1,2,3\nB,4,5,6\n";
    for (const std::string above :
         {"", "sep=,\n", "Project,,,\n,,,\n", "Project\n\nprinted 2024\n", "Hole,Place,,\n", "# a comment\nTitle\n"}) {
        INFO(above);
        const Table table = read(above + "BHID,X,Y,Z\n" + rows);
        CHECK(table.columns == std::vector<std::string>{"BHID", "X", "Y", "Z"});
        CHECK(rows_of(table) == expected);
        CHECK(table.lines.back() == 3 + std::count(above.begin(), above.end(), '\n'));
    }
    for (const std::string units : {",m,m,m\n", "-,[m],[m],m AHD\n", ",ft,ft,ft\n"}) {
        INFO(units);
        const Table table = read("BHID,X,Y,Z\n" + units + ",,,\n" + rows + ",,,\n\x1A");
        CHECK(rows_of(table) == expected);
        REQUIRE(table.stated.units.size() == 4);
        CHECK(table.stated.units[1] == (units.starts_with(",ft") ? "ft" : "m"));
        CHECK_THAT(table.notes.at(0), Contains("line 2 holds the units"));
    }
    // Words that are no units are values, and a header that nobody knows stays one.
    CHECK(read("BHID,X,Y,Z\n,north,south,up\n" + rows).rows() == 3);
    CHECK(read("a,b\np,q\n1,2\n").columns == std::vector<std::string>{"a", "b"});
    // A table without header is one still.
    CHECK(read("1,2,3\n4,5,6\n").rows() == 2);
}

TEST_CASE("a sheet's header is found below its notes, and blank rows of it are none") {
    const testing::TemporaryFolder folder;
    GDALAllRegister();
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("XLSX");
    REQUIRE(driver != nullptr);
    const std::string path = folder / "sheet.xlsx";
    GDALDataset* dataset = driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    OGRLayer* layer = dataset->CreateLayer("collar", nullptr, wkbNone, nullptr);
    const Rows rows{{"printed", "", "", ""}, {"BHID", "X", "Y", "Z"}, {"", "m", "m", "m"},
                    {"A", "1", "2.5", "3"},  {"", "", "", ""},        {"B", "4", "5", "6"}};
    for (const char* name : {"Project Alpha", "b", "c", "d"}) {
        OGRFieldDefn field(name, OFTString);
        layer->CreateField(&field);
    }
    for (const auto& row : rows) {
        OGRFeature feature(layer->GetLayerDefn());
        for (int column = 0; column < 4; ++column) {
            if (!row[static_cast<std::size_t>(column)].empty()) {
                feature.SetField(column, row[static_cast<std::size_t>(column)].c_str());
            }
        }
        REQUIRE(layer->CreateFeature(&feature) == OGRERR_NONE);
    }
    GDALClose(dataset);
    const Table table = read_table({path});
    CHECK(table.columns == std::vector<std::string>{"BHID", "X", "Y", "Z"});
    CHECK(rows_of(table) == Rows{{"A", "1", "2.5", "3"}, {"B", "4", "5", "6"}});
}

TEST_CASE("E and N are a place together, and nothing alone") {
    CHECK(find_column(table_with({"Hole", "N", "E", "RL"}), Meaning::x, {}) == 2);
    CHECK(find_column(table_with({"Hole", "N", "E", "RL"}), Meaning::y, {}) == 1);
    CHECK(find_column(table_with({"Hole", "From", "To", "N"}), Meaning::y, {}) == -1);
    CHECK(find_column(table_with({"Hole", "E", "N", "Easting", "Northing"}), Meaning::x, {}) == 3);
}

TEST_CASE("short decimals are read as exactly as long ones") {
    testing::Random random(8);
    for (int k = 0; k < 100000; ++k) {
        const int decimals = static_cast<int>(random.below(10));
        char text[40];
        std::snprintf(text, sizeof text, "%.*f", decimals,
                      random(-1, 1) * std::pow(10.0, static_cast<double>(random.below(9))));
        REQUIRE(parse_number(text) == std::strtod(text, nullptr));
    }
    CHECK(parse_number("9007199254740993") == 9007199254740992.0);
    CHECK(std::signbit(parse_number("-0").value()));
    for (const char* text : {"", "-", ".", "1.", ".5", "1.2.3", "1e5", "+7", "- 1", "0x10", "12345678901234567890"}) {
        char* end = nullptr;
        const double value = std::strtod(text, &end);
        const std::string whole = text;
        const bool number = !whole.empty() && *end == '\0' && whole != "0x10";
        INFO(text);
        CHECK(parse_number(text).has_value() == number);
        CHECK((!number || parse_number(text) == value));
    }
}
