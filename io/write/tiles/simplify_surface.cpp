// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/tiles/simplify_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <queue>
#include <tuple>

namespace terratet {
namespace {

constexpr std::size_t dimensions = 6;
using Point = std::array<double, dimensions>;

double product(const Point& a, const Point& b) {
    double sum = 0;
    for (std::size_t k = 0; k < dimensions; ++k) {
        sum += a[k] * b[k];
    }
    return sum;
}

Point less(const Point& a, const Point& b, double times) {
    Point result;
    for (std::size_t k = 0; k < dimensions; ++k) {
        result[k] = a[k] - times * b[k];
    }
    return result;
}

bool to_length_one(Point& a) {
    const double length = std::sqrt(product(a, a));
    for (double& x : a) {
        x /= length;
    }
    return length > 0;
}

/// Squared distances to planes, weighted by the triangles' areas: p·A·p + 2 b·p + c.
struct Quadric {
    std::array<Point, dimensions> a{};
    Point b{};
    double c = 0;

    void add(const Quadric& other) {
        for (std::size_t i = 0; i < dimensions; ++i) {
            a[i] = less(a[i], other.a[i], -1);
        }
        b = less(b, other.b, -1);
        c += other.c;
    }
    void add_plane(const Point& p, const Point& q, const Point& r) {
        Point u = less(q, p, 1);
        Point v = less(r, p, 1);
        const double squared_area = std::max(0.0, product(u, u) * product(v, v) - product(u, v) * product(u, v)) / 4;
        if (squared_area == 0 || !to_length_one(u)) {
            return;
        }
        v = less(v, u, product(v, u));
        if (!to_length_one(v)) {
            return;
        }
        const double area = std::sqrt(squared_area);
        const double pu = product(p, u);
        const double pv = product(p, v);
        for (std::size_t i = 0; i < dimensions; ++i) {
            for (std::size_t j = 0; j < dimensions; ++j) {
                a[i][j] += area * ((i == j ? 1 : 0) - u[i] * u[j] - v[i] * v[j]);
            }
            b[i] += area * (pu * u[i] + pv * v[i] - p[i]);
        }
        c += area * (product(p, p) - pu * pu - pv * pv);
    }
    [[nodiscard]] double at(const Point& p) const {
        double sum = c + 2 * product(b, p);
        for (std::size_t i = 0; i < dimensions; ++i) {
            sum += p[i] * product(a[i], p);
        }
        return std::max(sum, 0.0);
    }
};

constexpr double most_turned = 0.2;  ///< cosine between a triangle before and after

class Simplification {
  public:
    Simplification(const SurfaceLook& look, std::vector<Triangle> triangles)
        : look_(look), triangles_(std::move(triangles)), alive_(triangles_.size(), true), left_(triangles_.size()) {
        number_vertices();
        of_vertex_.resize(given_.size());
        quadric_.resize(given_.size());
        stamp_.resize(given_.size(), 0);
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            const auto& [a, b, c] = triangles_[t];
            Quadric plane;
            plane.add_plane(point_[a], point_[b], point_[c]);
            for (const std::uint32_t v : triangles_[t]) {
                of_vertex_[v].push_back(t);
                quadric_[v].add(plane);
            }
        }
        find_borders();
    }

    std::vector<Triangle> run(std::size_t most) {
        for (std::uint32_t v = 0; v < given_.size(); ++v) {
            for (const std::uint32_t other : neighbours(v)) {
                offer(v, other);
            }
        }
        while (left_ > most && !offers_.empty()) {
            const Offer offer = offers_.top();
            offers_.pop();
            if (stamp_[offer.from] == offer.from_stamp && stamp_[offer.to] == offer.to_stamp &&
                may_contract(offer.from, offer.to)) {
                contract(offer.from, offer.to);
            }
        }
        std::vector<Triangle> result;
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (alive_[t]) {
                const auto& [a, b, c] = triangles_[t];
                result.push_back({given_[a], given_[b], given_[c]});
            }
        }
        return result;
    }

  private:
    struct Offer {
        double cost;
        std::uint32_t from;
        std::uint32_t to;
        std::uint32_t from_stamp;
        std::uint32_t to_stamp;
        bool operator<(const Offer& other) const {  // the cheapest is on top
            return std::tie(cost, from, to) > std::tie(other.cost, other.from, other.to);
        }
    };

    /// By first appearance; places from the first of them, so that products of large numbers do not cancel.
    void number_vertices() {
        std::map<std::uint32_t, std::uint32_t> index;
        for (Triangle& triangle : triangles_) {
            for (std::uint32_t& v : triangle) {
                const auto [entry, fresh] = index.try_emplace(v, static_cast<std::uint32_t>(given_.size()));
                if (fresh) {
                    given_.push_back(v);
                }
                v = entry->second;
            }
        }
        for (const std::uint32_t v : given_) {
            const Vec3 p = look_.places[v] - look_.places[given_.front()];
            const Color color = look_.colors.empty() ? Color{} : look_.colors[v];
            const double scale = look_.color_metres;
            point_.push_back({p.x, p.y, p.z, scale * color.r, scale * color.g, scale * color.b});
        }
    }

    void find_borders() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
        for (const Triangle& t : triangles_) {
            for (std::size_t k = 0; k < 3; ++k) {
                ++count[std::minmax(t[k], t[(k + 1) % 3])];
            }
        }
        fixed_.assign(given_.size(), false);
        for (const auto& [edge, times] : count) {
            if (times != 2) {
                fixed_[edge.first] = fixed_[edge.second] = true;
            }
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
        std::vector<std::uint32_t> result;
        for (const std::uint32_t t : of_vertex_[v]) {
            for (const std::uint32_t other : triangles_[t]) {
                if (other != v) {
                    result.push_back(other);
                }
            }
        }
        std::ranges::sort(result);
        const auto rest = std::ranges::unique(result);
        result.erase(rest.begin(), rest.end());
        return result;
    }

    void offer(std::uint32_t from, std::uint32_t to) {
        if (!fixed_[from]) {
            Quadric both = quadric_[from];
            both.add(quadric_[to]);
            offers_.push({both.at(point_[to]), from, to, stamp_[from], stamp_[to]});
        }
    }

    [[nodiscard]] Vec3 normal(const Triangle& t) const {
        const Vec3& a = look_.places[given_[t[0]]];
        return cross(look_.places[given_[t[1]]] - a, look_.places[given_[t[2]]] - a);
    }

    [[nodiscard]] bool may_contract(std::uint32_t from, std::uint32_t to) const {
        std::size_t shared = 0;
        for (const std::uint32_t t : of_vertex_[from]) {
            Triangle moved = triangles_[t];
            if (std::ranges::find(moved, to) != moved.end()) {
                ++shared;
                continue;
            }
            std::ranges::replace(moved, from, to);
            const Vec3 before = normal(triangles_[t]);
            const Vec3 after = normal(moved);
            if (dot(before, after) < most_turned * length(before) * length(after) ||
                (length(after) == 0 && length(before) > 0)) {
                return false;
            }
        }
        const auto of_from = neighbours(from);
        const auto of_to = neighbours(to);
        std::vector<std::uint32_t> common;
        std::ranges::set_intersection(of_from, of_to, std::back_inserter(common));
        return shared == 2 && common.size() == 2;  // else the surface would touch itself
    }

    void contract(std::uint32_t from, std::uint32_t to) {
        for (const std::uint32_t t : of_vertex_[from]) {
            if (std::ranges::find(triangles_[t], to) == triangles_[t].end()) {
                std::ranges::replace(triangles_[t], from, to);
                of_vertex_[to].push_back(t);
                continue;
            }
            alive_[t] = false;
            --left_;
            for (const std::uint32_t v : triangles_[t]) {
                if (v != from) {
                    std::erase(of_vertex_[v], t);
                }
            }
        }
        of_vertex_[from].clear();
        quadric_[to].add(quadric_[from]);
        ++stamp_[from];
        ++stamp_[to];
        for (const std::uint32_t other : neighbours(to)) {
            offer(to, other);
            offer(other, to);
        }
    }

    const SurfaceLook& look_;
    std::vector<Triangle> triangles_;  ///< of vertices numbered here
    std::vector<bool> alive_;
    std::size_t left_;
    std::vector<std::uint32_t> given_;  ///< which place a vertex is
    std::vector<Point> point_;
    std::vector<std::vector<std::uint32_t>> of_vertex_;
    std::vector<Quadric> quadric_;
    std::vector<std::uint32_t> stamp_;  ///< grows with each change: older offers no longer hold
    std::vector<bool> fixed_;
    std::priority_queue<Offer> offers_;
};

}  // namespace

std::vector<Triangle> simplify_surface(const SurfaceLook& look, std::vector<Triangle> triangles, std::size_t most) {
    return triangles.size() <= most ? std::move(triangles) : Simplification(look, std::move(triangles)).run(most);
}

}  // namespace terratet
