// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/site_gradients.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "interp/stamped.hpp"

namespace terratet {
namespace {

constexpr double flat = 1e-6;  // directions with less than this part of the largest spread have no slope

/// For each vertex its cells, ascending.
struct Stars {
    std::vector<std::size_t> begin;
    std::vector<std::int32_t> cells;

    explicit Stars(const CompactDelaunay& mesh) : begin(mesh.points().size() + 1, 0), cells(4 * mesh.cells().size()) {
        for (const auto& cell : mesh.cells()) {
            for (const std::int32_t v : cell.vertex) {
                ++begin[static_cast<std::size_t>(v) + 1];
            }
        }
        for (std::size_t v = 1; v < begin.size(); ++v) {
            begin[v] += begin[v - 1];
        }
        std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t i = 0; i < mesh.cells().size(); ++i) {
            for (const std::int32_t v : mesh.cells()[i].vertex) {
                cells[next[static_cast<std::size_t>(v)]++] = static_cast<std::int32_t>(i);
            }
        }
    }
    [[nodiscard]] std::span<const std::int32_t> of(std::int32_t v) const {
        const auto i = static_cast<std::size_t>(v);
        return std::span(cells).subspan(begin[i], begin[i + 1] - begin[i]);
    }
};

struct Neighbour {
    std::int32_t vertex;
    double area_over_distance;
};

/// A site's neighbours with λ: each cell of its star adds, for each of its edges, the triangles from the edge's dual
/// axis to the cell's centre and the splits of the two facets at the edge (cell_parts divides volumes alike).
void find_neighbours(const CompactDelaunay& mesh, std::int32_t site, std::span<const std::int32_t> star,
                     StampedMap& number, std::vector<Neighbour>& out) {
    out.clear();
    number.clear(mesh.points().size());
    const Vec3 p = mesh.points()[static_cast<std::size_t>(site)];
    const auto add = [&](std::int32_t vertex, double amount) {
        if (!number.contains(vertex)) {
            number.insert(vertex, static_cast<std::int32_t>(out.size()));
            out.push_back({vertex, 0});
        }
        out[static_cast<std::size_t>(number[vertex])].area_over_distance += amount;
    };
    for (const std::int32_t id : star) {
        const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
        for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t i = 0; i < 3; ++i) {
                const auto corner = [&](std::size_t j) {
                    return cell.vertex[static_cast<std::size_t>(facet_corners[k][(i + j) % 3])];
                };
                if (corner(0) != site) {
                    continue;
                }
                const Vec3 split = mesh.cells()[static_cast<std::size_t>(mesh.split(id, k))].center;
                const Vec3 x = 0.5 * cross(cell.center - p, split - p);
                const Vec3 b = mesh.points()[static_cast<std::size_t>(corner(1))] - p;
                const Vec3 c = mesh.points()[static_cast<std::size_t>(corner(2))] - p;
                add(corner(1), dot(x, b) / dot(b, b));
                add(corner(2), -dot(x, c) / dot(c, c));
            }
        }
    }
}

void fit(const SiteMesh& sites, std::int32_t site, const std::vector<Neighbour>& neighbours,
         std::vector<SiteGradients::Term>& out) {
    const auto points = sites.tessellation().points();
    const Vec3 p = points[static_cast<std::size_t>(site)];
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    std::vector<std::pair<std::int32_t, Eigen::Vector3d>> weighted;
    for (const auto& [vertex, lambda] : neighbours) {
        if (!(lambda > 0) || sites.tessellation().is_ghost(vertex)) {
            continue;
        }
        const double seen = sites.openness(sites.place(site), vertex);
        if (seen > 0) {
            const Vec3 d = points[static_cast<std::size_t>(vertex)] - p;
            const Eigen::Vector3d v(d.x, d.y, d.z);
            weighted.emplace_back(vertex, seen * lambda / v.squaredNorm() * v);
            spread += weighted.back().second * v.transpose();
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    const double largest = axes.eigenvalues()[2];
    if (!(largest > 0)) {
        return;
    }
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
        if (axes.eigenvalues()[i] > flat * largest) {
            inverse += axes.eigenvectors().col(i) * axes.eigenvectors().col(i).transpose() / axes.eigenvalues()[i];
        }
    }
    for (const auto& [vertex, v] : weighted) {
        const Eigen::Vector3d g = inverse * v;
        out.push_back({vertex, {g.x(), g.y(), g.z()}});
    }
}

}  // namespace

SiteGradients::SiteGradients(const SiteMesh& sites) {
    const CompactDelaunay& mesh = sites.tessellation();
    const Stars stars(mesh);
    std::vector<std::vector<Term>> of_site(static_cast<std::size_t>(mesh.site_count()));
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, of_site.size(), 64), [&](const auto& range) {
        thread_local StampedMap number;
        thread_local std::vector<Neighbour> neighbours;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto site = static_cast<std::int32_t>(i);
            find_neighbours(mesh, site, stars.of(site), number, neighbours);
            fit(sites, site, neighbours, of_site[i]);
        }
    });
    begin_.assign(of_site.size() + 1, 0);
    for (std::size_t i = 0; i < of_site.size(); ++i) {
        begin_[i + 1] = begin_[i] + of_site[i].size();
    }
    terms_.reserve(begin_.back());
    for (const auto& terms : of_site) {
        terms_.insert(terms_.end(), terms.begin(), terms.end());
    }
}

std::size_t SiteGradients::memory_bytes() const {
    return terms_.capacity() * sizeof(Term) + begin_.capacity() * sizeof(std::size_t);
}

}  // namespace terratet
