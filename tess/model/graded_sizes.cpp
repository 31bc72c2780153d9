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

}  // namespace

GradedSizes::GradedSizes(std::span<const FinePlace> places)
    : tree_(
          {places.begin(), places.end()}, leaf_size,
          [](auto& node, const FinePlace& place) {
              node.box.extend(place.position);
              node.more.l_min = std::min(node.more.l_min, place.l_min);
          },
          [](const FinePlace& place, int axis) { return place.position[axis]; }) {}

double GradedSizes::at(const Vec3& p, double limit) const {
    double least = limit;
    const auto wanted = [&](const auto& node, double squared_distance) {
        const double room = (least - node.more.l_min) / gradation;
        return room > 0 && squared_distance < room * room;
    };
    tree_.near_first(p, wanted, [&](const FinePlace& place) {
        least = std::min(least, place.l_min + gradation * distance(place.position, p));
    });
    return least;
}

double GradedSizes::smallest() const {
    double least = std::numeric_limits<double>::infinity();
    for (const FinePlace& place : tree_.items()) {
        least = std::min(least, place.l_min);
    }
    return least;
}

double GradedSizes::packing_bound(double limit) const {
    double bound = 0;
    for (const FinePlace& place : tree_.items()) {  // ∫ 4/(s + 0.4 r)³ 4πr² dr as far as it is below the limit
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
