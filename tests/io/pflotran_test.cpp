// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/SparseCholesky>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "io/export.hpp"
#include "support.hpp"
#include "tess/tessellation.hpp"

using namespace terratet;
using terratet::testing::Random;
using terratet::testing::TemporaryFolder;

namespace {

/// As PFLOTRAN's manual describes it.
struct Grid {
    std::vector<Vec3> centre;
    std::vector<double> volume;
    struct Connection {
        std::size_t a, b;
        Vec3 place;
        double area;
    };
    std::vector<Connection> connections;

    explicit Grid(const std::string& path) {
        std::ifstream file(path);
        std::string keyword;
        std::size_t count = 0;
        file >> keyword >> count;
        REQUIRE(keyword == "CELLS");
        for (std::size_t c = 0; c < count; ++c) {
            std::size_t number = 0;
            Vec3 p;
            double v = 0;
            file >> number >> p.x >> p.y >> p.z >> v;
            REQUIRE(number == c + 1);
            centre.push_back(p);
            volume.push_back(v);
        }
        file >> keyword >> count;
        REQUIRE(keyword == "CONNECTIONS");
        for (std::size_t c = 0; c < count; ++c) {
            Connection one{};
            file >> one.a >> one.b >> one.place.x >> one.place.y >> one.place.z >> one.area;
            --one.a;
            --one.b;
            connections.push_back(one);
        }
        REQUIRE(file);
    }
};

std::set<std::size_t> cells_at(const std::filesystem::path& folder) {
    std::set<std::size_t> cells;
    for (const char* side : {"west", "east", "south", "north", "bottom", "top"}) {
        std::ifstream file(folder / (std::string(side) + ".ex"));
        std::string line;
        std::getline(file, line);
        while (std::getline(file, line)) {
            std::istringstream words(line);
            std::size_t cell = 0;
            words >> cell;
            cells.insert(cell - 1);
        }
    }
    return cells;
}

}  // namespace

TEST_CASE("A two-point-flux solve on the control volumes gives a pressure linear in space back") {
    Random random(7);
    Model model;
    model.frame.origin = {525312, 6791168, 0};
    model.domain.hull = {{-10, -20, -5}, {110, 120, 60}};
    model.domain.extent = {{0, 0, 0}, {100, 90, 50}};
    const Vec3 side = model.domain.hull.size();
    for (std::uint64_t i = 0; i < 1500; ++i) {
        const Vec3 corner = model.domain.hull.lo + Vec3{i & 1 ? side.x : 0, i & 2 ? side.y : 0, i & 4 ? side.z : 0};
        const Vec3 p = model.frame.snapped(i < 8 ? corner : random.in(model.domain.hull));
        model.vertices.push_back({i, p, Role::inserted, -1, 0});
    }
    const TetMesh mesh = tessellate(model).mesh();
    const CellTable cells = describe_cells(model, mesh);
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "flow.uge";
    write_uge({model, mesh, cells}, path.string(), {});
    const Grid grid(path.string());

    double volume = 0;
    for (const double v : grid.volume) {
        volume += v;
    }
    CHECK(std::abs(volume / model.domain.extent.volume() - 1) < 1e-9);
    const Vec3 origin = model.frame.to_world(model.domain.extent.center());
    const auto pressure = [&](const Vec3& p) { return 5 + dot(Vec3{0.3, -0.2, 0.7}, p - origin); };

    // Cells at the boundary keep theirs; all others follow from what flows between them.
    const auto outer = cells_at(folder.path() / "flow");
    const auto n = static_cast<Eigen::Index>(grid.centre.size());
    CHECK(n - static_cast<Eigen::Index>(outer.size()) > 200);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (const std::size_t cell : outer) {
        entries.emplace_back(cell, cell, 1.0);
        right[static_cast<Eigen::Index>(cell)] = pressure(grid.centre[cell]);
    }
    for (const auto& [a, b, place, area] : grid.connections) {
        const double conductance = area / (distance(grid.centre[a], place) + distance(place, grid.centre[b]));
        for (const auto& [here, there] : {std::pair(a, b), std::pair(b, a)}) {
            if (outer.contains(here)) {
                continue;
            }
            entries.emplace_back(here, here, conductance);
            if (outer.contains(there)) {
                right[static_cast<Eigen::Index>(here)] += conductance * pressure(grid.centre[there]);
            } else {
                entries.emplace_back(here, there, -conductance);
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    REQUIRE(solver.info() == Eigen::Success);
    const Eigen::VectorXd found = solver.solve(right);
    double worst = 0;
    for (Eigen::Index c = 0; c < n; ++c) {
        worst = std::max(worst, std::abs(found[c] - pressure(grid.centre[static_cast<std::size_t>(c)])));
    }
    CHECK(worst < 1e-7);  // coordinates of millions of metres have nine decimals
}
