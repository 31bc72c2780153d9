// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/graded_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace terratet {

namespace {

constexpr std::uint32_t leaf_size = 8;

double squared_distance_to(const Box3& box, const Vec3& p) {
    return squared_distance(p, box.clamped(p));
}

}  // namespace

GradedSizes::GradedSizes(std::span<const FinePlace> places) : places_(places.begin(), places.end()) {
    if (!places_.empty()) {
        split(0, static_cast<std::uint32_t>(places_.size()));
    }
}

void GradedSizes::split(std::uint32_t begin, std::uint32_t end) {
    const std::size_t index = nodes_.size();
    Node node;
    node.least = std::numeric_limits<double>::infinity();
    node.begin = begin;
    node.end = end;
    for (std::uint32_t i = begin; i < end; ++i) {
        node.box.extend(places_[i].position);
        node.least = std::min(node.least, places_[i].l_min);
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        return;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(places_.begin() + begin, places_.begin() + middle, places_.begin() + end,
                     [axis](const FinePlace& a, const FinePlace& b) { return a.position[axis] < b.position[axis]; });
    split(begin, middle);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

double GradedSizes::at(const Vec3& p, double limit) const {
    if (!nodes_.empty()) {
        descend(0, p, limit);
    }
    return limit;
}

void GradedSizes::descend(std::uint32_t index, const Vec3& p, double& least) const {
    const Node& node = nodes_[index];
    const double room = (least - node.least) / gradation;
    if (room <= 0 || squared_distance_to(node.box, p) >= room * room) {
        return;
    }
    if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            least = std::min(least, places_[i].l_min + gradation * distance(places_[i].position, p));
        }
        return;
    }
    const bool right_first =
        squared_distance_to(nodes_[node.right].box, p) < squared_distance_to(nodes_[index + 1].box, p);
    descend(right_first ? node.right : index + 1, p, least);
    descend(right_first ? index + 1 : node.right, p, least);
}

double GradedSizes::smallest() const {
    return nodes_.empty() ? std::numeric_limits<double>::infinity() : nodes_.front().least;
}

double GradedSizes::packing_bound(double limit) const {
    double bound = 0;
    for (const FinePlace& place : places_) {  // ∫ 4/(s + 0.4 r)³ 4πr² dr as far as it is below the limit
        const double q = place.l_min / limit;
        bound += q < 1 ? 16 * std::numbers::pi / std::pow(gradation, 3) * (-std::log(q) + 2 * q - q * q / 2 - 1.5) : 0;
    }
    return std::ceil(bound);
}

std::vector<FinePlace> without_implied(std::vector<FinePlace> places) {
    const GradedSizes sizes(places);
    std::erase_if(places, [&](const FinePlace& place) {
        return sizes.at(place.position, std::numeric_limits<double>::infinity()) < place.l_min;
    });
    return places;
}

}  // namespace terratet
