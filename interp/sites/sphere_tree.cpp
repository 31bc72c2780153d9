// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/sphere_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "interp/base/stamped.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 16;
constexpr double far_spheres = 1e3;  // squared, in reaches; farther, powers may be off by more than the margin
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

void SphereTree::Range::extend(const Lifted& p) {
    for (std::size_t i = 0; i < 4; ++i) {
        lo[i] = std::min(lo[i], p[i]);
        hi[i] = std::max(hi[i], p[i]);
    }
}

void SphereTree::Range::extend(const Range& other) {
    extend(other.lo);
    extend(other.hi);
}

SphereTree::SphereTree(const CompactCells& mesh) : cells_(mesh.cells().size()) {
    const Box3 cube = bounding_box(mesh.points());  // the ghosts'
    origin_ = cube.center();
    reach_ = cube.diagonal() / 2;
    margin_ = 1e-9 * reach_ * reach_;
    std::iota(cells_.begin(), cells_.end(), 0);
    split(mesh, 0, static_cast<std::uint32_t>(cells_.size()));

    StampedMap number;
    for (Group& group : groups_) {
        group.sums_begin = sums_.size();
        number.clear(mesh.points().size());
        for (const std::int32_t id : std::span(cells_).subspan(group.begin, group.end - group.begin)) {
            const auto i = static_cast<std::size_t>(id);
            for (std::size_t k = 0; k < 4; ++k) {
                const std::int32_t v = mesh.cells()[i].vertex[k];
                if (!number.contains(v)) {
                    number.insert(v, static_cast<std::int32_t>(sums_.size() - group.sums_begin));
                    sums_.push_back({v, 0});
                }
                sums_[group.sums_begin + static_cast<std::size_t>(number[v])].sum += mesh.parts()[i].of_vertex[k];
            }
        }
        group.sums_end = sums_.size();
    }
}

SphereTree::Lifted SphereTree::lifted(const CompactCells::Cell& cell) const {
    const Vec3 c = cell.center - origin_;
    return {c.x, c.y, c.z, (squared_length(c) - cell.squared_radius) / (2 * reach_)};
}

void SphereTree::split(const CompactCells& mesh, std::uint32_t begin, std::uint32_t end) {
    const auto here = groups_.size();
    const Range nothing{{infinity, infinity, infinity, infinity}, {-infinity, -infinity, -infinity, -infinity}};
    groups_.push_back({nothing, nothing, begin, end});
    if (end - begin <= leaf_size) {
        bound(mesh, groups_[here]);
        return;
    }
    Range range = nothing;
    for (std::uint32_t i = begin; i < end; ++i) {
        range.extend(lifted(mesh.cells()[static_cast<std::size_t>(cells_[i])]));
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 4; ++i) {
        if (range.hi[i] - range.lo[i] > range.hi[axis] - range.lo[axis]) {
            axis = i;
        }
    }
    const auto key = [&](std::int32_t id) {
        const double at = lifted(mesh.cells()[static_cast<std::size_t>(id)])[axis];
        return std::pair(at == at ? at : infinity, id);  // an uncertain radius is no number
    };
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(cells_.begin() + begin, cells_.begin() + middle, cells_.begin() + end,
                     [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    split(mesh, begin, middle);
    groups_[here].second = static_cast<std::uint32_t>(groups_.size());
    split(mesh, middle, end);
    for (const std::size_t half : {here + 1, static_cast<std::size_t>(groups_[here].second)}) {
        groups_[here].own.extend(groups_[half].own);
        groups_[here].halo.extend(groups_[half].halo);
    }
}

void SphereTree::bound(const CompactCells& mesh, Group& leaf) const {
    const auto include = [&](Range& range, const CompactCells::Cell& cell) {
        if (squared_distance(cell.center, origin_) + cell.squared_radius < far_spheres * reach_ * reach_) {
            range.extend(lifted(cell));
        } else {  // of an uncertain (NaN) or vast sphere too little is known
            range = {{-infinity, -infinity, -infinity, -infinity}, {infinity, infinity, infinity, infinity}};
        }
    };
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) {
        const auto& cell = mesh.cells()[static_cast<std::size_t>(cells_[i])];
        include(leaf.own, cell);
        include(leaf.halo, cell);
        for (const std::int32_t neighbour : cell.neighbour) {
            if (neighbour >= 0) {
                include(leaf.halo, mesh.cells()[static_cast<std::size_t>(neighbour)]);
            } else {
                leaf.halo.hi[3] = infinity;  // beyond the cube nothing is in conflict
            }
        }
    }
}

void SphereTree::find(const CompactCells& mesh, const Vec3& q, std::vector<std::uint32_t>& groups,
                      std::vector<std::int32_t>& cells) const {
    groups.clear();
    cells.clear();
    const Vec3 at = q - origin_;
    // Of the power: at·at + factor·(c, w), each term smallest or largest at one end of its range.
    const Lifted factor = {-2 * at.x, -2 * at.y, -2 * at.z, 2 * reach_};
    const double base = squared_length(at);
    const auto least = [&](const Range& range) {
        double sum = base;
        for (std::size_t i = 0; i < 4; ++i) {
            sum += std::min(factor[i] * range.lo[i], factor[i] * range.hi[i]);
        }
        return sum;
    };
    const auto most = [&](const Range& range) {
        double sum = base;
        for (std::size_t i = 0; i < 4; ++i) {
            sum += std::max(factor[i] * range.lo[i], factor[i] * range.hi[i]);
        }
        return sum;
    };
    std::array<std::uint32_t, 64> waiting;  // more than a tree of halves is deep
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t i = waiting[--count];
        const Group& group = groups_[i];
        if (least(group.own) > margin_) {
            continue;
        }
        if (most(group.halo) < -margin_) {
            groups.push_back(i);
        } else if (group.second != 0) {
            waiting[count++] = group.second;
            waiting[count++] = i + 1;
        } else {
            for (const std::int32_t id : this->cells(i)) {
                if (mesh.in_conflict(mesh.cells()[static_cast<std::size_t>(id)], q)) {
                    cells.push_back(id);
                }
            }
        }
    }
}

std::size_t SphereTree::memory_bytes() const {
    return sizeof(*this) + cells_.capacity() * sizeof(std::int32_t) + groups_.capacity() * sizeof(Group) +
           sums_.capacity() * sizeof(VertexSum);
}

}  // namespace terratet
