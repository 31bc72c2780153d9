// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/estimation_barriers.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tess/barrier/complex/margin.hpp"
#include "tess/barrier/query/rim_starts.hpp"
#include "tess/base/triangle_tree.hpp"

namespace terratet {
namespace {

constexpr std::size_t most_rows = 200;     ///< along a surface beyond the extent
constexpr double growth = 1.25;            ///< of the rows' distances
constexpr double longest_step = 1.0 / 64;  ///< over the reach
constexpr double hold = 0.5;               ///< of a step: a surface that far off the way is followed no more
constexpr double flat = 1e-3;              ///< over the spacing: rows as near to a straight way are left out
constexpr double far = 3;                  ///< over the diagonal of all: the last row

TriangleTree tree_of(const Surface& surface) {
    return {surface.vertices, surface.triangles};
}

bool bars(const Barrier& barrier, bool horizons) {
    return barrier.sheet.kind == SurfaceKind::fault || (horizons && barrier.sheet.kind == SurfaceKind::horizon);
}

/// A fault on its way.
struct Going {
    std::vector<EdgePlace> edges;  ///< of the rim that goes on, each in its triangle's sense
    std::set<std::size_t> hosts;   ///< faults on which it ends
    TriangleTree read;             ///< the surface as it was read
    TriangleTree margin;           ///< the sheet goes on in it for a little
    TriangleTree sheet;
    TriangleTree beyond;  ///< what was made, once done
    bool done = false;
};

class Continuation {
  public:
    Continuation(const Site& site, const Domain& domain, std::span<const Barrier> barriers, bool horizons)
        : site_(site), barriers_(barriers), extent_(domain.extent) {
        reach_ = bounding_box(site.samples.positions);
        if (!domain.hull.empty()) {
            reach_.extend(domain.hull.lo);
            reach_.extend(domain.hull.hi);
        }
        for (const Barrier& barrier : barriers) {
            bars_.push_back({bars(barrier, horizons), {}, {}});
            spacing_ = std::max(spacing_, barrier.spacing);
        }
        going_.resize(bars_.size());
        find_rims();
    }

    std::vector<EstimationBarrier> run() {
        prepare();
        for (std::size_t count = 0; count < going_.size(); ++count) {
            const std::size_t f = next();
            for (RimStart* start : starts_of(f)) {
                if (start->rows.empty()) {
                    march(*start, f);
                }
            }
            going_[f].beyond = tree_of(strips(f, all_rows()));
            going_[f].done = true;
        }
        const std::vector<std::size_t> rows = rows_that_count();
        for (std::size_t f = 0; f < going_.size(); ++f) {
            bars_[f].beyond = strips(f, rows);
            add_tips(f, rows);
        }
        return std::move(bars_);
    }

    [[nodiscard]] bool within() const { return within_; }

  private:
    void find_rims() {
        const EdgeUses uses = edge_uses(barriers_, [&](const Barrier& barrier) {
            return bars_[static_cast<std::size_t>(&barrier - barriers_.data())].bars;
        });
        const EdgeUses bounds =
            edge_uses(barriers_, [](const Barrier& barrier) { return is_bound(barrier.sheet.kind); });
        std::map<EdgePlace, std::vector<std::size_t>> inside;  // an edge between two triangles of a sheet: that sheet
        std::vector<std::vector<EdgePlace>> ends(bars_.size());
        for (std::size_t f = 0; f < bars_.size(); ++f) {
            if (!bars_[f].bars) {
                continue;
            }
            const Surface& sheet = barriers_[f].sheet;
            const TriMesh mesh{sheet.vertices, sheet.triangles};
            const std::vector<RimEdge> rim = rim_edges(mesh);
            const std::vector<Vec3> normals = rim_normals(mesh, rim);
            for (const RimEdge& e : rim) {
                const EdgePlace edge = sorted(mesh.points[e.from], mesh.points[e.to]);
                if (uses.at(edge) > 1) {
                    ends[f].push_back(edge);
                } else if (!goes_on(f, mesh, e, normals, bounds.contains(edge))) {
                    bars_[f].rims.push_back(edge);
                }
            }
            for (const auto& [edge, count] : edge_uses({&barriers_[f], 1}, [](const Barrier&) { return true; })) {
                if (count > 1 && uses.at(edge) > count) {
                    inside[edge].push_back(f);
                }
            }
        }
        for (std::size_t f = 0; f < ends.size(); ++f) {
            for (const EdgePlace& edge : ends[f]) {
                if (const auto found = inside.find(edge); found != inside.end()) {
                    going_[f].hosts.insert(found->second.begin(), found->second.end());
                }
            }
        }
    }

    /// Notes how the rim's edge goes on, if it does.
    bool goes_on(std::size_t f, const TriMesh& mesh, const RimEdge& e, const std::vector<Vec3>& normals,
                 bool at_bound) {
        const Vec3& a = mesh.points[e.from];
        const Vec3& b = mesh.points[e.to];
        const std::vector<Vec3> faces = extent_.empty() ? std::vector<Vec3>{} : faces_with(extent_, a, b);
        if (faces.empty() && !at_bound) {
            return false;
        }
        within_ = within_ || faces.empty();
        going_[f].edges.push_back({a, b});
        for (const std::uint32_t v : {e.from, e.to}) {
            const Vec3& normal = normals[v];
            Vec3 way;
            for (const Vec3& face : faces) {
                const Vec3 heading = face - dot(face, normal) * normal;
                way = way + (length(heading) > 0.05 ? unit(heading) : Vec3{});
            }
            if (way == Vec3{}) {
                way = unit(cross(b - a, normal));
            }
            RimStart& start = starts_.try_emplace(mesh.points[v], RimStart{mesh.points[v], {}, {}, {}}).first->second;
            RimStart::Use& use = start.use(f);
            use.normal = normal;
            use.way = use.way + length(b - a) * way;
            ++use.edges;
        }
        return true;
    }

    void prepare() {
        for (std::size_t f = 0; f < going_.size(); ++f) {
            if (going_[f].edges.empty()) {
                continue;
            }
            const Barrier& barrier = barriers_[f];
            Surface read;
            for (const Surface& surface : site_.surfaces) {
                if (surface.name == barrier.name && surface.kind == barrier.sheet.kind) {
                    const auto first = static_cast<std::uint32_t>(read.vertices.size());
                    read.vertices.insert(read.vertices.end(), surface.vertices.begin(), surface.vertices.end());
                    for (const Triangle& t : surface.triangles) {
                        read.triangles.push_back({first + t[0], first + t[1], first + t[2]});
                    }
                }
            }
            going_[f].read = tree_of(read);
            going_[f].margin = tree_of(barrier.margin);
            going_[f].sheet = tree_of(barrier.sheet);
        }
    }

    /// The first of the faults left whose hosts are all done; where they end on each other, the first.
    [[nodiscard]] std::size_t next() const {
        std::size_t first = going_.size();
        for (std::size_t f = 0; f < going_.size(); ++f) {
            if (going_[f].done) {
                continue;
            }
            first = std::min(first, f);
            if (std::ranges::all_of(going_[f].hosts, [&](std::size_t host) { return going_[host].done; })) {
                return f;
            }
        }
        return first;
    }

    std::vector<RimStart*> starts_of(std::size_t f) {
        std::vector<RimStart*> starts;
        for (auto& [position, start] : starts_) {
            if (start.is_of(f)) {
                starts.push_back(&start);
            }
        }
        return starts;
    }

    void march(RimStart& start, std::size_t f) {
        Vec3 way = start.way();
        Vec3 p = start.position;
        start.rows = {p};
        double step = spacing_ / 2;  // within the margin
        int lost = 0;
        while (start.rows.size() <= most_rows && lost < 3) {
            const std::size_t row = start.rows.size();
            Vec3 q = p + step * way;
            const bool held = hold_on(start, row <= 2, q, step) && !extent_.contains(q);
            if (!held) {
                if (lost == 0) {
                    way = row > 1 ? unit(p - start.rows[row - std::min<std::size_t>(row, 4)]) : way;
                }
                q = p + step * way;
            }
            lost = held ? 0 : lost + 1;
            if (stopped(start, f, held, p, q)) {
                start.rows.push_back(q);
                start.last = q;
                return;
            }
            way = held ? unit(q - p) : way;
            p = q;
            start.rows.push_back(p);
            if (row > 2 && !reach_.contains(p)) {
                break;
            }
            step = row < 2 ? step
                           : std::min(growth * std::max(step, spacing_ / growth),
                                      std::max(spacing_, longest_step * reach_.diagonal()));
        }
        start.last = p + far * reach_.diagonal() * way;
        stopped(start, f, false, p, start.last);
    }

    /// Moves a place onto the surfaces that it belongs to, where they are near.
    bool hold_on(const RimStart& start, bool in_margin, Vec3& place, double step) const {
        bool held = false;
        Vec3 at = place;
        for (int round = 0; round < (start.uses.size() > 1 ? 4 : 1); ++round) {
            for (const RimStart::Use& use : start.uses) {
                const Going& going = going_[use.barrier];
                const auto foot = (in_margin ? going.margin : going.read).nearest_to(at);
                if (foot && distance(*foot, place) <= hold * step) {
                    at = *foot;
                    held = true;
                }
            }
        }
        place = at;
        return held;
    }

    /// Ends a step at the first barrier of another fault that it may not cross.
    bool stopped(const RimStart& start, std::size_t f, bool held, const Vec3& p, Vec3& q) const {
        bool any = false;
        for (std::size_t g = 0; g < going_.size(); ++g) {
            const Going& other = going_[g];
            if (!other.done || start.is_of(g) || (held && !going_[f].hosts.contains(g))) {
                continue;
            }
            const auto meets = [&](const Vec3& end) { return other.sheet.meets(p, end) || other.beyond.meets(p, end); };
            if (!meets(q) || meets(p)) {
                continue;
            }
            double free = 0;
            double met = 1;
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = 0.5 * (free + met);
                (meets(p + middle * (q - p)) ? met : free) = middle;
            }
            q = p + met * (q - p);
            any = true;
        }
        return any;
    }

    [[nodiscard]] static const Vec3& row_of(const RimStart& start, std::size_t row, bool last) {
        return last ? start.last : start.rows[std::min(row, start.rows.size() - 1)];
    }

    [[nodiscard]] std::size_t row_count() const {
        std::size_t count = 1;
        for (const auto& [position, start] : starts_) {
            count = std::max(count, start.rows.size());
        }
        return count;
    }

    [[nodiscard]] std::vector<std::size_t> all_rows() const {
        std::vector<std::size_t> rows(row_count());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i] = i;
        }
        return rows;
    }

    /// All but those between whose neighbours every way is straight: the same ones of all faults, which share ways.
    [[nodiscard]] std::vector<std::size_t> rows_that_count() const {
        const std::size_t count = row_count();
        const auto straight = [&](const RimStart& start, std::size_t from, std::size_t to) {
            const Vec3 a = row_of(start, from, false);
            const Vec3 ab = row_of(start, to, to == count) - a;
            for (std::size_t row = from + 1; row < to; ++row) {
                const Vec3 ap = row_of(start, row, false) - a;
                const double share = squared_length(ab) > 0 ? std::clamp(dot(ap, ab) / dot(ab, ab), 0.0, 1.0) : 0;
                if (length(ap - share * ab) > flat * spacing_) {
                    return false;
                }
            }
            return true;
        };
        std::vector<std::size_t> rows{0};
        for (std::size_t to = 2; to <= count; ++to) {
            if (!std::ranges::all_of(starts_,
                                     [&](const auto& entry) { return straight(entry.second, rows.back(), to); })) {
                rows.push_back(to - 1);
            }
        }
        return rows;
    }

    /// The strips between the ways from the ends of each edge, by way of the given rows to the last.
    [[nodiscard]] Surface strips(std::size_t f, const std::vector<std::size_t>& rows) const {
        Surface surface{barriers_[f].name, barriers_[f].sheet.kind, {}, {}, {}};
        std::map<Vec3, std::uint32_t> number;
        const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
            if (a == b || b == c || c == a) {
                return;
            }
            Triangle& t = surface.triangles.emplace_back();
            for (std::size_t k = 0; const Vec3* p : {&a, &b, &c}) {
                const auto [entry, fresh] = number.try_emplace(*p, static_cast<std::uint32_t>(surface.vertices.size()));
                if (fresh) {
                    surface.vertices.push_back(*p);
                }
                t[k++] = entry->second;
            }
        };
        for (const auto& [from, to] : going_[f].edges) {
            const RimStart& start = starts_.at(from);
            const RimStart& other = starts_.at(to);
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const bool last = i + 1 == rows.size();
                const Vec3& a = row_of(start, rows[i], false);
                const Vec3& b = row_of(other, rows[i], false);
                const Vec3& beyond_a = row_of(start, last ? 0 : rows[i + 1], last);
                const Vec3& beyond_b = row_of(other, last ? 0 : rows[i + 1], last);
                add(b, a, beyond_a);
                add(b, beyond_a, beyond_b);
            }
        }
        return surface;
    }

    /// Where a fault's end meets the face it goes on as well.
    void add_tips(std::size_t f, const std::vector<std::size_t>& rows) {
        for (const RimStart* start : starts_of(f)) {
            if (start->uses.size() > 1 || start->uses[0].edges != 1) {
                continue;
            }
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const bool last = i + 1 == rows.size();
                bars_[f].rims.push_back(
                    sorted(row_of(*start, rows[i], false), row_of(*start, last ? 0 : rows[i + 1], last)));
            }
        }
    }

    const Site& site_;
    std::span<const Barrier> barriers_;
    Box3 extent_;
    Box3 reach_;
    double spacing_ = 0;
    std::vector<EstimationBarrier> bars_;
    std::vector<Going> going_;
    std::map<Vec3, RimStart> starts_;
    bool within_ = false;  ///< something goes on within the extent
};

}  // namespace

EstimationBarriers sheets_as_barriers(std::span<const Barrier> barriers) {
    const EdgeUses uses = edge_uses(barriers, [](const Barrier& barrier) { return bars(barrier, false); });
    EstimationBarriers made;
    for (const Barrier& barrier : barriers) {
        EstimationBarrier& bar = made.soft.emplace_back(EstimationBarrier{bars(barrier, false), {}, {}});
        for (const Triangle& t : bar.bars ? barrier.sheet.triangles : std::vector<Triangle>{}) {
            for (std::size_t i = 0; i < 3; ++i) {
                const EdgePlace edge = sorted(barrier.sheet.vertices[t[i]], barrier.sheet.vertices[t[(i + 1) % 3]]);
                if (uses.at(edge) == 1) {
                    bar.rims.push_back(edge);
                }
            }
        }
    }
    return made;
}

EstimationBarriers estimation_barriers(const Site& site, const Domain& domain, std::span<const Barrier> barriers) {
    EstimationBarriers made;
    Continuation soft(site, domain, barriers, false);
    const bool within = soft.within();
    made.soft = soft.run();
    made.covered = within ? Box3{} : domain.extent;
    for (const Property& property : site.properties) {
        made.hard_for.push_back(property.hard_horizons);
    }
    const bool horizons = std::ranges::any_of(
        barriers, [](const Barrier& barrier) { return barrier.sheet.kind == SurfaceKind::horizon; });
    if (horizons && std::ranges::any_of(site.properties, &Property::hard_horizons)) {
        Continuation hard(site, domain, barriers, true);
        made.covered = hard.within() ? Box3{} : made.covered;
        made.hard = hard.run();
    } else {
        made.hard_for.clear();
    }
    return made;
}

}  // namespace terratet
