// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tess/barrier/seeds/ball_radii.hpp"
#include "tess/barrier/seeds/seeding.hpp"
#include "tess/base/compatible.hpp"
#include "tess/base/seed_grid.hpp"
#include "tess/base/seed_tree.hpp"

namespace terratet {
namespace {

constexpr double radius_factor = 1.01;  ///< of a point's ball over the largest circumradius round it
constexpr double local_height = 0.15;   ///< of other seeds over their triangle, in edge lengths
constexpr double most_lifted = 1;       ///< height of seeds over certified balls, in edge lengths
constexpr double ring_step = 0.2;       ///< of rings along junctions, in edge lengths
constexpr double ring_radius = 0.14;
constexpr double way_freedom = 0.02;    ///< in edge lengths: how far pairs may be moved to mend slivers,
constexpr double height_freedom = 0.1;  ///< and by which part lowered, unless they are certified

using Candidate = BallPair;

class ExactSeeds {
  public:
    explicit ExactSeeds(const SeedTask& task)
        : task_(task), complex_(task.complex), collector_(task), radius_(complex_.points.size(), 0) {}

    SeededComplex run() {
        find_radii();
        find_radical();
        const std::vector<char> chosen = choose();
        place_radical(chosen);
        const SeedGrid points = grid_of_points();
        for (std::uint32_t t = 0; t < chosen.size(); ++t) {
            if (t % 256 == 0) {
                ask(task_.poll);
            }
            if (chosen[t] == 0) {
                add_other(t, points);
            }
        }
        add_rings(chosen, points);
        mend(points);
        ask(task_.poll);
        SeededComplex result;
        result.certified = certify();
        result.radius = radius_;
        set_radii(result);
        collector_.test_separation(result);
        result.seeds = collector_.take();
        return result;
    }

  private:
    void find_radii() {
        for (std::uint32_t t = 0; t < complex_.triangles.size(); ++t) {
            const TriangleCorners c = corners(complex_, t);
            const double circumradius =
                distance(c[0], c[1]) * distance(c[1], c[2]) * distance(c[2], c[0]) / (4 * length(area_vector(c)));
            for (const std::uint32_t v : complex_.triangles[t]) {
                const double most = task_.sizes.at(complex_.points[v]);
                radius_[v] = std::max(radius_[v], radius_factor * std::min(circumradius, most));
            }
        }
    }

    /// The point of the plane with equal power to the three corners' balls, and what is left of it for the height.
    void find_radical() {
        for (std::uint32_t t = 0; t < complex_.triangles.size(); ++t) {
            radical_.push_back(radical(t));
        }
    }

    [[nodiscard]] Candidate radical(std::uint32_t t) const {
        const Triangle& v = complex_.triangles[t];
        return radical_pair(corners(complex_, t), {radius_[v[0]], radius_[v[1]], radius_[v[2]]});
    }

    [[nodiscard]] Vec3 normal(std::uint32_t t) const { return unit(area_vector(corners(complex_, t))); }

    [[nodiscard]] SeedGrid grid_of_points() const {
        return SeedGrid(complex_.points, 1.5 * task_.sizes.spacing());  // radii are smaller
    }

    /// The triangles that get radical seeds, as many as can be: those that have and see theirs, of which none enters
    /// the ball of another's corner.
    [[nodiscard]] std::vector<char> choose() const {
        std::vector<char> able(complex_.triangles.size(), 0);
        std::vector<std::vector<std::uint32_t>> star(complex_.points.size());
        for (std::uint32_t t = 0; t < able.size(); ++t) {
            if (t % 256 == 0) {
                ask(task_.poll);
            }
            if (radical_[t].height > 0 && !is_relaxed(t) && sees_its_seeds(t, radical_[t])) {
                able[t] = 1;
                for (const std::uint32_t v : complex_.triangles[t]) {
                    star[v].push_back(t);
                }
            }
        }
        std::vector<std::vector<std::uint32_t>> conflicts(able.size());
        const SeedGrid points = grid_of_points();
        for (std::uint32_t t = 0; t < able.size(); ++t) {
            const Vec3 up = radical_[t].height * normal(t);
            for (const Vec3& seed : {radical_[t].foot + up, radical_[t].foot - up}) {
                points.visit(seed, [&](std::uint32_t v) {
                    if (able[t] != 0 && distance(points.point(v), seed) < radius_[v] * (1 - ball_tolerance)) {
                        for (const std::uint32_t other : star[v]) {
                            conflicts[t].push_back(other);
                            conflicts[other].push_back(t);
                        }
                    }
                });
            }
        }
        ask(task_.poll);
        std::vector<char> chosen = compatible(std::move(conflicts));
        for (std::uint32_t t = 0; t < able.size(); ++t) {
            chosen[t] = chosen[t] != 0 && able[t] != 0 ? 1 : 0;
        }
        return chosen;
    }

    /// The theorem's conditions: the triangle's own seeds are there, on the spheres about its corners and on its own
    /// sides, and nothing is strictly inside these.
    [[nodiscard]] std::vector<char> certify() const {
        const SeedTree seeds(collector_.places());
        std::vector<char> clear(complex_.points.size(), 1);
        for (std::size_t v = 0; v < clear.size(); ++v) {
            const std::uint32_t nearest = seeds.nearest(complex_.points[v], 1.1 * task_.sizes.spacing());
            if (nearest != no_index &&
                distance(seeds.point(nearest), complex_.points[v]) < radius_[v] * (1 - ball_tolerance)) {
                clear[v] = 0;
            }
        }
        std::vector<char> certified = placed_;
        for (std::uint32_t t = 0; t < certified.size(); ++t) {
            if (std::ranges::any_of(complex_.triangles[t], [&](std::uint32_t v) { return clear[v] == 0; })) {
                certified[t] = 0;
            }
        }
        return certified;
    }

    [[nodiscard]] bool is_relaxed(std::uint32_t t) const {
        const TriangleCorners c = corners(complex_, t);
        return std::ranges::any_of(task_.relaxed, [&](const Vec3& place) {
            return distance(closest_point_on_triangle(place, c[0], c[1], c[2]), place) < task_.sizes.at(place);
        });
    }

    [[nodiscard]] bool sees_its_seeds(std::uint32_t t, const Candidate& pair) const {
        const Vec3 up = pair.height * normal(t);
        return sees(t, pair.foot + up) && sees(t, pair.foot - up);
    }

    [[nodiscard]] bool sees(std::uint32_t t, const Vec3& seed) const {
        const TriangleCorners c = corners(complex_, t);
        const Vec3 middle = centroid(c);
        for (const Vec3& x :
             {middle, c[0] + 0.02 * (middle - c[0]), c[1] + 0.02 * (middle - c[1]), c[2] + 0.02 * (middle - c[2])}) {
            if (task_.wall.between(x, seed, t)) {
                return false;
            }
        }
        return true;
    }

    void place_radical(const std::vector<char>& chosen) {
        ball_pairs_.resize(chosen.size());
        std::vector<std::uint32_t> all;
        for (std::uint32_t t = 0; t < chosen.size(); ++t) {
            if (chosen[t] != 0) {
                ball_pairs_[t] = radical_[t];
                all.push_back(t);
            }
        }
        const std::vector<std::array<Vec3, 2>> seeds =
            settled_seeds(complex_, radius_, ball_pairs_, ball_depth, all, all);
        placed_.assign(chosen.size(), 0);
        number_.assign(chosen.size(), 0);
        certified_ball_.assign(complex_.points.size(), 0);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::uint32_t t = all[i];
            number_[t] = collector_.seeds()[complex_.sheet[t]].size() / 2;
            if (collector_.add(complex_.sheet[t], seeds[i][0], seeds[i][1], {})) {
                placed_[t] = 1;
            } else {
                ball_pairs_[t] = {};
            }
            for (const std::uint32_t v : complex_.triangles[t]) {
                certified_ball_[v] = 1;
            }
        }
    }

    /// Pairs of certified triangles move with the radii of their corners' balls.
    void mend(const SeedGrid& points) {
        if (task_.mend_within == nullptr) {
            return;
        }
        std::vector<std::size_t> numbers;
        for (std::uint32_t t = 0; t < number_.size(); ++t) {
            numbers.push_back(collector_.first_pair(complex_.sheet[t]) + number_[t]);
        }
        BallRadii balls({complex_, points, task_.frame, radius_, ball_pairs_, numbers, certified_ball_, placed_,
                         [&](std::uint32_t t, const Vec3& seed) { return sees(t, seed); }},
                        collector_.places());
        collector_.mend([&](const Vec3& seed) { return harmless(seed, points); },
                        {[&](std::size_t pair, std::uint64_t number, const std::vector<MovablePair>& now) {
                             return balls.propose(pair, number, now);
                         },
                         [&](std::size_t, std::uint64_t) { balls.accept(); }});
    }

    [[nodiscard]] bool harmless(const Vec3& seed, const SeedGrid& points) const {
        bool inside = false;
        points.visit(seed, [&](std::uint32_t v) {
            inside = inside || (certified_ball_[v] != 0 &&
                                distance(points.point(v), seed) < radius_[v] * (1 - 0.1 * ball_tolerance));
        });
        return !inside;
    }

    /// Low seeds over a foot inside, or as high over it as the balls of certified triangles reach.
    void add_other(std::uint32_t t, const SeedGrid& points) {
        const Candidate low = low_candidate(t);
        if (add_harmless(t, low, points)) {
            return;
        }
        for (const Candidate& over : {radical_[t], low}) {
            if (add_harmless(t, {over.foot, over.height > 0 ? lifted(t, over, points) : 0}, points)) {
                return;
            }
        }
    }

    bool add_harmless(std::uint32_t t, const Candidate& candidate, const SeedGrid& points) {
        const Vec3 up = candidate.height * normal(t);
        return candidate.height > 0 && harmless(candidate.foot + up, points) && harmless(candidate.foot - up, points) &&
               sees(t, candidate.foot + up) && sees(t, candidate.foot - up) &&
               collector_.add(complex_.sheet[t], candidate.foot + up, candidate.foot - up,
                              {way_freedom * task_.sizes.at(candidate.foot), height_freedom});
    }

    /// The height over the candidate's foot from which on it is outside certified balls on both sides; 0 when that is
    /// too high.
    [[nodiscard]] double lifted(std::uint32_t t, const Candidate& candidate, const SeedGrid& points) const {
        const Vec3 n = normal(t);
        double height = candidate.height;
        points.visit(candidate.foot, [&](std::uint32_t v) {
            if (certified_ball_[v] != 0) {
                const Vec3 from = candidate.foot - points.point(v);
                const double slope = std::abs(dot(from, n));  // of the two sides the one that is longer inside
                const double square = slope * slope - squared_length(from) + radius_[v] * radius_[v];
                if (square > 0) {
                    height = std::max(height, slope + std::sqrt(square));
                }
            }
        });
        return height < most_lifted * task_.sizes.at(candidate.foot) ? height : 0;
    }

    /// The circumcentre, drawn towards the incentre until it is well inside; as high as the wedges at the edges allow.
    [[nodiscard]] Candidate low_candidate(std::uint32_t t) const {
        const TriangleCorners c = corners(complex_, t);
        const Triangle& v = complex_.triangles[t];
        const Vec3 n = normal(t);
        std::array<double, 3> side{};
        for (std::size_t k = 0; k < 3; ++k) {
            side[k] = distance(c[(k + 1) % 3], c[(k + 2) % 3]);
        }
        const double perimeter = side[0] + side[1] + side[2];
        const double double_area = 2 * length(area_vector(c));
        if (!(double_area > 1e-9 * perimeter * perimeter)) {
            return {};
        }
        const double inradius = double_area / perimeter;
        const Vec3 incentre = (side[0] * c[0] + side[1] * c[1] + side[2] * c[2]) / perimeter;
        const Vec3 ab = c[1] - c[0];
        const Vec3 ac = c[2] - c[0];
        const Vec3 m = cross(ab, ac);
        Vec3 foot =
            c[0] + (squared_length(ac) * cross(m, ab) + squared_length(ab) * cross(ac, m)) / (2 * squared_length(m));
        const auto inward = [&](const Vec3& p, std::size_t k) {  // distance from the edge that starts in corner k
            return dot(p - c[k], cross(n, unit(c[(k + 1) % 3] - c[k])));
        };
        double share = 0;  // towards the incentre
        for (std::size_t k = 0; k < 3; ++k) {
            const double here = inward(foot, k);
            if (here < 0.5 * inradius) {
                share = std::max(share, (0.5 * inradius - here) / (inradius - here));
            }
        }
        foot = foot + share * (incentre - foot);
        double height = local_height * task_.sizes.at(foot);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = std::min(v[k], v[(k + 1) % 3]);
            const std::uint32_t b = std::max(v[k], v[(k + 1) % 3]);
            const double wedge = wedge_angle(complex_, task_.edges.triangles(a, b), a, b);
            height = std::min(height, 0.9 * inward(foot, k) * std::tan(0.5 * std::min(wedge, 3.1)));
        }
        return {foot, height};
    }

    /// Pairs mirrored about each half-sheet of a junction edge that has a triangle without radical seeds.
    void add_rings(const std::vector<char>& chosen, const SeedGrid& points) {
        for (const EdgeTable::Edge& e : task_.edges.edges()) {
            const auto of_edge = task_.edges.triangles(e);
            const bool all_chosen = std::ranges::all_of(of_edge, [&](std::uint32_t t) { return chosen[t] != 0; });
            if (of_edge.size() < 2 || is_smooth(complex_, of_edge) || all_chosen) {
                continue;
            }
            const Fan fan = fan_about(complex_, of_edge, e.a, e.b);
            const Vec3 a = complex_.points[e.a];
            const Vec3 b = complex_.points[e.b];
            const double scale = task_.sizes.at(0.5 * (a + b));
            const int steps = std::max(1, static_cast<int>(std::ceil(distance(a, b) / (ring_step * scale))));
            for (std::size_t k = 0; k < fan.triangles.size(); ++k) {
                const std::uint32_t t = fan.triangles[k];
                const double before = fan.angle[(k + fan.angle.size() - 1) % fan.angle.size()];
                const double turn = 0.9 * std::min({0.5 * fan.angle[k], 0.5 * before, std::numbers::pi / 4});
                const Vec3 n = normal(t);
                const Vec3 along = unit(b - a);
                Vec3 away = cross(n, along);
                if (dot(away, centroid(corners(complex_, t)) - a) < 0) {
                    away = -1 * away;
                }
                const Vec3 level = ring_radius * scale * std::cos(turn) * away;
                const Vec3 up = ring_radius * scale * std::sin(turn) * n;
                for (int step = 0; step < steps; ++step) {
                    const Vec3 middle = a + ((step + 0.5) / steps) * (b - a) + level;
                    if (harmless(middle + up, points) && harmless(middle - up, points) &&
                        !task_.wall.between(middle, middle + up, t) && !task_.wall.between(middle, middle - up, t)) {
                        collector_.add(complex_.sheet[t], middle + up, middle - up,
                                       {way_freedom * scale, height_freedom});
                    }
                }
            }
        }
    }

    void set_radii(SeededComplex& result) const {
        result.covering_radius.assign(task_.surface_count, 0);
        result.protection_radius.assign(task_.surface_count, 0);
        for (std::uint32_t t = 0; t < complex_.triangles.size(); ++t) {
            double& covering = result.covering_radius[complex_.sheet[t]];
            covering = std::max(covering, terratet::covering_radius(corners(complex_, t)));
            for (const std::uint32_t v : complex_.triangles[t]) {
                double& widest = result.protection_radius[complex_.sheet[t]];
                widest = std::max(widest, radius_[v]);
            }
        }
    }

    const SeedTask& task_;
    const SheetComplex& complex_;
    SeedCollector collector_;
    std::vector<double> radius_;
    std::vector<Candidate> radical_;
    std::vector<BallPair> ball_pairs_;  ///< by triangle: of those that have radical seeds
    std::vector<std::size_t> number_;   ///< by triangle: of that pair among its surface's
    std::vector<char> placed_;          ///< by triangle: its radical seeds are there
    std::vector<char> certified_ball_;  ///< by point: no other seeds may enter its ball
};

}  // namespace

SeededComplex exact_seeds(const SeedTask& task) {
    return ExactSeeds(task).run();
}

}  // namespace terratet
