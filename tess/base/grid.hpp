// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A hash grid of things at places, for questions of one fixed radius, its cells' size.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Whole numbers of a cubic cell, and one number for them. An index needs no more than 21 bits unless the cells are
/// below a millimetre for a continent; then keys wrap, which makes some cells share an entry: what is found is more.
struct GridCell {
    std::array<std::int64_t, 3> index{};

    static GridCell of(const Vec3& p, double size) {
        const auto whole = [&](double x) {
            return static_cast<std::int64_t>(std::clamp(std::floor(x / size), -9e18, 9e18));
        };
        return {{whole(p.x), whole(p.y), whole(p.z)}};
    }
    [[nodiscard]] GridCell moved(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return {{index[0] + i, index[1] + j, index[2] + k}};
    }
    [[nodiscard]] std::uint64_t key() const {
        constexpr std::uint64_t mask = (1U << 21U) - 1;
        return (static_cast<std::uint64_t>(index[0]) & mask) << 42U |
               (static_cast<std::uint64_t>(index[1]) & mask) << 21U | (static_cast<std::uint64_t>(index[2]) & mask);
    }
};

template <class Item>
class Grid {
  public:
    explicit Grid(double radius) : radius_(radius) {}

    void insert(const Vec3& place, const Item& item) { cells_[GridCell::of(place, radius_).key()].push_back(item); }

    /// Is the test true of one of the items at places within the radius of p? Asked of some beyond as well, in a fixed
    /// order, until it is.
    template <class Test>
    bool any_near(const Vec3& p, const Test& test) const {
        const GridCell centre = GridCell::of(p, radius_);
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                for (int k = -1; k <= 1; ++k) {
                    const auto cell = cells_.find(centre.moved(i, j, k).key());
                    if (cell != cells_.end() && std::any_of(cell->second.begin(), cell->second.end(), test)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    /// Calls with every item within the radius of p, and some beyond.
    template <class Visit>
    void visit(const Vec3& p, const Visit& call) const {
        any_near(p, [&](const Item& item) {
            call(item);
            return false;
        });
    }

    [[nodiscard]] double radius() const { return radius_; }

  private:
    double radius_;
    std::unordered_map<std::uint64_t, std::vector<Item>> cells_;
};

}  // namespace terratet
