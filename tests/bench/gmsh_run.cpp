// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <fstream>
#include <string>

#include "peer.hpp"
#include "tests/support.hpp"

namespace terratet::bench {

std::optional<MeshResult> gmsh(const PointsInBox& task, double size, bool optimise) {
    const testing::TemporaryFolder folder;
    {
        std::ofstream file(folder / "task");
        file.precision(17);
        const auto write = [&](const Vec3& p) { file << p.x << ' ' << p.y << ' ' << p.z << '\n'; };
        write(task.box.lo);
        write(task.box.hi);
        std::ranges::for_each(task.points, write);
    }
    const std::string command =
        std::string(TERRATET_GMSH_PEER) + " " + std::to_string(size) + (optimise ? " 1 < " : " 0 < ") + folder / "task";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        return std::nullopt;
    }
    MeshResult r;
    const int read = std::fscanf(pipe, "%lf %zu %zu %lf %lf %lf", &r.seconds, &r.vertices, &r.cells, &r.longest_edge,
                                 &r.dihedral_p1_deg, &r.sharp_percent);
    const bool done = pclose(pipe) == 0 && read == 6;
    return done ? std::optional(r) : std::nullopt;
}

}  // namespace terratet::bench
