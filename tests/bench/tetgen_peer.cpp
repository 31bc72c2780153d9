// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#define TETLIBRARY  // the library interface of the header
#include <tetgen.h>

#include <string>

#include "peer.hpp"
#include "timing.hpp"

namespace terratet::bench {

namespace {

/// The box as six facets: tetgenio owns and frees the arrays.
void fill(tetgenio& in, const Box3& box) {
    in.numberofpoints = 8;
    in.pointlist = new double[24];
    for (int i = 0; i < 8; ++i) {
        in.pointlist[3 * i] = (i & 1) != 0 ? box.hi.x : box.lo.x;
        in.pointlist[3 * i + 1] = (i & 2) != 0 ? box.hi.y : box.lo.y;
        in.pointlist[3 * i + 2] = (i & 4) != 0 ? box.hi.z : box.lo.z;
    }
    constexpr int faces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
    in.numberoffacets = 6;
    in.facetlist = new tetgenio::facet[6];
    for (int f = 0; f < 6; ++f) {
        tetgenio::facet& facet = in.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(facet.polygonlist);
        facet.polygonlist[0].numberofvertices = 4;
        facet.polygonlist[0].vertexlist = new int[4];
        std::copy(std::begin(faces[f]), std::end(faces[f]), facet.polygonlist[0].vertexlist);
    }
}

void fill(tetgenio& in, const std::vector<Vec3>& points) {
    in.numberofpoints = static_cast<int>(points.size());
    in.pointlist = new double[3 * points.size()];
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            in.pointlist[3 * i + static_cast<std::size_t>(axis)] = points[i][axis];
        }
    }
}

}  // namespace

MeshResult tetgen(const PointsInBox& task, double volume, double radius_edge, const char* more) {
    tetgenio in;
    tetgenio additional;
    tetgenio out;
    fill(in, task.box);
    fill(additional, task.points);
    std::string switches = "piQq" + std::to_string(radius_edge) + "a" + std::to_string(volume) + more;
    const double start = cpu_s();
    tetrahedralize(switches.data(), &in, &out, &additional);
    const double seconds = cpu_s() - start;
    return measured(seconds, static_cast<std::size_t>(out.numberofpoints),
                    static_cast<std::size_t>(out.numberoftetrahedra), [&](std::size_t c) {
                        CellPoints corners;
                        for (std::size_t k = 0; k < 4; ++k) {
                            const double* p = out.pointlist + 3 * out.tetrahedronlist[4 * c + k];
                            corners[k] = {p[0], p[1], p[2]};
                        }
                        return corners;
                    });
}

}  // namespace terratet::bench
