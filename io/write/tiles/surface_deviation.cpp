// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/tiles/surface_deviation.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "tess/base/box_tree.hpp"

namespace terratet {
namespace {

struct Place {
    Vec3 at;
    Color color;
};

double difference(const Color& a, const Color& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The nearest place of a surface, and how its colour differs.
class Nearest {
  public:
    Nearest(const SurfaceLook& look, std::span<const Triangle> triangles)
        : look_(look),
          tree_(
              {triangles.begin(), triangles.end()}, 2,
              [&look](auto& node, const Triangle& t) {
                  for (const std::uint32_t v : t) {
                      node.box.extend(look.places[v]);
                  }
              },
              [&look](const Triangle& t, int axis) {
                  return look.places[t[0]][axis] + look.places[t[1]][axis] + look.places[t[2]][axis];
              }) {}

    [[nodiscard]] Deviation from(const Place& place) const {
        Deviation best{std::numeric_limits<double>::infinity(), 1};
        tree_.near_first(
            place.at, [&](const auto&, double squared) { return squared <= best.distance * best.distance; },
            [&](const Triangle& t) {
                const auto& [a, b, c] = t;
                const Vec3 near =
                    closest_point_on_triangle(place.at, look_.places[a], look_.places[b], look_.places[c]);
                const Deviation here{distance(place.at, near), difference(place.color, color_at(t, near))};
                if (std::tie(here.distance, here.color) < std::tie(best.distance, best.color)) {
                    best = here;
                }
            });
        return best;
    }

  private:
    [[nodiscard]] Color color_at(const Triangle& t, const Vec3& p) const {
        if (look_.colors.empty()) {
            return {};
        }
        const auto corner = [&](std::size_t k) { return look_.places[t[k]]; };
        const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
        const double whole = squared_length(normal);
        if (whole == 0) {
            return look_.colors[t[0]];
        }
        Color color{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            const double share = dot(normal, cross(corner((k + 1) % 3) - p, corner((k + 2) % 3) - p)) / whole;
            const Color& own = look_.colors[t[k]];
            color = {color.r + share * own.r, color.g + share * own.g, color.b + share * own.b};
        }
        return color;
    }

    const SurfaceLook& look_;
    BoxTree<Triangle> tree_;
};

Deviation largest(const Nearest& nearest, const std::vector<Place>& places) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, places.size(), 256), Deviation{},
        [&](const auto& range, Deviation most) {
            for (std::size_t n = range.begin(); n < range.end(); ++n) {
                most.extend(nearest.from(places[n]));
            }
            return most;
        },
        [](Deviation a, const Deviation& b) {
            a.extend(b);
            return a;
        });
}

std::vector<Place> middles(const SurfaceLook& look, std::span<const Triangle> triangles) {
    std::vector<Place> places;
    for (const auto& [a, b, c] : triangles) {
        Place middle{(look.places[a] + look.places[b] + look.places[c]) / 3, {}};
        if (!look.colors.empty()) {
            const Color &p = look.colors[a], &q = look.colors[b], &r = look.colors[c];
            middle.color = {(p.r + q.r + r.r) / 3, (p.g + q.g + r.g) / 3, (p.b + q.b + r.b) / 3};
        }
        places.push_back(middle);
    }
    return places;
}

std::vector<Place> corners(const SurfaceLook& look, std::span<const Triangle> triangles) {
    std::vector<std::uint32_t> used;
    for (const Triangle& t : triangles) {
        used.insert(used.end(), t.begin(), t.end());
    }
    std::ranges::sort(used);
    const auto rest = std::ranges::unique(used);
    used.erase(rest.begin(), rest.end());
    std::vector<Place> places;
    for (const std::uint32_t v : used) {
        places.push_back({look.places[v], look.colors.empty() ? Color{} : look.colors[v]});
    }
    return places;
}

}  // namespace

void Deviation::extend(const Deviation& other) {
    distance = std::max(distance, other.distance);
    color = std::max(color, other.color);
}

double Deviation::metres(double color_metres) const {
    return std::max(distance, color_metres * color);
}

Deviation surface_deviation(const SurfaceLook& look, std::span<const Triangle> full, std::span<const Triangle> coarse) {
    const Nearest of_coarse(look, coarse);
    Deviation most = largest(of_coarse, corners(look, full));
    most.extend(largest(of_coarse, middles(look, full)));
    most.extend(largest(Nearest(look, full), middles(look, coarse)));
    return most;
}

}  // namespace terratet
