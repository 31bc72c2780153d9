// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/clip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "io/write/clipped_parts.hpp"
#include "tess/base/tetrahedron.hpp"

namespace terratet {
namespace {

using Tet = std::array<std::uint32_t, 4>;
enum class Fate : std::uint8_t { dropped, whole, cut };

/// One side of the extent; what is inside has a distance ≥ 0.
struct Plane {
    int axis;
    double position;
    double inwards;  ///< +1 or −1

    [[nodiscard]] double distance(const Vec3& p) const { return inwards * (p[axis] - position); }
};

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(cross(b - a, c - a), d - a);
}

class Clipper {
  public:
    Clipper(const ModelView& view, const Progress& progress) : view_(view), progress_(progress) {
        const Box3& extent = view.model.domain.extent;
        for (int axis = 0; axis < 3; ++axis) {
            planes_.push_back({axis, extent.lo[axis], 1});
            planes_.push_back({axis, extent.hi[axis], -1});
        }
        on_plane_ = 1e-12 * extent.diagonal();
        points_ = view.mesh.points;
    }

    ClippedMesh run(bool mended) {
        const std::size_t n = view_.mesh.cells.size();
        fate_.assign(n, Fate::dropped);
        first_piece_.resize(n);
        for (std::size_t c = 0; c < n; ++c) {
            clip(static_cast<std::uint32_t>(c));
        }
        keep_to_own_sides(view_, points_, result_.cuts);
        for (const std::uint32_t parent : result_.parent) {
            result_.changed.push_back(fate_[parent] == Fate::cut ? 1 : 0);
        }
        compact();
        find_facets();
        label_regions();
        if (mended && !result_.cuts.empty()) {
            mend();
        }
        return std::move(result_);
    }

  private:
    void clip(std::uint32_t cell) {
        pieces_.assign(1, view_.mesh.cells[cell]);
        bool touched = false;
        for (const Plane& plane : planes_) {
            next_.clear();
            for (const Tet& piece : pieces_) {
                touched |= cut(piece, plane);
            }
            std::swap(pieces_, next_);
        }
        if (pieces_.empty()) {
            return;
        }
        fate_[cell] = touched ? Fate::cut : Fate::whole;
        first_piece_[cell] = static_cast<std::uint32_t>(result_.cells.size());
        for (const Tet& piece : pieces_) {
            result_.cells.push_back(piece);
            result_.parent.push_back(cell);
        }
    }

    /// Appends to next_ what of the piece is inside; true unless all of it.
    bool cut(const Tet& piece, const Plane& plane) {
        std::array<std::uint32_t, 4> in;
        std::array<std::uint32_t, 4> on;
        std::array<std::uint32_t, 4> out;
        std::size_t n_in = 0;
        std::size_t n_on = 0;
        std::size_t n_out = 0;
        for (const std::uint32_t v : piece) {
            const double d = plane.distance(points_[v]);
            if (std::abs(d) <= on_plane_ && v >= view_.model.vertices.size()) {
                points_[v][plane.axis] = plane.position;  // a cut that met the box's edge
            }
            (std::abs(d) <= on_plane_ ? on[n_on++] : d > 0 ? in[n_in++] : out[n_out++]) = v;
        }
        if (n_in == 0) {
            return true;
        }
        if (n_out == 0) {
            next_.push_back(piece);
            return false;
        }
        const auto on_edge = [&](std::size_t i, std::size_t o) { return cut_point(in[i], out[o], plane); };
        // What is inside, on and outside in turn: turned when this order of the piece's corners is.
        Tet order{};
        std::copy_n(in.begin(), n_in, order.begin());
        std::copy_n(on.begin(), n_on, order.begin() + n_in);
        std::copy_n(out.begin(), n_out, order.begin() + n_in + n_on);
        const bool turned = is_odd_order(piece, order);
        if (n_in == 1) {
            Tet tip{in[0]};
            std::size_t corner = 1;
            for (std::size_t k = 0; k < n_on; ++k) {
                tip[corner++] = on[k];
            }
            for (std::size_t k = 0; k < n_out; ++k) {
                tip[corner++] = on_edge(0, k);
            }
            add(tip, turned);
        } else if (n_in == 2 && n_out == 2) {
            add_prism({in[0], on_edge(0, 0), on_edge(0, 1)}, {in[1], on_edge(1, 0), on_edge(1, 1)}, turned);
        } else if (n_in == 2) {
            add_pyramid(on[0], {in[0], in[1], on_edge(1, 0), on_edge(0, 0)}, turned);
        } else {
            add_prism({in[0], in[1], in[2]}, {on_edge(0, 0), on_edge(1, 0), on_edge(2, 0)}, turned);
        }
        return true;
    }

    /// The point where the edge meets the plane: the same one for every cell round the edge.
    std::uint32_t cut_point(std::uint32_t u, std::uint32_t v, const Plane& plane) {
        const auto [a, b] = before(v, u) ? std::pair(v, u) : std::pair(u, v);
        const auto [entry, fresh] = cut_of_edge_.try_emplace(std::uint64_t{a} << 32 | b, points_.size());
        if (fresh) {
            const double da = plane.distance(points_[a]);
            const double db = plane.distance(points_[b]);
            const double t = da / (da - db);
            Vec3 p = points_[a] + t * (points_[b] - points_[a]);
            p[plane.axis] = plane.position;
            points_.push_back(p);
            result_.cuts.push_back({a, b, t});
        }
        return static_cast<std::uint32_t>(entry->second);
    }

    /// The orientation follows from the piece's, not from a volume that may be no more than rounding.
    void add(Tet tet, bool turned) {
        if (turned) {
            std::swap(tet[2], tet[3]);
        }
        next_.push_back(tet);
    }

    /// An order of places that is the same on both sides of a collapsed fault.
    [[nodiscard]] bool before(std::uint32_t u, std::uint32_t v) const {
        return points_[u] != points_[v] ? points_[u] < points_[v] : u < v;
    }
    template <std::size_t n>
    [[nodiscard]] auto smallest(const std::array<std::uint32_t, n>& corners) const {
        return std::min_element(corners.begin(), corners.end(),
                                [this](std::uint32_t u, std::uint32_t v) { return before(u, v); });
    }

    /// Corners of the quadrilateral in order round it.
    void add_pyramid(std::uint32_t apex, const std::array<std::uint32_t, 4>& quad, bool turned) {
        const auto first = static_cast<std::size_t>(smallest(quad) - quad.begin());
        const auto q = [&](std::size_t k) { return quad[(first + k) % 4]; };
        add({apex, q(0), q(1), q(2)}, turned);
        add({apex, q(0), q(2), q(3)}, turned);
    }

    /// Edges lead from each corner of one triangle to the same one of the other.
    void add_prism(std::array<std::uint32_t, 3> a, std::array<std::uint32_t, 3> b, bool turned) {
        if (before(*smallest(b), *smallest(a))) {
            std::swap(a, b);
            turned = !turned;
        }
        const auto first = static_cast<std::size_t>(smallest(a) - a.begin());
        const std::size_t second = (first + 1) % 3;
        const std::size_t third = (first + 2) % 3;
        add({a[first], b[first], b[second], b[third]}, turned);
        add_pyramid(a[first], {a[second], a[third], b[third], b[second]}, turned);
    }

    [[nodiscard]] bool is_gap(std::size_t cell) const { return view_.cells.barrier[result_.parent[cell]] >= 0; }

    /// The whole cell beyond facet k of a whole cell; −1 if there is none there. A whole cell keeps the order of its
    /// corners, so its facet k is its parent's.
    [[nodiscard]] std::int64_t whole_beyond(std::size_t cell, std::size_t k) const {
        const std::uint32_t parent = result_.parent[cell];
        const std::int32_t neighbour = view_.mesh.neighbours[parent][k];
        const bool both =
            fate_[parent] == Fate::whole && neighbour >= 0 && fate_[static_cast<std::size_t>(neighbour)] == Fate::whole;
        return both ? std::int64_t{first_piece_[static_cast<std::size_t>(neighbour)]} : -1;
    }

    [[nodiscard]] bool on_extent(const Triangle& corners) const {
        return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
            return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
                return std::abs(plane.distance(result_.points[v])) <= on_plane_;
            });
        });
    }

    void mend() {
        mend_clipped(view_, result_, progress_);
        std::ranges::fill(fate_, Fate::dropped);
        for (std::size_t c = result_.cells.size(); c-- > 0;) {
            fate_[result_.parent[c]] = result_.changed[c] != 0 ? Fate::cut : Fate::whole;
            first_piece_[result_.parent[c]] = static_cast<std::uint32_t>(c);
        }
        result_.facets.clear();
        find_facets();
    }

    /// Between whole cells by the tessellation's own neighbours; of pieces, few of all, by sorting.
    void find_facets() {
        struct Side {
            Triangle key;
            ClippedMesh::Facet facet;
        };
        std::vector<Side> sides;
        for (std::uint32_t c = 0; c < result_.cells.size(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Tet& cell = result_.cells[c];
                const Triangle corners{cell[facet_corners[k][0]], cell[facet_corners[k][1]], cell[facet_corners[k][2]]};
                const std::int64_t beyond = whole_beyond(c, k);
                if (beyond < 0) {
                    Triangle key = corners;
                    std::sort(key.begin(), key.end());
                    sides.push_back({key, {corners, c, -1, on_extent(corners)}});
                } else if (beyond > c && is_gap(c) != is_gap(static_cast<std::size_t>(beyond))) {
                    result_.facets.push_back({corners, c, beyond, false});
                }
            }
        }
        std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
        for (std::size_t i = 0; i < sides.size(); ++i) {
            ClippedMesh::Facet facet = sides[i].facet;
            if (i + 1 < sides.size() && sides[i].key == sides[i + 1].key) {
                facet.beyond = sides[++i].facet.cell;
            }
            result_.facets.push_back(facet);
        }
    }

    /// Pieces keep their cell's region. Those of cells that have none, their centroids being outside, take that of the
    /// nearest pieces they hang together with; in gaps they have none.
    void label_regions() {
        const std::size_t n = result_.cells.size();
        std::vector<std::vector<std::uint32_t>> next_to(n);
        const auto join = [&](std::uint32_t a, std::int64_t b) {
            if (b >= 0) {
                next_to[a].push_back(static_cast<std::uint32_t>(b));
                next_to[static_cast<std::size_t>(b)].push_back(a);
            }
        };
        for (std::uint32_t c = 0; c < n; ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                join(c, whole_beyond(c, k));
            }
        }
        for (const ClippedMesh::Facet& facet : result_.facets) {
            join(facet.cell, facet.beyond);
        }
        result_.region.assign(n, -1);
        std::vector<std::uint32_t> reached;
        for (std::uint32_t c = 0; c < n; ++c) {
            result_.region[c] = is_gap(c) ? -1 : view_.cells.region[result_.parent[c]];
            if (result_.region[c] >= 0) {
                reached.push_back(c);
            }
        }
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (const std::uint32_t c : next_to[reached[i]]) {
                if (result_.region[c] < 0 && !is_gap(c)) {
                    result_.region[c] = result_.region[reached[i]];
                    reached.push_back(c);
                }
            }
        }
    }

    /// Leaves out the vertices outside and the cuts that later cuts took the place of.
    void compact() {
        result_.points = std::move(points_);
        result_.place.resize(result_.points.size());
        std::iota(result_.place.begin(), result_.place.end(), 0U);
        drop_unused_points(result_);
    }

    const ModelView& view_;
    const Progress& progress_;
    std::vector<Plane> planes_;
    double on_plane_ = 0;
    std::vector<Vec3> points_;
    std::unordered_map<std::uint64_t, std::size_t> cut_of_edge_;
    std::vector<Fate> fate_;                  ///< of each of the tessellation's cells
    std::vector<std::uint32_t> first_piece_;  ///< of each that is not dropped, in result_.cells
    std::vector<Tet> pieces_;
    std::vector<Tet> next_;
    ClippedMesh result_;
};

}  // namespace

std::vector<double> region_volumes(const ModelView& view) {
    const ClippedMesh mesh = clip_to_extent(view, ClippedCells::as_cut);
    std::vector<double> volumes(static_cast<std::size_t>(view.cells.region_count), 0);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (mesh.region[c] >= 0) {
            const auto& v = mesh.cells[c];
            volumes[static_cast<std::size_t>(mesh.region[c])] +=
                six_volumes(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) / 6;
        }
    }
    for (double& volume : volumes) {
        volume /= view.model.frame.z_scale;
    }
    return volumes;
}

ClippedMesh clip_to_extent(const ModelView& view, ClippedCells cells, const Progress& progress) {
    return Clipper(view, progress).run(cells == ClippedCells::mended);
}

}  // namespace terratet
