// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <charconv>
#include <fstream>

#include "grid_model.hpp"
#include "io/base/csv_text.hpp"
#include "io/export.hpp"
#include "io/read/tables/read_table.hpp"
#include "support.hpp"

using namespace terratet;
using terratet::testing::GridModel;
using terratet::testing::TemporaryFolder;

namespace {

/// Records of an RFC 4180 file, written from the RFC's grammar: the test's own reader.
std::vector<std::vector<std::string>> parse(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<std::vector<std::string>> records(1, {""});
    bool quoted = false;
    for (char c; file.get(c);) {
        if (c == '"') {
            if (quoted && file.peek() == '"') {
                records.back().back() += static_cast<char>(file.get());
            } else {
                quoted = !quoted;
            }
        } else if (!quoted && c == ',') {
            records.back().emplace_back();
        } else if (!quoted && c == '\n') {
            records.push_back({""});
        } else {
            records.back().back() += c;
        }
    }
    records.pop_back();
    return records;
}

double number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    REQUIRE((error == std::errc() && end == text.data() + text.size()));
    return value;
}

}  // namespace

TEST_CASE("CSV gives each vertex with its values back bit for bit, missing ones as nothing, classes by name") {
    const GridModel grid;
    const TemporaryFolder folder;
    write_csv({grid.model, grid.mesh, grid.cells}, folder / "a.csv", {});
    const auto records = parse(folder / "a.csv");
    REQUIRE(records.size() == grid.model.vertices.size() + 1);
    CHECK(records[0] == std::vector<std::string>{"x", "y", "z", "id", "role", "owner", "side", "conductivity",
                                                 "temperature, mean", "lithology", "extrapolation"});
    std::size_t missing_values = 0;
    for (std::size_t v = 0; v < grid.model.vertices.size(); ++v) {
        const auto& row = records[v + 1];
        REQUIRE(row.size() == 11);
        const Vertex& vertex = grid.model.vertices[v];
        REQUIRE(Vec3{number(row[0]), number(row[1]), number(row[2])} == grid.model.frame.to_world(vertex.position));
        REQUIRE(row[3] == std::to_string(vertex.id));
        REQUIRE(row[6] == std::to_string(vertex.side));
        REQUIRE(number(row[7]) == grid.model.vertex_values.values[0][v]);
        const double temperature = grid.model.vertex_values.values[1][v];
        missing_values += row[8].empty();
        REQUIRE((std::isnan(temperature) ? row[8].empty() : number(row[8]) == temperature));
        REQUIRE(row[9] ==
                grid.model.properties[2].classes[static_cast<std::size_t>(grid.model.vertex_values.values[2][v])]);
    }
    CHECK(missing_values > 5);
}

TEST_CASE("CSV says which samples' values are bounds") {
    GridModel grid;
    Vertex& sample = *std::ranges::find(grid.model.vertices, Role::sample, &Vertex::role);
    grid.model.samples.set_censoring(1, static_cast<std::size_t>(sample.owner), Censoring::below);
    const TemporaryFolder folder;
    write_csv({grid.model, grid.mesh, grid.cells}, folder / "a.csv", {});
    const auto records = parse(folder / "a.csv");
    REQUIRE(records[0].size() == 12);
    CHECK(records[0][10] == "extrapolation");
    CHECK(records[0][11] == "temperature, mean_censored");
    for (std::size_t v = 0; v < grid.model.vertices.size(); ++v) {
        REQUIRE(records[v + 1][11] == (&grid.model.vertices[v] == &sample ? "<" : ""));
    }
}

TEST_CASE("CSV names owners, and quotes what needs it") {
    GridModel grid;
    grid.model.boreholes[0].id = "line\nbreak";
    grid.model.properties[0].name = "x";
    const TemporaryFolder folder;
    write_csv({grid.model, grid.mesh, grid.cells}, folder / "a.csv", {});
    const auto records = parse(folder / "a.csv");
    CHECK(records[0][7] == "x_2");
    std::size_t samples = 0;
    for (std::size_t v = 0; v < grid.model.vertices.size(); ++v) {
        const Vertex& vertex = grid.model.vertices[v];
        const auto& row = records[v + 1];
        if (vertex.role == Role::seed) {
            REQUIRE(row[4] == "seed");
            REQUIRE(row[5] == "BFZ \"100\"");
        } else if (vertex.role == Role::sample) {
            const auto hole = grid.model.samples.borehole[static_cast<std::size_t>(vertex.owner)];
            REQUIRE(row[5] == grid.model.boreholes[static_cast<std::size_t>(hole)].id);
            ++samples;
        } else {
            REQUIRE(row[5].empty());
        }
    }
    CHECK(samples > 50);
}

TEST_CASE("What a spreadsheet would run is marked, numbers are not, and our reader takes the mark away") {
    const auto field = [](const std::string& text) {
        std::string row;
        append_csv_text(row, text);
        return row;
    };
    CHECK(field("=1+1") == "'=1+1");
    CHECK(field("+a") == "'+a");
    CHECK(field("-2+3") == "'-2+3");
    CHECK(field("@SUM(A1)") == "'@SUM(A1)");
    CHECK(field("\t=1") == "'\t=1");
    CHECK(field("\r=1") == "\"'\r=1\"");
    CHECK(field("=cmd|' /C calc'!A0,\"x\"") == "\"'=cmd|' /C calc'!A0,\"\"x\"\"\"");
    CHECK(field("'=a") == "''=a");
    for (const char* text : {"-2", "+3.5", "-1e-300", "-", "", "a=b", "'quoted'", "x-1", "2-1"}) {
        CHECK(field(text) == text);
    }
    const TemporaryFolder folder;
    const std::vector<std::string> texts = {"=1+1", "'=a", "''+b", "-2", "-2+3", "@", "'", "it's", "-", "＝1", "end"};
    std::string head = "x,y,z", cells = "1,2,3";
    for (const std::string& text : texts) {
        head += ',' + field("c" + text) + ',' + field(text);
        cells += ',' + field(text) + ',' + field(text);
    }
    std::ofstream(folder / "a.csv") << head << '\n' << cells << '\n';
    Source source;
    source.path = folder / "a.csv";
    const Table table = read_table(source);
    REQUIRE(table.columns.size() == 3 + 2 * texts.size());
    for (std::size_t i = 0; i + 1 < texts.size(); ++i) {  // blanks round the last one do not count
        INFO(texts[i]);
        CHECK(table.columns[4 + 2 * i] == texts[i]);
        CHECK(table.cells[4 + 2 * i][0] == texts[i]);
    }
}
