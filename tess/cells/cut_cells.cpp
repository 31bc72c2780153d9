// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cut_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace terratet {
namespace {

class Cutter {
  public:
    Cutter(std::span<const double> level, double at) : level_(level), at_(at) {}

    void add(std::uint32_t index, const CellCorners& cell) {
        std::array<std::uint32_t, 4> order{};  // of the cell's corners: above, then below
        std::size_t above = 0;
        std::size_t below = 4;
        for (std::size_t k = 0; k < 4; ++k) {
            const double l = level_[cell[k]];
            if (std::isnan(l)) {
                return;
            }
            order[l >= at_ ? above++ : --below] = static_cast<std::uint32_t>(k);
        }
        if (above == 0 || above == 4) {
            return;
        }
        const auto corner = [&](std::size_t i, std::size_t o) { return corner_on(cell[order[i]], cell[order[o]]); };
        const bool turned = is_even(order);  // else they look to where the level falls
        if (above == 1) {
            polygon(index, {corner(0, 1), corner(0, 2), corner(0, 3)}, 3, turned);
        } else if (above == 3) {
            polygon(index, {corner(0, 3), corner(1, 3), corner(2, 3)}, 3, turned);
        } else {
            polygon(index, {corner(0, 2), corner(0, 3), corner(1, 3), corner(1, 2)}, 4, turned);
        }
    }

    CellCut take() { return std::move(cut_); }

  private:
    static bool is_even(const std::array<std::uint32_t, 4>& order) {
        int inversions = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                inversions += order[i] > order[j] ? 1 : 0;
            }
        }
        return inversions % 2 == 0;
    }

    /// The same corner for every cell round the edge.
    std::uint32_t corner_on(std::uint32_t u, std::uint32_t v) {
        auto [a, b] = std::minmax({u, v});
        double t = (at_ - level_[a]) / (level_[b] - level_[a]);
        if (t <= 0 || t >= 1) {  // at a point itself
            a = b = t <= 0 ? a : b;
            t = 0;
        }
        const auto [entry, fresh] = corners_.try_emplace(std::uint64_t{a} << 32 | b, cut_.corners.size());
        if (fresh) {
            cut_.corners.push_back({a, b, t});
        }
        return static_cast<std::uint32_t>(entry->second);
    }

    void polygon(std::uint32_t cell, std::array<std::uint32_t, 4> corners, std::size_t count, bool turned) {
        if (turned) {
            std::reverse(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count));
        }
        for (std::size_t k = 1; k + 1 < count; ++k) {
            const Triangle triangle{corners[0], corners[k], corners[k + 1]};
            if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
                cut_.triangles.push_back(triangle);
                cut_.cell.push_back(cell);
            }
        }
    }

    std::span<const double> level_;
    double at_;
    std::unordered_map<std::uint64_t, std::size_t> corners_;
    CellCut cut_;
};

/// The share of a corner's tip that is beyond the level, the others being on its other side.
double tip(double corner, double at, const std::array<double, 3>& others) {
    double share = 1;
    for (const double other : others) {
        share *= (corner - at) / (corner - other);
    }
    return share;
}

}  // namespace

std::vector<Vec3> CellCut::positions(std::span<const Vec3> points) const {
    std::vector<Vec3> result;
    result.reserve(corners.size());
    for (const auto& [a, b, t] : corners) {
        result.push_back(points[a] + t * (points[b] - points[a]));
    }
    return result;
}

std::vector<double> CellCut::mixed(std::span<const double> values) const {
    std::vector<double> result;
    result.reserve(corners.size());
    for (const auto& [a, b, t] : corners) {
        result.push_back(a == b ? values[a] : values[a] + t * (values[b] - values[a]));
    }
    return result;
}

std::vector<double> CellCut::values(const Property& property, std::span<const double> measured) const {
    std::vector<double> result;
    result.reserve(corners.size());
    for (const auto& [a, b, t] : corners) {
        if (a == b || property.kind == Kind::categorical) {
            result.push_back(measured[t <= 0.5 ? a : b]);
            continue;
        }
        const double from = to_scale(property, measured[a]);
        result.push_back(from_scale(property, from + t * (to_scale(property, measured[b]) - from)));
    }
    return result;
}

CellCut cut_cells(std::span<const CellCorners> cells, std::span<const double> level, double at,
                  std::span<const std::uint8_t> left_out) {
    Cutter cutter(level, at);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (left_out.empty() || left_out[c] == 0) {
            cutter.add(static_cast<std::uint32_t>(c), cells[c]);
        }
    }
    return cutter.take();
}

CellCut cut_cells(std::span<const Vec3> points, std::span<const CellCorners> cells, const CutPlane& plane,
                  std::span<const std::uint8_t> left_out) {
    std::vector<double> level;
    level.reserve(points.size());
    for (const Vec3& p : points) {
        level.push_back(plane.distance(p));
    }
    return cut_cells(cells, level, 0, left_out);
}

double share_above(const std::array<double, 4>& level, double at) {
    std::array<double, 4> l = level;
    if (std::any_of(l.begin(), l.end(), [](double v) { return std::isnan(v); })) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::sort(l.begin(), l.end(), std::greater<>());
    const auto above = std::count_if(l.begin(), l.end(), [at](double v) { return v >= at; });
    switch (above) {
        case 0:
            return 0;
        case 1:
            return tip(l[0], at, {l[1], l[2], l[3]});
        case 3:
            return 1 - tip(l[3], at, {l[0], l[1], l[2]});
        case 4:
            return 1;
        default: {  // a wedge between two corners, as three tetrahedra
            const auto along = [&](std::size_t i, std::size_t o) { return (l[i] - at) / (l[i] - l[o]); };
            const double ac = along(0, 2), ad = along(0, 3), bc = along(1, 2), bd = along(1, 3);
            return ac * ad + ac * (1 - ad) * bd + (1 - ac) * bc * bd;
        }
    }
}

}  // namespace terratet
