// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/triangle_grid.hpp"

#include <numbers>

#include "tess/base/random_share.hpp"

namespace terratet {
namespace {

constexpr int axis_bits = 21;
constexpr double axis_cells = 1 << axis_bits;

std::uint64_t pack(const std::array<std::uint32_t, 3>& cell) {
    return (std::uint64_t{cell[2]} << (2 * axis_bits)) | (std::uint64_t{cell[1]} << axis_bits) | cell[0];
}

double area(const TriangleCorners& t) {
    return 0.5 * length(cross(t[1] - t[0], t[2] - t[0]));
}

double perimeter(const TriangleCorners& t) {
    return distance(t[0], t[1]) + distance(t[1], t[2]) + distance(t[2], t[0]);
}

/// Entries to expect: volume of the triangle's neighbourhood over the volume of a cell.
double expected_entries(std::span<const TriangleCorners> triangles, std::span<const double> reach, double cell) {
    double entries = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const double r = reach[i] + cell;
        const double footprint = area(triangles[i]) + r * perimeter(triangles[i]) + std::numbers::pi * r * r;
        entries += footprint * 2 * r / (cell * cell * cell);
    }
    return entries;
}

double choose_cell(std::span<const TriangleCorners> triangles, std::span<const double> reach, const Box3& box) {
    double cell = std::numeric_limits<double>::infinity();
    for (const double r : reach) {
        cell = std::min(cell, 2 * r);
    }
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    cell = std::max({cell, 2 * longest / axis_cells, std::numeric_limits<double>::min()});
    const double budget = 100.0 * static_cast<double>(triangles.size()) + 1e6;
    while (expected_entries(triangles, reach, cell) > budget && cell < longest) {
        cell *= 1.5;
    }
    return cell;
}

}  // namespace

TriangleGrid::TriangleGrid(std::vector<TriangleCorners> triangles, std::span<const double> reach)
    : triangles_(std::move(triangles)) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        Box3 own;
        for (const Vec3& corner : triangles_[i]) {
            own.extend(corner);
        }
        own = own.grown(reach[i] * (1 + 1e-9));
        box_.extend(own.lo);
        box_.extend(own.hi);
    }
    if (triangles_.empty()) {
        return;
    }
    cell_ = choose_cell(triangles_, reach, box_);
    slots_.resize(1024);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        for_each_cell(triangles_[i], reach[i], [&](std::uint64_t key) { ++occupy(key).count; });
    }
    std::uint32_t begin = 0;
    for (Slot& slot : slots_) {
        slot.begin = begin;
        begin += slot.count;
        slot.count = 0;
    }
    entries_.resize(begin);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        for_each_cell(triangles_[i], reach[i], [&](std::uint64_t key) {
            Slot& slot = slots_[slot_of(key)];
            entries_[slot.begin + slot.count++] = i;
        });
    }
}

std::span<const std::uint32_t> TriangleGrid::candidates(const Vec3& p) const {
    if (!box_.contains(p)) {
        return {};
    }
    const Vec3 q = (p - box_.lo) / cell_;
    const Slot& slot = slots_[slot_of(
        pack({static_cast<std::uint32_t>(q.x), static_cast<std::uint32_t>(q.y), static_cast<std::uint32_t>(q.z)}))];
    return {entries_.data() + slot.begin, slot.count};
}

double TriangleGrid::squared_distance_to(std::uint32_t i, const Vec3& p) const {
    const TriangleCorners& t = triangles_[i];
    return squared_distance(p, closest_point_on_triangle(p, t[0], t[1], t[2]));
}

/// Halves the range of cells round the triangle, dropping what its neighbourhood does not touch: the cost follows the
/// number of cells found, not the volume of the triangle's box.
template <class Visit>
void TriangleGrid::for_each_cell(const TriangleCorners& t, double reach, Visit&& visit) const {
    struct Range {
        std::array<std::uint32_t, 3> lo, hi;  // inclusive
    };
    Range whole;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        const auto index = [&](double x) {
            return static_cast<std::uint32_t>(std::clamp((x - box_.lo[axis]) / cell_, 0.0, axis_cells - 1));
        };
        whole.lo[static_cast<std::size_t>(axis)] = index(least - reach * (1 + 1e-9));
        whole.hi[static_cast<std::size_t>(axis)] = index(most + reach * (1 + 1e-9));
    }
    const double slack = 1e-9 * (reach + cell_ + length(box_.size()) * 1e-3);
    std::vector<Range> stack{whole};
    while (!stack.empty()) {
        const Range range = stack.back();
        stack.pop_back();
        Vec3 lo;
        Vec3 hi;
        std::size_t widest = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            lo[a] = box_.lo[a] + cell_ * range.lo[axis];
            hi[a] = box_.lo[a] + cell_ * (range.hi[axis] + 1.0);
            if (range.hi[axis] - range.lo[axis] > range.hi[widest] - range.lo[widest]) {
                widest = axis;
            }
        }
        const Vec3 middle = 0.5 * (lo + hi);
        const double away = distance(middle, closest_point_on_triangle(middle, t[0], t[1], t[2]));
        if (away > reach + 0.5 * distance(lo, hi) + slack) {
            continue;
        }
        if (range.lo == range.hi) {
            visit(pack(range.lo));
            continue;
        }
        Range lower = range;
        Range upper = range;
        lower.hi[widest] = (range.lo[widest] + range.hi[widest]) / 2;
        upper.lo[widest] = lower.hi[widest] + 1;
        stack.push_back(upper);
        stack.push_back(lower);
    }
}

std::size_t TriangleGrid::slot_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = mixed_key(key) & mask;
    while (slots_[at].key != key && slots_[at].key != unused) {
        at = (at + 1) & mask;
    }
    return at;
}

TriangleGrid::Slot& TriangleGrid::occupy(std::uint64_t key) {
    std::size_t at = slot_of(key);
    if (slots_[at].key == unused) {
        if (2 * (occupied_ + 1) > slots_.size()) {
            grow();
            at = slot_of(key);
        }
        slots_[at].key = key;
        ++occupied_;
    }
    return slots_[at];
}

void TriangleGrid::grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
        if (slot.key != unused) {
            slots_[slot_of(slot.key)] = slot;
        }
    }
}

}  // namespace terratet
