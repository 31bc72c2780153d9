// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/leaks.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "tess/barrier/query/protection_zone.hpp"
#include "tess/barrier/seeds/leak_probes.hpp"
#include "tess/barrier/seeds/leak_sheets.hpp"
#include "tess/barrier_query.hpp"
#include "tess/base/seed_grid.hpp"
#include "tess/base/tri_mesh.hpp"
#include "tess/mesh/bulk_insertion.hpp"
#include "tess/mesh/delaunay.hpp"

namespace terratet {
namespace {

struct Seen {
    bool yes = false;
};
using Kernel = delaunay::Epick;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<Seen, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Cell = Delaunay::Cell_handle;
using Corners = std::array<std::uint32_t, 4>;  ///< sites
using Edge = std::array<std::uint32_t, 2>;     ///< likewise

constexpr double low = 0.02;      ///< of the spacing: pairs so narrow stand where layers of a sheet lie on each other
constexpr double shallow = 0.95;  ///< of the protection radius: balls reach that far anyhow
constexpr double inside = 0.995;  ///< of the protection radius: what is protected for sure

using delaunay::from_cgal;
using delaunay::to_cgal;

/// What lies round a pair of seeds.
struct Surroundings {
    std::vector<SheetPlane> planes;  ///< of the triangles near it; the first is the one that it is mirrored in
    bool plain = true;               ///< no other sheet is near, no rim, and no bend
};

}  // namespace

struct LeakFinder::Impl {
    std::span<const Barrier> barriers;
    Box3 hull;
    LeakSheets sheets;
    ProtectionZone zone;
    std::vector<Site> sites;
    std::vector<Delaunay::Vertex_handle> vertices;  ///< by site
    std::vector<Surroundings> around;               ///< by half their sites
    Delaunay tessellation;
    SeedGrid protected_balls;
    std::vector<std::uint32_t> protectors;  ///< of these balls
    double probe_reach;                     ///< larger balls are probed about their seeds alone
    LeakProbes probes;
    std::vector<Cell> found;  ///< by number of the leak, in the last find()
    std::vector<Edge> leaking_edges;

    Impl(std::span<const Barrier> given, const Box3& box, const Poll& poll)
        : barriers(given),
          hull(box),
          sheets(given),
          zone(given),
          protected_balls({}, sheets.widest_protection()),
          probe_reach(2 * sheets.widest_protection()) {
        PatientPoll go_on(poll);
        probes = sheets.probes(zone, hull, poll);
        std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
        for (std::uint32_t f = 0; f < barriers.size(); ++f) {
            for (std::size_t k = 0; k + 1 < barriers[f].seeds.size(); k += 2) {
                go_on();
                add_sites(f, barriers[f].seeds[k].position, barriers[f].seeds[k + 1].position);
            }
        }
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p{(corner & 1) != 0 ? hull.hi.x : hull.lo.x, (corner & 2) != 0 ? hull.hi.y : hull.lo.y,
                         (corner & 4) != 0 ? hull.hi.z : hull.lo.z};
            sites.push_back({p, {}, {}, no_index, no_index, true});
        }
        for (std::uint32_t i = 0; i < sites.size(); ++i) {
            points.emplace_back(to_cgal(sites[i].position), i);
        }
        delaunay::insert(tessellation, points, go_on);
        vertices.resize(sites.size());
        for (const auto vertex : tessellation.finite_vertex_handles()) {
            vertices[vertex->info()] = vertex;
        }
    }

    std::uint32_t add_sites(std::uint32_t owner, const Vec3& plus, const Vec3& minus) {
        const auto first = static_cast<std::uint32_t>(sites.size());
        const Vec3 base = 0.5 * (plus + minus);
        const Vec3 normal = unit(plus - minus);
        sites.push_back({plus, base, normal, owner, first, true});
        sites.push_back({minus, base, normal, owner, first, true});
        around.resize(first / 2 + 1);
        Surroundings& here = around.back();
        here.planes = sheets.planes_about(owner, base, normal);
        here.plain = sheets.is_plain(owner, base, normal) && distance(plus, minus) > low * barriers[owner].spacing;
        return first;
    }

    /// In the cells that were not looked at before, and of edges that leaked.
    std::vector<Leak> find(const std::function<void(double)>& progress) {
        std::vector<std::pair<Leak, Cell>> leaks;
        std::vector<Edge> edges = std::move(leaking_edges);
        leaking_edges.clear();
        std::erase_if(edges, [&](const Edge& edge) {
            Cell cell;
            int i = 0;
            int j = 0;
            return !sites[edge[0]].present || !sites[edge[1]].present ||
                   !tessellation.is_edge(vertices[edge[0]], vertices[edge[1]], cell, i, j);
        });
        const auto all = static_cast<double>(tessellation.number_of_cells());
        std::size_t looked_at = 0;
        for (const auto cell : tessellation.finite_cell_handles()) {
            if (progress && looked_at++ % 1024 == 0) {
                progress(std::min(1.0, static_cast<double>(looked_at) / all));
            }
            if (std::exchange(cell->info().yes, true)) {
                continue;
            }
            if (Leak leak; leaks_through(cell, leak)) {
                leaks.emplace_back(leak, cell);
            }
            for (int i = 0; i < 4; ++i) {
                for (int j = i + 1; j < 4; ++j) {
                    const auto [a, b] = std::minmax(cell->vertex(i)->info(), cell->vertex(j)->info());
                    if (sites[a].owner != sites[b].owner && sites[a].owner != no_index && sites[b].owner != no_index) {
                        edges.push_back({a, b});
                    }
                }
            }
        }
        std::ranges::sort(edges);
        edges.erase(std::ranges::unique(edges).begin(), edges.end());
        for (const auto& [a, b] : edges) {
            test_edge(a, b, leaks);
        }
        std::ranges::sort(leaks, {}, [](const auto& entry) {
            const Leak& leak = entry.first;
            return std::tuple(leak.center, leak.radius, leak.from, leak.barrier);
        });
        std::vector<Leak> result;
        found.clear();
        for (auto& [leak, cell] : leaks) {
            leak.number = static_cast<std::uint32_t>(result.size());
            result.push_back(leak);
            found.push_back(cell);
        }
        return result;
    }

    void test_edge(std::uint32_t a, std::uint32_t b, std::vector<std::pair<Leak, Cell>>& leaks) {
        const Vec3& from = sites[a].position;
        const Vec3& to = sites[b].position;
        for (std::uint32_t f = 0; f < barriers.size(); ++f) {
            const auto barrier = static_cast<std::int32_t>(f);
            const bool own = sheets.query().meet(barrier, static_cast<std::int32_t>(sites[a].owner)) &&
                             sheets.query().meet(barrier, static_cast<std::int32_t>(sites[b].owner));
            if (!own && sheets.crosses(f, from, to)) {
                leaks.push_back({{0.5 * (from + to), 0.5 * distance(from, to), true, a, to, f,
                                  sheets.crossing_place(f, from, to), f, 0},
                                 Cell()});
                leaking_edges.push_back({a, b});
            }
        }
    }

    bool leaks_through(const Cell& cell, Leak& leak) const {
        Corners v{};
        for (std::size_t i = 0; i < 4; ++i) {
            v[i] = cell->vertex(static_cast<int>(i))->info();
        }
        leak.center = from_cgal(cell->circumcenter(Kernel()));
        leak.radius = distance(leak.center, sites[v[0]].position);
        if (is_shallow(v, leak)) {
            return false;
        }
        std::vector<SheetPlane> planes;
        double widest = -1;
        for (const std::uint32_t i : v) {
            if (sites[i].owner == no_index) {
                continue;
            }
            if (const double protection = barriers[sites[i].owner].protection_radius; protection > widest) {
                widest = protection;
                leak.protector = sites[i].owner;
            }
            std::ranges::copy_if(around[i / 2].planes, std::back_inserter(planes),
                                 [&](const SheetPlane& plane) { return is_wanted(plane, planes); });
        }
        return leaks_over(planes, cell, v, leak) || holds_probe(cell, v, leak) || holds_chord(cell, v, leak);
    }

    /// Far from all other sheets, rims and bends no ball leaks that reaches less than r_p through its seeds' planes.
    [[nodiscard]] bool is_shallow(const Corners& v, const Leak& ball) const {
        return std::ranges::all_of(v, [&](std::uint32_t i) {
            const Site& site = sites[i];
            const double height = dot(ball.center - site.base, site.normal);
            const double side = i == site.first ? 1 : -1;
            return site.owner == no_index ||
                   (around[i / 2].plain &&
                    ball.radius - side * height < shallow * barriers[site.owner].protection_radius);
        });
    }

    /// At the ball's places farthest off each plane, and at those over its seeds just out of the zone.
    bool leaks_over(const std::vector<SheetPlane>& planes, const Cell& cell, const Corners& v, Leak& leak) const {
        if (leads_to(leak.center, planes, cell, v, leak)) {
            return true;
        }
        for (const SheetPlane& plane : planes) {
            for (const double side : {1.0, -1.0}) {
                const Vec3 out = side * plane.normal;
                if (leads_to(leak.center + (1 - 1e-9) * leak.radius * out, planes, cell, v, leak)) {
                    return true;
                }
                for (const std::uint32_t i : v) {
                    const Vec3& from = sites[i].position;
                    const double way = just_beyond * plane.protection - dot(from - plane.base, out);
                    if (sites[i].owner != no_index && leads_to(from + way * out, planes, cell, v, leak)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    /// Is the place in the ball and out of the zone, and hidden from one of the cell's seeds? Only behind one of the
    /// planes can it be.
    bool leads_to(const Vec3& to, const std::vector<SheetPlane>& planes, const Cell& cell, const Corners& v,
                  Leak& leak) const {
        if (!holds(leak, to) || !hull.contains(to)) {
            return false;
        }
        const auto is_behind = [&](const Vec3& from,
                                   const SheetPlane& plane) {  // or so near that a fold may be between
            const double height = dot(from - plane.base, plane.normal);
            const double side = dot(to - plane.base, plane.normal) < 0 ? -1 : 1;
            return side * height < same_height * plane.protection;
        };
        Corners behind{};
        std::size_t count = 0;
        for (const std::uint32_t i : v) {
            if (sites[i].owner != no_index && std::ranges::any_of(planes, [&](const SheetPlane& plane) {
                    return is_behind(sites[i].position, plane);
                })) {
                behind[count++] = i;
            }
        }
        if (count == 0 || is_protected(to) || zone.contains(to)) {  // that rules out most
            return false;
        }
        for (const std::uint32_t i : std::span(behind).first(count)) {
            for (std::uint32_t f = 0; f < barriers.size(); ++f) {
                if (sheets.crosses(f, sites[i].position, to)) {
                    return describe(i, f, to, cell, leak);
                }
            }
        }
        return false;
    }

    bool holds_probe(const Cell& cell, const Corners& v, Leak& leak) const {
        const auto test = [&](const LeakProbe& probe) { return leads_to_probe(probe, cell, v, leak); };
        if (leak.radius <= probe_reach) {
            return probes.any_within(leak.center, leak.radius, test);
        }
        for (std::size_t k = 0; k < v.size(); ++k) {
            const Vec3& here = sites[v[k]].position;
            if (std::none_of(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(k),
                             [&](std::uint32_t i) { return distance(sites[i].position, here) < 0.1 * probe_reach; }) &&
                probes.any_within(here, probe_reach, test)) {
                return true;
            }
        }
        return false;
    }

    /// Through the sheet that the probe stands over.
    bool leads_to_probe(const LeakProbe& probe, const Cell& cell, const Corners& v, Leak& leak) const {
        if (!holds(leak, probe.place)) {
            return false;
        }
        const bool pushed = probe.out == Vec3{};
        for (const std::uint32_t i : v) {
            const Vec3& from = sites[i].position;
            const double height = dot(probe.place - from, probe.out);
            const double below = (1 - same_height) * barriers[probe.barrier].protection_radius;  // or hardly above
            if (sites[i].owner == no_index || (!pushed && height <= below)) {
                continue;
            }
            const std::uint32_t first = pushed ? 0 : probe.barrier;
            const auto last = pushed ? static_cast<std::uint32_t>(barriers.size()) : probe.barrier + 1;
            for (std::uint32_t f = first; f < last; ++f) {
                if (sheets.crosses(f, from, probe.place)) {
                    return describe(i, f, probe.place, cell, leak);
                }
            }
        }
        return false;
    }

    /// Do two other vertices find room in the ball, one on either side of a sheet? Past a rim both may see all of the
    /// ball's seeds. With h the height of the centre over a triangle's plane and t the way from the foot there to
    /// where a chord runs through the triangle, that chord has r_p on either side of the plane in the ball if
    /// h² + t² + r_p² (1 + h²/t²) < R², or (|h| + r_p)² < R² where t² < |h| r_p: steep ones are longer.
    bool holds_chord(const Cell& cell, const Corners& v, Leak& leak) const {
        const double squared_radius = leak.radius * leak.radius;
        const auto test = [&](const ProtectionZone::Ball& near) {
            const TriangleCorners& c = near.corners;
            const double protection = just_beyond * near.radius;
            const Vec3 normal = unit(area_vector(c));
            const double height = dot(leak.center - c[0], normal);
            const double deep = std::abs(height) + protection;
            if (!near.sheet || normal == Vec3{} || deep * deep >= squared_radius) {
                return false;
            }
            const Vec3 foot = leak.center - height * normal;
            const Vec3 place = closest_point_on_triangle(foot, c[0], c[1], c[2]);
            const double t = distance(foot, place);
            const bool steep = t * t < protection * std::abs(height);
            const double lean = steep || t == 0 ? t : protection * std::abs(height) / t;
            const double reach = steep ? deep * deep : height * height + t * t + protection * protection + lean * lean;
            if (reach >= squared_radius) {
                return false;
            }
            const Vec3 half = protection * normal + (t > 0 ? (height > 0 ? lean : -lean) / t * (place - foot) : Vec3{});
            for (const Vec3& end : {place + half, place - half}) {
                if (!hull.contains(end) || is_protected(end) || zone.contains(end)) {
                    return false;
                }
            }
            for (const std::uint32_t i : v) {
                if (sites[i].owner != no_index && describe(i, near.barrier, place + half, cell, leak)) {
                    leak.place = place;
                    return true;
                }
            }
            return false;
        };
        const double span = squared_radius - zone.narrowest() * zone.narrowest();
        return span > 0 && zone.any_near(leak.center, std::sqrt(span), test);
    }

    static bool holds(const Leak& ball, const Vec3& p) {
        return squared_distance(p, ball.center) < ball.radius * ball.radius;
    }

    /// False when the place is not in the ball after all: the computed centre of a flat cell may be far off.
    bool describe(std::uint32_t i, std::uint32_t f, const Vec3& to, const Cell& cell, Leak& leak) const {
        if (tessellation.side_of_sphere(cell, to_cgal(to)) != CGAL::ON_BOUNDED_SIDE) {
            return false;
        }
        const Vec3& from = sites[i].position;
        leak.from = i;
        leak.to = to;
        leak.barrier = f;
        leak.place = sheets.crosses(f, from, leak.center) ? sheets.crossing_place(f, from, leak.center)
                     : sheets.crosses(f, leak.center, to) ? sheets.crossing_place(f, leak.center, to)
                                                          : sheets.crossing_place(f, from, to);
        return true;
    }

    [[nodiscard]] bool is_protected(const Vec3& p) const { return is_protected(p, 0); }
    [[nodiscard]] bool is_protected(const Vec3& center, double radius) const {
        bool held = false;
        protected_balls.visit(center, [&](std::uint32_t k) {
            held = held || distance(protected_balls.point(k), center) + radius <
                               inside * barriers[protectors[k]].protection_radius;
        });
        return held;
    }
};

LeakFinder::LeakFinder(std::span<const Barrier> barriers, const Box3& hull, const Poll& poll)
    : impl_(std::make_unique<Impl>(barriers, hull, poll)) {}
LeakFinder::~LeakFinder() = default;

std::vector<Leak> LeakFinder::find(const std::function<void(double)>& progress) {
    return impl_->find(progress);
}

const std::vector<LeakFinder::Site>& LeakFinder::sites() const {
    return impl_->sites;
}

void LeakFinder::protect(std::uint32_t barrier, const Vec3& center) {
    impl_->probes.retire_within(center, inside * impl_->barriers[barrier].protection_radius);
    impl_->protected_balls.insert(center);
    impl_->protectors.push_back(barrier);
}

bool LeakFinder::protects(const Leak& leak) const {
    return impl_->is_protected(leak.center, leak.radius);
}

void LeakFinder::look_again(const Leak& leak) {
    impl_->found[leak.number]->info().yes = false;
}

std::uint32_t LeakFinder::add_pair(std::uint32_t barrier, const Vec3& plus, const Vec3& minus) {
    const std::uint32_t first = impl_->add_sites(barrier, plus, minus);
    for (const std::uint32_t site : {first, first + 1}) {
        impl_->vertices.push_back(impl_->tessellation.insert(to_cgal(impl_->sites[site].position)));
        impl_->vertices.back()->info() = site;
    }
    return first;
}

void LeakFinder::drop_pair(std::uint32_t first) {
    for (const std::uint32_t site : {first, first + 1}) {
        impl_->sites[site].present = false;
        impl_->tessellation.remove(impl_->vertices[site]);
    }
}

double LeakFinder::distance_to_seed(const Vec3& p) const {
    return distance(from_cgal(impl_->tessellation.nearest_vertex(to_cgal(p))->point()), p);
}

const LeakSheets& LeakFinder::sheets() const {
    return impl_->sheets;
}

std::vector<std::array<std::uint32_t, 4>> LeakFinder::cells_at(std::uint32_t first) const {
    std::vector<Cell> cells;
    for (const std::uint32_t site : {first, first + 1}) {
        impl_->tessellation.finite_incident_cells(impl_->vertices[site], std::back_inserter(cells));
    }
    std::vector<Corners> result;
    for (const Cell& cell : cells) {
        result.push_back(
            {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
    }
    return result;
}

}  // namespace terratet
