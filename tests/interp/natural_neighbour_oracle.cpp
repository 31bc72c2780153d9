// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "natural_neighbour_oracle.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/natural_neighbor_coordinates_3.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "interp/natural/exact_volumes.hpp"
#include "interp/base/morton.hpp"

namespace terratet::testing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>,
                                                 CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Number = CGAL::Exact_rational;
using Rational = CGAL::Simple_cartesian<Number>;

constexpr std::int32_t far_site = -1;

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}
Rational::Point_3 rational(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

Delaunay delaunay_of(const std::vector<Vec3>& sites) {
    std::vector<std::pair<Kernel::Point_3, std::int32_t>> numbered;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        numbered.emplace_back(point(sites[i]), static_cast<std::int32_t>(i));
    }
    return Delaunay(numbered.begin(), numbered.end());
}

/// Six times the volume of v's cell: pyramids from v over the fan of each of its faces.
Number cell_volume(const Delaunay& delaunay, Delaunay::Vertex_handle v) {
    const auto center = [&](Delaunay::Cell_handle cell) {
        const auto p = [&](int k) { return rational(cell->vertex(k)->point()); };
        return CGAL::circumcenter(p(0), p(1), p(2), p(3));
    };
    const auto apex = rational(v->point());
    std::vector<Delaunay::Edge> edges;
    delaunay.finite_incident_edges(v, std::back_inserter(edges));
    Number volume = 0;
    for (const auto& edge : edges) {
        std::vector<Rational::Point_3> face;
        auto cell = delaunay.incident_cells(edge);
        const auto first = cell;
        do {
            face.push_back(center(cell));
        } while (++cell != first);
        for (std::size_t i = 2; i < face.size(); ++i) {
            volume += CGAL::abs(CGAL::determinant(face[0] - apex, face[i - 1] - apex, face[i] - apex));
        }
    }
    return volume;
}

/// \param coordinates  of a place: (Delaunay, place, output iterator, norm)
template <typename Coordinates>
std::vector<SiteWeights> cgal_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places,
                                      Coordinates coordinates) {
    const Delaunay delaunay = delaunay_of(sites);
    std::vector<SiteWeights> out;
    for (const Vec3& q : places) {
        std::vector<std::pair<Delaunay::Vertex_handle, double>> found;
        double norm = 0;
        coordinates(delaunay, q, std::back_inserter(found), norm);
        SiteWeights& weights = out.emplace_back();
        for (const auto& [vertex, coordinate] : found) {
            weights.push_back({static_cast<std::uint32_t>(vertex->info()), coordinate / norm});
        }
    }
    return out;
}

}  // namespace

std::vector<SiteWeights> cgal_sibson_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places) {
    return cgal_weights(sites, places, [](const Delaunay& delaunay, const Vec3& q, auto out, double& norm) {
        CGAL::sibson_natural_neighbor_coordinates_3(delaunay, point(q), out, norm);
    });
}

std::vector<SiteWeights> cgal_laplace_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places) {
    return cgal_weights(sites, places, [](const Delaunay& delaunay, const Vec3& q, auto out, double& norm) {
        CGAL::laplace_natural_neighbor_coordinates_3(delaunay, point(q), out, norm);
    });
}

std::vector<SiteWeights> cgal_linear_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places) {
    const Delaunay delaunay = delaunay_of(sites);
    std::vector<SiteWeights> out;
    for (const Vec3& q : places) {
        const auto cell = delaunay.locate(point(q));
        const auto volume_with = [&](int k) {  // q in place of vertex k
            const auto p = [&](int i) { return rational(i == k ? point(q) : cell->vertex(i)->point()); };
            return Number(CGAL::volume(p(0), p(1), p(2), p(3)));
        };
        const Number whole = volume_with(4);
        SiteWeights& weights = out.emplace_back();
        for (int k = 0; k < 4; ++k) {
            weights.push_back(
                {static_cast<std::uint32_t>(cell->vertex(k)->info()), CGAL::to_double(Number(volume_with(k) / whole))});
        }
    }
    return out;
}

struct ExactVoronoi::Impl {
    Delaunay delaunay;
};

ExactVoronoi::ExactVoronoi(const std::vector<Vec3>& sites) : impl_(std::make_unique<Impl>(Impl{delaunay_of(sites)})) {
    const Box3 box = bounding_box(sites).grown(20 * bounding_box(sites).diagonal());
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1 ? box.hi : box.lo).x, (corner & 2 ? box.hi : box.lo).y,
                     (corner & 4 ? box.hi : box.lo).z};
        impl_->delaunay.insert(point(p))->info() = far_site;
    }
}

ExactVoronoi::~ExactVoronoi() = default;

SiteWeights ExactVoronoi::sibson_weights(const Vec3& q) const {
    Delaunay after = impl_->delaunay;
    const auto inserted = after.insert(point(q));
    std::vector<Delaunay::Vertex_handle> neighbours;
    after.finite_adjacent_vertices(inserted, std::back_inserter(neighbours));
    const Number gained = cell_volume(after, inserted);
    SiteWeights weights;
    for (const auto& neighbour : neighbours) {
        if (neighbour->info() == far_site) {
            continue;
        }
        Delaunay::Vertex_handle before;
        impl_->delaunay.is_vertex(neighbour->point(), before);
        const Number lost = cell_volume(impl_->delaunay, before) - cell_volume(after, neighbour);
        weights.push_back({static_cast<std::uint32_t>(neighbour->info()), CGAL::to_double(Number(lost / gained))});
    }
    return weights;
}

SiteWeights fallback_weights(const std::vector<Vec3>& sites, const Vec3& q, Fallback which) {
    const auto order = morton_order(sites);
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : order) {
        sorted.push_back(sites[i]);
    }
    const CompactDelaunay mesh(sorted);
    Cavity cavity;
    cavity.find(mesh, q, mesh.locate(q, mesh.start_near(q)));
    std::vector<double> shares;
    constexpr auto sibson = Weighting::sibson;
    const auto way = which == Fallback::long_doubles ? long_shares
                     : which == Fallback::wide       ? wide_shares
                                                     : precise_shares;
    if (!way(mesh, cavity, q, sibson, shares)) {
        return {};
    }
    SiteWeights weights;
    for (std::size_t v = 0; v < shares.size(); ++v) {
        if (!mesh.is_ghost(cavity.vertices[v])) {
            weights.push_back({order[static_cast<std::size_t>(cavity.vertices[v])], shares[v]});
        }
    }
    return weights;
}

double largest_difference(const SiteWeights& a, const SiteWeights& b) {
    std::map<std::uint32_t, double> difference;
    for (const auto& [site, weight] : a) {
        difference[site] += weight;
    }
    for (const auto& [site, weight] : b) {
        difference[site] -= weight;
    }
    double largest = 0;
    for (const auto& [site, d] : difference) {
        largest = std::max(largest, std::abs(d));
    }
    return largest;
}

}  // namespace terratet::testing
