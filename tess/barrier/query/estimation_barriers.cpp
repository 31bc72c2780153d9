// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/estimation_barriers.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tess/barrier/complex/margin.hpp"
#include "tess/base/triangle_tree.hpp"

namespace terratet {
namespace {

constexpr std::size_t most_rows = 200;     ///< along a surface beyond the extent
constexpr double growth = 1.25;            ///< of the rows' distances
constexpr double longest_step = 1.0 / 64;  ///< over the reach
constexpr double hold = 0.5;               ///< of a step: a surface that far off the way is followed no more
constexpr double flat = 1e-3;              ///< over the spacing: rows as near to a straight way are left out
constexpr double far = 3;                  ///< over the diagonal of all: the last row

EdgePlace sorted(const Vec3& a, const Vec3& b) {
    return a < b ? EdgePlace{a, b} : EdgePlace{b, a};
}

/// Of the sheets that are asked for, how many triangles an edge has.
using EdgeUses = std::map<EdgePlace, int>;
template <class Which>
EdgeUses edge_uses(std::span<const Fault> faults, const Which& which) {
    EdgeUses uses;
    for (const Fault& fault : faults) {
        for (const Triangle& t : which(fault) ? fault.sheet.triangles : std::vector<Triangle>{}) {
            for (std::size_t i = 0; i < 3; ++i) {
                ++uses[sorted(fault.sheet.vertices[t[i]], fault.sheet.vertices[t[(i + 1) % 3]])];
            }
        }
    }
    return uses;
}

bool bars(const Fault& fault, bool horizons) {
    return fault.sheet.kind == SurfaceKind::fault || (horizons && fault.sheet.kind == SurfaceKind::horizon);
}

/// The outward directions of the box's faces that hold both.
std::vector<Vec3> faces_with(const Box3& box, const Vec3& a, const Vec3& b) {
    std::vector<Vec3> faces;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            const double at = sign < 0 ? box.lo[axis] : box.hi[axis];
            const double tolerance = 1e-9 * (std::abs(at) + box.size()[axis]);
            if (std::abs(a[axis] - at) <= tolerance && std::abs(b[axis] - at) <= tolerance) {
                Vec3 face;
                face[axis] = sign;
                faces.push_back(face);
            }
        }
    }
    return faces;
}

TriangleTree tree_of(const Surface& surface) {
    return {surface.vertices, surface.triangles};
}

/// A place in a rim from which barriers go on.
struct Start {
    struct Use {
        std::size_t fault = 0;
        Vec3 normal;    ///< of its sheet
        Vec3 way;       ///< sum of the edges' ways on, in the sheet's tangent plane
        int edges = 0;  ///< of the rim that goes on
    };
    Vec3 position;
    std::vector<Use> uses;
    std::vector<Vec3> rows;  ///< from the position on; empty: not made yet
    Vec3 last;               ///< the last row, far away or where the way ended

    Use& use(std::size_t fault) {
        const auto found = std::ranges::find(uses, fault, &Use::fault);
        return found != uses.end() ? *found : uses.emplace_back(Use{fault, {}, {}, 0});
    }
    [[nodiscard]] bool is_of(std::size_t fault) const {
        return std::ranges::find(uses, fault, &Use::fault) != uses.end();
    }

    /// Straight on; where sheets meet, along the line in which they do.
    [[nodiscard]] Vec3 way() const {
        Vec3 sum;
        for (const Use& use : uses) {
            sum = sum + unit(use.way);
        }
        sum = unit(sum);
        if (uses.size() > 1) {
            const Vec3 along = cross(unit(uses[0].normal), unit(uses[1].normal));
            const double heading = dot(unit(along), sum);
            if (length(along) > 0.1 && std::abs(heading) > 0.2) {
                return heading < 0 ? -unit(along) : unit(along);
            }
        }
        return sum;
    }
};

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
    Continuation(const Site& site, const Domain& domain, std::span<const Fault> faults, bool horizons)
        : site_(site), faults_(faults), extent_(domain.extent) {
        reach_ = bounding_box(site.samples.positions);
        if (!domain.hull.empty()) {
            reach_.extend(domain.hull.lo);
            reach_.extend(domain.hull.hi);
        }
        for (const Fault& fault : faults) {
            barriers_.push_back({bars(fault, horizons), {}, {}});
            spacing_ = std::max(spacing_, fault.spacing);
        }
        going_.resize(barriers_.size());
        find_rims();
    }

    std::vector<EstimationBarrier> run() {
        prepare();
        for (std::size_t count = 0; count < going_.size(); ++count) {
            const std::size_t f = next();
            for (Start* start : starts_of(f)) {
                if (start->rows.empty()) {
                    march(*start, f);
                }
            }
            going_[f].beyond = tree_of(strips(f, all_rows()));
            going_[f].done = true;
        }
        const std::vector<std::size_t> rows = rows_that_count();
        for (std::size_t f = 0; f < going_.size(); ++f) {
            barriers_[f].beyond = strips(f, rows);
            add_tips(f, rows);
        }
        return std::move(barriers_);
    }

    [[nodiscard]] bool within() const { return within_; }

  private:
    void find_rims() {
        const EdgeUses uses = edge_uses(faults_, [&](const Fault& fault) {
            return barriers_[static_cast<std::size_t>(&fault - faults_.data())].bars;
        });
        const EdgeUses bounds = edge_uses(faults_, [](const Fault& fault) { return is_bound(fault.sheet.kind); });
        std::map<EdgePlace, std::vector<std::size_t>> inside;  // an edge between two triangles of a sheet: that sheet
        std::vector<std::vector<EdgePlace>> ends(barriers_.size());
        for (std::size_t f = 0; f < barriers_.size(); ++f) {
            if (!barriers_[f].bars) {
                continue;
            }
            const Surface& sheet = faults_[f].sheet;
            const FaultMesh mesh{sheet.vertices, sheet.triangles};
            const std::vector<RimEdge> rim = rim_edges(mesh);
            const std::vector<Vec3> normals = rim_normals(mesh, rim);
            for (const RimEdge& e : rim) {
                const EdgePlace edge = sorted(mesh.points[e.from], mesh.points[e.to]);
                if (uses.at(edge) > 1) {
                    ends[f].push_back(edge);
                } else if (!goes_on(f, mesh, e, normals, bounds.contains(edge))) {
                    barriers_[f].rims.push_back(edge);
                }
            }
            for (const auto& [edge, count] : edge_uses({&faults_[f], 1}, [](const Fault&) { return true; })) {
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
    bool goes_on(std::size_t f, const FaultMesh& mesh, const RimEdge& e, const std::vector<Vec3>& normals,
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
            Start& start = starts_.try_emplace(mesh.points[v], Start{mesh.points[v], {}, {}, {}}).first->second;
            Start::Use& use = start.use(f);
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
            const Fault& fault = faults_[f];
            Surface read;
            for (const Surface& surface : site_.surfaces) {
                if (surface.name == fault.name && surface.kind == fault.sheet.kind) {
                    const auto first = static_cast<std::uint32_t>(read.vertices.size());
                    read.vertices.insert(read.vertices.end(), surface.vertices.begin(), surface.vertices.end());
                    for (const Triangle& t : surface.triangles) {
                        read.triangles.push_back({first + t[0], first + t[1], first + t[2]});
                    }
                }
            }
            going_[f].read = tree_of(read);
            going_[f].margin = tree_of(fault.margin);
            going_[f].sheet = tree_of(fault.sheet);
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

    std::vector<Start*> starts_of(std::size_t f) {
        std::vector<Start*> starts;
        for (auto& [position, start] : starts_) {
            if (start.is_of(f)) {
                starts.push_back(&start);
            }
        }
        return starts;
    }

    void march(Start& start, std::size_t f) {
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
    bool hold_on(const Start& start, bool in_margin, Vec3& place, double step) const {
        bool held = false;
        Vec3 at = place;
        for (int round = 0; round < (start.uses.size() > 1 ? 4 : 1); ++round) {
            for (const Start::Use& use : start.uses) {
                const Going& going = going_[use.fault];
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
    bool stopped(const Start& start, std::size_t f, bool held, const Vec3& p, Vec3& q) const {
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

    [[nodiscard]] static const Vec3& row_of(const Start& start, std::size_t row, bool last) {
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
        const auto straight = [&](const Start& start, std::size_t from, std::size_t to) {
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
        Surface surface{faults_[f].name, faults_[f].sheet.kind, {}, {}, {}};
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
            const Start& start = starts_.at(from);
            const Start& other = starts_.at(to);
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
        for (const Start* start : starts_of(f)) {
            if (start->uses.size() > 1 || start->uses[0].edges != 1) {
                continue;
            }
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const bool last = i + 1 == rows.size();
                barriers_[f].rims.push_back(
                    sorted(row_of(*start, rows[i], false), row_of(*start, last ? 0 : rows[i + 1], last)));
            }
        }
    }

    const Site& site_;
    std::span<const Fault> faults_;
    Box3 extent_;
    Box3 reach_;
    double spacing_ = 0;
    std::vector<EstimationBarrier> barriers_;
    std::vector<Going> going_;
    std::map<Vec3, Start> starts_;
    bool within_ = false;  ///< something goes on within the extent
};

}  // namespace

EstimationBarriers sheets_as_barriers(std::span<const Fault> faults) {
    const EdgeUses uses = edge_uses(faults, [](const Fault& fault) { return bars(fault, false); });
    EstimationBarriers barriers;
    for (const Fault& fault : faults) {
        EstimationBarrier& barrier = barriers.soft.emplace_back(EstimationBarrier{bars(fault, false), {}, {}});
        for (const Triangle& t : barrier.bars ? fault.sheet.triangles : std::vector<Triangle>{}) {
            for (std::size_t i = 0; i < 3; ++i) {
                const EdgePlace edge = sorted(fault.sheet.vertices[t[i]], fault.sheet.vertices[t[(i + 1) % 3]]);
                if (uses.at(edge) == 1) {
                    barrier.rims.push_back(edge);
                }
            }
        }
    }
    return barriers;
}

EstimationBarriers estimation_barriers(const Site& site, const Domain& domain, std::span<const Fault> faults) {
    EstimationBarriers barriers;
    Continuation soft(site, domain, faults, false);
    const bool within = soft.within();
    barriers.soft = soft.run();
    barriers.covered = within ? Box3{} : domain.extent;
    for (const Property& property : site.properties) {
        barriers.hard_for.push_back(property.hard_horizons);
    }
    const bool horizons =
        std::ranges::any_of(faults, [](const Fault& fault) { return fault.sheet.kind == SurfaceKind::horizon; });
    if (horizons && std::ranges::any_of(site.properties, &Property::hard_horizons)) {
        Continuation hard(site, domain, faults, true);
        barriers.covered = hard.within() ? Box3{} : barriers.covered;
        barriers.hard = hard.run();
    } else {
        barriers.hard_for.clear();
    }
    return barriers;
}

}  // namespace terratet
