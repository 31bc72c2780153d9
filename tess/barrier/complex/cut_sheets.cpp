// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/cut_sheets.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace terratet {
namespace {

constexpr std::size_t meetings_limit = 20;  ///< of triangles with others, for each

using Fast = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

struct Piece {
    TriangleCorners corners;
    std::uint32_t sheet = 0;
};

/// What others leave on a triangle.
struct Cuts {
    std::vector<std::array<Exact::Point_3, 2>> segments;  ///< a point: both ends the same
    std::vector<std::uint32_t> covering;                  ///< coplanar pieces of earlier sheets that overlap it
};

template <class Kernel>
typename Kernel::Triangle_3 triangle(const TriangleCorners& c) {
    const auto point = [](const Vec3& p) { return typename Kernel::Point_3(p.x, p.y, p.z); };
    return {point(c[0]), point(c[1]), point(c[2])};
}

/// Pairs of pieces of different sheets that share a point, ascending.
std::vector<std::array<std::uint32_t, 2>> meeting_pairs(const std::vector<Piece>& pieces) {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Fast::Triangle_3> triangles;
    std::vector<Box> boxes;
    for (std::uint32_t t = 0; t < pieces.size(); ++t) {
        triangles.push_back(triangle<Fast>(pieces[t].corners));
        if (!triangles.back().is_degenerate()) {
            boxes.emplace_back(triangles.back().bbox(), t);
        }
    }
    std::vector<std::array<std::uint32_t, 2>> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        const auto [s, t] = std::minmax({a.info(), b.info()});
        if (pieces[s].sheet != pieces[t].sheet && CGAL::do_intersect(triangles[s], triangles[t])) {
            pairs.push_back({s, t});
        }
    });
    std::ranges::sort(pairs);
    return pairs;
}

/// The surface with the most meetings, when there are so many that cutting would never end: no fault has them.
std::optional<std::uint32_t> tangled(const std::vector<std::array<std::uint32_t, 2>>& pairs,
                                     const std::vector<Piece>& pieces, const std::vector<Sheet>& sheets) {
    if (pairs.size() <= meetings_limit * pieces.size() + 10000) {
        return {};
    }
    std::map<std::uint32_t, std::size_t> meetings;
    for (const auto& pair : pairs) {
        for (const std::uint32_t t : pair) {
            ++meetings[sheets[pieces[t].sheet].surface];
        }
    }
    return std::ranges::max_element(meetings, {}, [](const auto& entry) { return entry.second; })->first;
}

std::map<std::uint32_t, Cuts> find_cuts(const std::vector<std::array<std::uint32_t, 2>>& pairs,
                                        const std::vector<Piece>& pieces, const Poll& poll) {
    std::map<std::uint32_t, Cuts> cuts;
    std::size_t seen = 0;
    for (const auto& [s, t] : pairs) {
        if (seen++ % 256 == 0) {
            ask(poll);
        }
        const auto common = CGAL::intersection(triangle<Exact>(pieces[s].corners), triangle<Exact>(pieces[t].corners));
        if (!common) {
            continue;
        }
        std::vector<Exact::Point_3> outline;
        if (const auto* point = boost::get<Exact::Point_3>(&*common)) {
            outline = {*point};
        } else if (const auto* segment = boost::get<Exact::Segment_3>(&*common)) {
            outline = {segment->source(), segment->target()};
        } else if (const auto* corner = boost::get<Exact::Triangle_3>(&*common)) {
            outline = {corner->vertex(0), corner->vertex(1), corner->vertex(2)};
        } else {
            outline = boost::get<std::vector<Exact::Point_3>>(*common);
        }
        if (outline.size() > 2) {
            cuts[t].covering.push_back(s);
        }
        const std::size_t sides = outline.size() > 2 ? outline.size() : 1;
        for (std::size_t k = 0; k < sides; ++k) {
            const std::array<Exact::Point_3, 2> side = {outline[k], outline[(k + 1) % outline.size()]};
            cuts[s].segments.push_back(side);
            cuts[t].segments.push_back(side);
        }
    }
    return cuts;
}

/// Along the axis that a triangle faces most, its corners stay apart.
struct Projection {
    explicit Projection(const TriangleCorners& c) : plane(triangle<Exact>(c).supporting_plane()) {
        const Vec3 normal = area_vector(c);
        const std::array<double, 3> facing = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
        axis = static_cast<int>(std::ranges::max_element(facing) - facing.begin());
        reversed = normal[axis] < 0;
    }

    [[nodiscard]] Exact::Point_2 flat(const Exact::Point_3& p) const { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

    /// The double nearest to each exact coordinate: the same for a point however it was arrived at.
    [[nodiscard]] Vec3 lifted(const Exact::Point_2& p) const {
        const std::array<Exact::FT, 3> normal = {plane.a(), plane.b(), plane.c()};
        const int u = (axis + 1) % 3;
        const int w = (axis + 2) % 3;
        const auto at = [](int k) { return static_cast<std::size_t>(k); };
        const Exact::FT height = -(normal[at(u)] * p.x() + normal[at(w)] * p.y() + plane.d()) / normal[at(axis)];
        Vec3 result;
        result[axis] = CGAL::to_double(CGAL::exact(height));
        result[u] = CGAL::to_double(CGAL::exact(p.x()));
        result[w] = CGAL::to_double(CGAL::exact(p.y()));
        return result;
    }

    Exact::Plane_3 plane;
    int axis = 2;
    bool reversed = false;
};

/// The parts of one piece, along its cuts; those covered by an earlier sheet are left out, with their area.
std::vector<TriangleCorners> parts_of(const Piece& piece, const Cuts& cuts, const std::vector<Piece>& pieces,
                                      double& covered) {
    using Flat = CGAL::Constrained_triangulation_plus_2<
        CGAL::Constrained_Delaunay_triangulation_2<Exact, CGAL::Default, CGAL::Exact_intersections_tag>>;
    const Projection projection(piece.corners);
    const Exact::Triangle_3 whole = triangle<Exact>(piece.corners);
    Flat flat;
    for (int k = 0; k < 3; ++k) {
        flat.insert_constraint(projection.flat(whole.vertex(k)), projection.flat(whole.vertex(k + 1)));
    }
    for (const auto& [a, b] : cuts.segments) {
        if (a == b) {
            flat.insert(projection.flat(a));
        } else {
            flat.insert_constraint(projection.flat(a), projection.flat(b));
        }
    }
    std::vector<Exact::Triangle_2> covering;
    for (const std::uint32_t other : cuts.covering) {
        const Exact::Triangle_3 above = triangle<Exact>(pieces[other].corners);
        covering.push_back(
            {projection.flat(above.vertex(0)), projection.flat(above.vertex(1)), projection.flat(above.vertex(2))});
    }
    std::map<Flat::Vertex_handle, Vec3> places;
    for (const auto v : flat.finite_vertex_handles()) {
        places[v] = projection.lifted(v->point());
    }
    std::vector<TriangleCorners> parts;
    for (const auto face : flat.finite_face_handles()) {
        TriangleCorners part = {places.at(face->vertex(0)), places.at(face->vertex(1)), places.at(face->vertex(2))};
        if (projection.reversed) {
            std::swap(part[1], part[2]);
        }
        const Exact::Point_2 middle =
            CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
        if (std::ranges::any_of(covering, [&](const auto& t) { return !t.has_on_unbounded_side(middle); })) {
            covered += length(area_vector(part));
        } else {
            parts.push_back(part);
        }
    }
    std::ranges::sort(parts);
    return parts;
}

/// Collects triangles; points in equal places become one.
class Weld {
  public:
    void add(const TriangleCorners& part, std::uint32_t surface) {
        Triangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [entry, fresh] = place_.try_emplace(part[k], static_cast<std::uint32_t>(complex_.points.size()));
            if (fresh) {
                complex_.points.push_back(part[k]);
            }
            t[k] = entry->second;
        }
        Triangle key = t;
        std::ranges::sort(key);
        if (key[0] != key[1] && key[1] != key[2] && present_.insert(key).second) {
            complex_.triangles.push_back(t);
            complex_.sheet.push_back(surface);
        }
    }
    SheetComplex take() { return std::move(complex_); }

  private:
    SheetComplex complex_;
    std::map<Vec3, std::uint32_t> place_;
    std::set<Triangle> present_;
};

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double size = squared_length(along);
    const double t = size > 0 ? std::clamp(dot(p - a, along) / size, 0.0, 1.0) : 0;
    return squared_distance(p, a + t * along);
}

/// A patch on trial: does all of it lie within the tolerance of its junctions?
struct Patch {
    std::vector<std::uint32_t> triangles;
    std::vector<std::array<Vec3, 2>> junctions;
    bool has_rim = false;
};

bool near_junctions(const Patch& patch, const Vec3& p, double tolerance) {
    return std::ranges::any_of(patch.junctions, [&](const auto& junction) {
        return squared_distance_to_segment(p, junction[0], junction[1]) <= tolerance * tolerance;
    });
}

bool is_stub(const SheetComplex& complex, const Patch& patch, double tolerance) {
    if (!patch.has_rim || patch.junctions.empty()) {
        return false;
    }
    return std::ranges::all_of(patch.triangles, [&](std::uint32_t t) {
        const TriangleCorners c = corners(complex, t);
        const std::array<Vec3, 7> samples = {
            centroid(c), c[0], c[1], c[2], 0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0])};
        return std::ranges::all_of(samples, [&](const Vec3& p) { return near_junctions(patch, p, tolerance); });
    });
}

/// One round; returns how many patches went.
std::size_t drop_stubs(SheetComplex& complex, double tolerance, std::vector<double>& trimmed) {
    const EdgeTable edges(complex.triangles);
    const Patches numbering = patches(complex, edges);
    std::vector<Patch> all(numbering.count);
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        all[numbering.of_triangle[t]].triangles.push_back(t);
    }
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        for (const std::uint32_t t : of_edge) {
            Patch& patch = all[numbering.of_triangle[t]];
            patch.has_rim = patch.has_rim || of_edge.size() == 1;
            if (of_edge.size() > 1 && !is_smooth(complex, of_edge)) {
                patch.junctions.push_back({complex.points[e.a], complex.points[e.b]});
            }
        }
    }
    std::vector<char> dropped(complex.triangles.size(), 0);
    std::size_t count = 0;
    for (const Patch& patch : all) {
        if (is_stub(complex, patch, tolerance)) {
            ++count;
            for (const std::uint32_t t : patch.triangles) {
                dropped[t] = 1;
                trimmed[complex.sheet[t]] += length(area_vector(corners(complex, t)));
            }
        }
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < dropped.size(); ++t) {
        if (dropped[t] == 0) {
            complex.triangles[kept] = complex.triangles[t];
            complex.sheet[kept++] = complex.sheet[t];
        }
    }
    complex.triangles.resize(kept);
    complex.sheet.resize(kept);
    return count;
}

}  // namespace

CutSheets cut_sheets(const std::vector<Sheet>& sheets, std::uint32_t surface_count, double tolerance,
                     const Poll& poll) {
    CutSheets result;
    result.trimmed.assign(surface_count, 0);
    std::vector<Piece> pieces;
    for (std::uint32_t i = 0; i < sheets.size(); ++i) {
        for (const Triangle& t : sheets[i].mesh.triangles) {
            pieces.push_back({corners(sheets[i].mesh, t), i});
        }
    }
    const auto pairs = meeting_pairs(pieces);
    result.tangled = tangled(pairs, pieces, sheets);
    if (result.tangled) {
        return result;
    }
    const std::map<std::uint32_t, Cuts> cuts = find_cuts(pairs, pieces, poll);
    Weld weld;
    for (std::uint32_t t = 0; t < pieces.size(); ++t) {
        const std::uint32_t surface = sheets[pieces[t].sheet].surface;
        const auto cut = cuts.find(t);
        if (cut == cuts.end()) {
            weld.add(pieces[t].corners, surface);
            continue;
        }
        ask(poll);
        for (const TriangleCorners& part : parts_of(pieces[t], cut->second, pieces, result.trimmed[surface])) {
            weld.add(part, surface);
        }
    }
    result.complex = weld.take();
    for (int round = 0; round < 4 && drop_stubs(result.complex, tolerance, result.trimmed) > 0; ++round) {
    }
    compact(result.complex);
    return result;
}

}  // namespace terratet
