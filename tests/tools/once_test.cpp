// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How often a call does what is costly: the linker hands each of these functions' calls to us first (--wrap).
#include <catch2/catch.hpp>

#include "tess/collapse.hpp"
#include "tess/model.hpp"
#include "tests/support.hpp"
#include "tools/commands/session.hpp"

using namespace terratet;

namespace {

struct Counts {
    int inserted_in_bulk = 0;
    int tessellated = 0;
    int described = 0;
    int collapsed = 0;
    int barriers_made = 0;
};
Counts counts;

}  // namespace

namespace terratet::real {

void insert(Tessellation* self, std::span<const Vertex> vertices, const Poll& poll) asm(
    "__real__ZN8terratet12Tessellation6insertESt4spanIKNS_6VertexELm18446744073709551615EERKSt8functionIFvvEE");
Tessellation tessellate(const Model& model) asm("__real__ZN8terratet10tessellateERKNS_5ModelE");
CellTable describe_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) asm(
    "__real__ZN8terratet14describe_cellsERKNS_5ModelERKNS_7TetMeshERKNS_12BarrierQueryE");
CollapsedModel
collapse_faults(const Model&, const TetMesh&, const CellTable&, const BarrierQuery&, Collapsing, const Progress&) asm(
    "__real__ZN8terratet15collapse_faultsERKNS_5ModelERKNS_7TetMeshERKNS_9CellTableERKNS_12BarrierQueryENS_"
    "10CollapsingERKSt8functionIFbSt17basic_string_viewIcSt11char_traitsIcEEdEE");

BarrierQuery model_proximity(const Model& model) asm("__real__ZN8terratet15model_proximityERKNS_5ModelE");

}  // namespace terratet::real

namespace terratet::wrap {

void insert(Tessellation* self, std::span<const Vertex> vertices, const Poll& poll) asm(
    "__wrap__ZN8terratet12Tessellation6insertESt4spanIKNS_6VertexELm18446744073709551615EERKSt8functionIFvvEE");
void insert(Tessellation* self, std::span<const Vertex> vertices, const Poll& poll) {
    ++counts.inserted_in_bulk;
    real::insert(self, vertices, poll);
}

Tessellation tessellate(const Model& model) asm("__wrap__ZN8terratet10tessellateERKNS_5ModelE");
Tessellation tessellate(const Model& model) {
    ++counts.tessellated;
    return real::tessellate(model);
}

CellTable describe_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) asm(
    "__wrap__ZN8terratet14describe_cellsERKNS_5ModelERKNS_7TetMeshERKNS_12BarrierQueryE");
CellTable describe_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) {
    ++counts.described;
    return real::describe_cells(model, mesh, barriers);
}

CollapsedModel
collapse_faults(const Model&, const TetMesh&, const CellTable&, const BarrierQuery&, Collapsing, const Progress&) asm(
    "__wrap__ZN8terratet15collapse_faultsERKNS_5ModelERKNS_7TetMeshERKNS_9CellTableERKNS_12BarrierQueryENS_"
    "10CollapsingERKSt8functionIFbSt17basic_string_viewIcSt11char_traitsIcEEdEE");
CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const BarrierQuery& barriers, Collapsing which, const Progress& progress) {
    ++counts.collapsed;
    return real::collapse_faults(model, mesh, cells, barriers, which, progress);
}

BarrierQuery model_proximity(const Model& model) asm("__wrap__ZN8terratet15model_proximityERKNS_5ModelE");
BarrierQuery model_proximity(const Model& model) {
    ++counts.barriers_made;
    return real::model_proximity(model);
}

}  // namespace terratet::wrap

TEST_CASE("A conversion to four outputs and a report tessellates once, describes cells once, collapses once") {
    const testing::TemporaryFolder folder;
    const auto data = [](const char* name) {
        return testing::project_data(std::string("olkiluoto-twin/") + name).string();
    };
    counts = {};
    const int code = tools::run_terratet({"convert",
                                          "--boreholes",
                                          data("collar.csv"),
                                          "--survey",
                                          data("survey.csv"),
                                          "--log",
                                          data("log.csv"),
                                          "--faults",
                                          data("fracture.ts"),
                                          "-s_srs",
                                          "EPSG:3067",
                                          "--lmin",
                                          "60",
                                          "--lmax",
                                          "240",
                                          "--estimator",
                                          "idw",
                                          "--fault-gap",
                                          "collapse",
                                          "-q",
                                          "--report",
                                          folder / "report.json",
                                          folder / "m.gpkg",
                                          folder / "m.vtu",
                                          folder / "m.glb",
                                          folder / "m.vdb"});
    CHECK(code == 0);
    CHECK(counts.inserted_in_bulk == 1);
    CHECK(counts.tessellated == 0);
    CHECK(counts.described == 1);
    CHECK(counts.collapsed == 1);
    CHECK(counts.barriers_made == 1);
}

namespace {

/// A small model with a fault.
std::string small_model(const testing::TemporaryFolder& folder) {
    REQUIRE(tools::run_terratet({"build", "--boreholes", testing::project_data("olkiluoto-twin/collar.csv").string(),
                                 "--log", testing::project_data("olkiluoto-twin/log.csv").string(), "--faults",
                                 testing::project_data("olkiluoto-twin/fracture.ts").string(), "-s_srs", "EPSG:3067",
                                 "--lmin", "60", "--lmax", "240", "--estimator", "idw", "-q", "-o",
                                 folder / "m.gpkg"}) == 0);
    counts = {};
    return folder / "m.gpkg";
}

}  // namespace

TEST_CASE("An export of a stored model to three outputs tessellates once, describes cells once, collapses once") {
    const testing::TemporaryFolder folder;
    const std::string model = small_model(folder);
    CHECK(tools::run_terratet({"export", "--fault-gap", "collapse", "-q", model, folder / "m.vtu", folder / "m.glb",
                               folder / "m.vdb"}) == 0);
    CHECK(counts.tessellated == 1);
    CHECK(counts.inserted_in_bulk == 1);
    CHECK(counts.described == 1);
    CHECK(counts.collapsed == 1);
    CHECK(counts.barriers_made == 1);
}

TEST_CASE("A check makes of the model what it looks at once, and the same once more in building it again") {
    const testing::TemporaryFolder folder;
    const std::string model = small_model(folder);
    CHECK(tools::run_terratet({"check", "-q", model}) == 0);
    CHECK(counts.tessellated == 1);
    CHECK(counts.inserted_in_bulk == 2);
    CHECK(counts.described == 2);
    CHECK(counts.barriers_made == 2);
}

TEST_CASE("An export of a model that is verified first goes on with what that made") {
    const testing::TemporaryFolder folder;
    const std::string model = small_model(folder);
    CHECK(tools::run_terratet({"export", "--accept-edited", "--fault-gap", "collapse", "-q", model, folder / "m.vtu",
                               folder / "m.vdb"}) == 0);
    CHECK(counts.tessellated == 1);
    CHECK(counts.described == 2);
    CHECK(counts.collapsed == 1);
    CHECK(counts.barriers_made == 2);
}

TEST_CASE("A validation of a stored model makes its barriers once and no tessellation") {
    const testing::TemporaryFolder folder;
    const std::string model = small_model(folder);
    CHECK(tools::run_terratet({"validate", "-q", "--estimator", "nearest", model}) == 0);
    CHECK(counts.tessellated == 0);
    CHECK(counts.described == 0);
    CHECK(counts.barriers_made == 1);
}
