// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/voronoi/clip_complex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "tess/base/no_index.hpp"
#include "tess/base/poll.hpp"

namespace terratet {
namespace {

/// Relative to the box's diagonal.
constexpr double on_plane = 1e-12;

/// An edge on the plane, as the wall that a cell gets there passes it.
struct CutEdge {
    std::uint32_t cell, from, to;
    friend auto operator<=>(const CutEdge&, const CutEdge&) = default;
};

/// Cuts at one side of the box.
class PlaneCut {
  public:
    PlaneCut(VoronoiComplex complex, int axis, double position, double outwards, double tolerance)
        : old_(std::move(complex)), axis_(axis), position_(position) {
        out_.resize(old_.points.size());
        for (std::size_t i = 0; i < out_.size(); ++i) {
            out_[i] = outwards * (old_.points[i][axis] - position);
            if (std::abs(out_[i]) <= tolerance) {
                out_[i] = 0;
                old_.points[i][axis] = position;
            }
        }
    }

    VoronoiComplex run(std::int32_t side, const Poll& poll) {
        PatientPoll patient(poll);
        new_.walls.reserve(old_.walls.size());
        new_.corners.reserve(old_.corners.size());
        for (const VoronoiWall& wall : old_.walls) {
            cut(wall);
            patient();
        }
        close(side);
        new_.points = std::move(old_.points);
        return std::move(new_);
    }

  private:
    void cut(const VoronoiWall& wall) {
        const auto polygon = old_.polygon(wall);
        const auto [least, most] = std::ranges::minmax(polygon, {}, [&](std::uint32_t i) { return out_[i]; });
        if (!(out_[least] < 0)) {
            return;
        }
        if (out_[most] < 0) {
            new_.add(polygon, wall.cell, wall.beyond);
            return;
        }
        kept_.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::uint32_t a = polygon[i];
            const std::uint32_t b = polygon[(i + 1) % polygon.size()];
            if (out_[a] <= 0) {
                kept_.push_back(a);
            }
            if ((out_[a] < 0 && out_[b] > 0) || (out_[a] > 0 && out_[b] < 0)) {
                kept_.push_back(out_[a] < 0 ? cut_point(a, b) : cut_point(b, a));
            }
        }
        if (kept_.size() < 3) {
            return;
        }
        new_.add(kept_, wall.cell, wall.beyond);
        for (std::size_t i = 0; i < kept_.size(); ++i) {
            const std::uint32_t a = kept_[i];
            const std::uint32_t b = kept_[(i + 1) % kept_.size()];
            if (out_[a] == 0 && out_[b] == 0) {
                edges_.push_back({wall.cell, b, a});
                if (wall.beyond >= 0) {
                    edges_.push_back({static_cast<std::uint32_t>(wall.beyond), a, b});
                }
            }
        }
    }

    std::uint32_t cut_point(std::uint32_t in, std::uint32_t out) {
        const auto [entry, fresh] =
            cut_of_edge_.try_emplace(std::uint64_t{in} << 32 | out, static_cast<std::uint32_t>(old_.points.size()));
        if (fresh) {
            const double t = out_[in] / (out_[in] - out_[out]);
            Vec3 p = old_.points[in] + t * (old_.points[out] - old_.points[in]);
            p[axis_] = position_;
            old_.points.push_back(p);
            out_.push_back(0);
        }
        return entry->second;
    }

    /// The walls on the plane: what its cells' other walls leave open there.
    void close(std::int32_t side) {
        std::ranges::sort(edges_);
        for (std::size_t first = 0; first < edges_.size();) {
            std::size_t end = first;
            while (end < edges_.size() && edges_[end].cell == edges_[first].cell) {
                ++end;
            }
            add_loops({edges_.begin() + static_cast<std::ptrdiff_t>(first), end - first}, side);
            first = end;
        }
    }

    void add_loops(std::span<const CutEdge> edges, std::int32_t side) {
        std::vector<char> used(edges.size(), 0);
        for (std::size_t i = 0; i < edges.size(); ++i) {  // two walls that touch the plane in one edge leave none open
            const CutEdge twin{edges[i].cell, edges[i].to, edges[i].from};
            used[i] = std::ranges::binary_search(edges, twin) ? 1 : 0;
        }
        for (std::size_t first = 0; first < edges.size(); ++first) {
            kept_.clear();
            for (std::size_t at = first; at < edges.size() && used[at] == 0;) {
                used[at] = 1;
                kept_.push_back(edges[at].from);
                const CutEdge least{edges[at].cell, edges[at].to, 0};
                at = static_cast<std::size_t>(std::ranges::lower_bound(edges, least) - edges.begin());
                while (at < edges.size() && edges[at].from == least.from && used[at] != 0) {
                    ++at;
                }
                if (at < edges.size() && edges[at].from != least.from) {
                    break;
                }
            }
            if (kept_.size() > 2) {
                new_.add(kept_, edges[first].cell, side);
            }
        }
    }

    VoronoiComplex old_;
    int axis_;
    double position_;
    VoronoiComplex new_;
    std::vector<double> out_;  ///< how far each point is beyond the plane
    std::vector<std::uint32_t> kept_;
    std::vector<CutEdge> edges_;
    std::unordered_map<std::uint64_t, std::uint32_t> cut_of_edge_;
};

}  // namespace

VoronoiComplex clipped_to(VoronoiComplex complex, const Box3& box, const Poll& poll) {
    const double tolerance = on_plane * box.diagonal();
    for (int axis = 0; axis < 3; ++axis) {
        for (int end = 0; end < 2; ++end) {
            const double position = end == 0 ? box.lo[axis] : box.hi[axis];
            PlaneCut cut(std::move(complex), axis, position, end == 0 ? -1 : 1, tolerance);
            complex = cut.run(-1 - (2 * axis + end), poll);
        }
    }
    drop_unused_points(complex);
    return complex;
}

void drop_unused_points(VoronoiComplex& complex) {
    std::vector<std::uint32_t> place(complex.points.size(), no_index);
    for (const VoronoiWall& wall : complex.walls) {
        for (const std::uint32_t corner : complex.polygon(wall)) {
            place[corner] = 0;
        }
    }
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] != no_index) {
            complex.points[count] = complex.points[i];
            place[i] = count++;
        }
    }
    complex.points.resize(count);
    for (std::uint32_t& corner : complex.corners) {
        corner = place[corner];
    }
}

}  // namespace terratet
