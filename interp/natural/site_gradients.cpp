// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/site_gradients.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "interp/base/stamped.hpp"
#include "interp/sites/stars.hpp"

namespace terratet {
namespace {

constexpr double amplification_max = 30;  // of differences of values, over the typical distance of neighbours

constexpr double rounding = 1e-12;  // of the sum of all squares: less is none

/// The fifth smallest: what a few neighbours at nearly the same place, or in the same hole, do not change.
double typical_distance(std::vector<double> distances) {
    const auto fifth = distances.begin() + std::min<std::ptrdiff_t>(4, std::ssize(distances) - 1);
    std::nth_element(distances.begin(), fifth, distances.end());
    return *fifth;
}

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

struct Sighted {
    std::int32_t vertex;
    Eigen::Vector3d offset;
    double seen;
    double weight;
};

/// Least squares of slopes, only along axes on which differences of values do not count too much.
class Fit {
  public:
    /// \param along  projects offsets onto the axes to look at
    template <typename Weight>
    Fit(const std::vector<Sighted>& neighbours, const Weight& weight_of, const Eigen::Matrix3d& along, double typical) {
        for (const Sighted& n : neighbours) {
            const Eigen::Vector3d offset = along * n.offset;
            spread += weight_of(n) * n.offset * n.offset.transpose();
            projected += weight_of(n) * offset * offset.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(projected);
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d axis = axes.eigenvectors().col(i);
            const double extent = axes.eigenvalues()[i];
            double amplified = 0;
            for (const Sighted& n : neighbours) {
                amplified += std::abs(weight_of(n) * axis.dot(along * n.offset));
            }
            if (extent > rounding * spread.trace() && amplified * typical <= amplification_max * extent) {
                inverse += axis * axis.transpose() / extent;
                determined += axis * axis.transpose();
            }
        }
    }

    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();      ///< Σ w d dᵀ
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();     ///< its inverse on the axes that are determined
    Eigen::Matrix3d determined = Eigen::Matrix3d::Zero();  ///< projects onto those

  private:
    Eigen::Matrix3d projected = Eigen::Matrix3d::Zero();
};

/// First with Sibson's weights; what of the slope these leave undetermined, then, from what remains, with weights 1/d,
/// by which neighbours farther away have more say. Any weights reproduce linear fields.
void fit(const SiteMesh& sites, std::int32_t site, const std::vector<Neighbour>& neighbours,
         std::vector<SiteGradients::Term>& out) {
    const auto points = sites.tessellation().points();
    const Vec3 p = points[static_cast<std::size_t>(site)];
    std::vector<Sighted> sighted;
    std::vector<double> distances;
    for (const auto& [vertex, lambda] : neighbours) {
        if (!(lambda > 0) || sites.tessellation().is_ghost(vertex)) {
            continue;
        }
        const double seen = sites.openness(sites.place(site), vertex);
        if (seen > 0) {
            const Vec3 d = points[static_cast<std::size_t>(vertex)] - p;
            sighted.push_back({vertex, {d.x, d.y, d.z}, seen, seen * lambda / dot(d, d)});
            distances.push_back(length(d));
        }
    }
    if (sighted.empty()) {
        return;
    }
    const double typical = typical_distance(std::move(distances));
    const auto sibson = [](const Sighted& n) { return n.weight; };
    const auto even = [](const Sighted& n) { return n.seen / n.offset.norm(); };
    const Fit near(sighted, sibson, Eigen::Matrix3d::Identity(), typical);
    const Fit far(sighted, even, Eigen::Matrix3d::Identity() - near.determined, typical);
    const Eigen::Matrix3d remains = Eigen::Matrix3d::Identity() - far.inverse * far.spread;
    for (const Sighted& n : sighted) {
        const Eigen::Vector3d g =
            remains * (near.inverse * (sibson(n) * n.offset)) + far.inverse * (even(n) * n.offset);
        out.push_back({n.vertex, {g.x(), g.y(), g.z()}});
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
