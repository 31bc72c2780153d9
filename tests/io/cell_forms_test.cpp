// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <fstream>

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

}  // namespace

TEST_CASE("numbers are read in the forms that people give them, with a note; a unit only where most carry it") {
    const testing::TemporaryFolder folder;
    const Table table = read_table({written(folder / "forms.csv",
                                            "HOLE,PC,AU,K,T,E,MIX\n"
                                            "A,95%,1.2 g/t,1.0D-08,\xE2\x88\x92"
                                            "1.5,1.2\xC2\xB1"
                                            "0.1,3\n"
                                            "B,<0.5 %,1.3 g/t,2.0\xC3\x97"
                                            "10^-8,2,1.3,12%\n"
                                            "C,100%,2,1.5x10-9,3,1.4,4\n")});
    CHECK(table.cells[1] == std::vector<std::string>{"95", "<0.5", "100"});
    CHECK(table.cells[2] == std::vector<std::string>{"1.2", "1.3", "2"});
    CHECK(table.cells[3] == std::vector<std::string>{"1.0E-08", "2.0E-8", "1.5E-9"});
    CHECK(table.cells[4] == std::vector<std::string>{"-1.5", "2", "3"});
    CHECK(table.cells[5] == std::vector<std::string>{"1.2", "1.3", "1.4"});
    CHECK(table.cells[6] == std::vector<std::string>{"3", "12%", "4"});
    CHECK(table.stated.units == std::vector<std::string>{"", "%", "g/t", "", "", "", ""});
    CHECK(table.notes.size() >= 5);
}

TEST_CASE("GSLIB tables have their columns' names above the numbers") {
    const testing::TemporaryFolder folder;
    for (const std::string separator : {" ", "  ", ","}) {
        const std::string text = "Cluster data\n4 10 10\nXlocation\nYlocation\nZlocation\nAu, g/t\n 39.5" + separator +
                                 "18.5" + separator + "1" + separator + "0.06\n5.5" + separator + "1.5" + separator +
                                 "2" + separator + "0.08\n";
        const Table table = read_table({written(folder / "cluster.dat", text)});
        CHECK(table.columns == std::vector<std::string>{"Xlocation", "Ylocation", "Zlocation", "Au, g/t"});
        CHECK(rows_of(table) == Rows{{"39.5", "18.5", "1", "0.06"}, {"5.5", "1.5", "2", "0.08"}});
        CHECK(table.lines == std::vector<std::int64_t>{7, 8});
    }
}

TEST_CASE("blanks without a break round a cell are none, and a header broken into lines is one") {
    const testing::TemporaryFolder folder;
    const Table table = read_table({written(folder / "blanks.csv",
                                            "HOLEID\xE2\x80\x8B,\"From\n(m)\",TO,Au\n"
                                            "A\xC2\xA0,0,10,1\n\xC2\xA0"
                                            "B,0,10,2\n")});
    CHECK(table.columns == std::vector<std::string>{"HOLEID", "From (m)", "TO", "Au"});
    CHECK(table.cells[0] == std::vector<std::string>{"A", "B"});
}

TEST_CASE("what is no table says what it is and what to do") {
    const testing::TemporaryFolder folder;
    CHECK_THROWS_WITH(read_table({written(folder / "a.pdf", "%PDF-1.4\n1 0 obj\n")}), Contains("is a PDF"));
    CHECK_THROWS_WITH(read_table({written(folder / "a.kml", "<?xml version=\"1.0\"?><kml><Placemark/></kml>")}),
                      Contains("ogr2ogr"));
    CHECK_THROWS_WITH(read_table({written(folder / "a.gz", std::string("\x1F\x8B\x08\0\0\0", 6))}),
                      Contains("/vsigzip/"));
    CHECK_THROWS_WITH(read_table({written(folder / "a.mdb", std::string("\0\1\0\0Standard Jet DB\0", 20))}),
                      Contains("Access"));
}
