// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/matched_rows.hpp"

#include <algorithm>

namespace terratet {
namespace {

/// All that a barrier keeps off lies within.
Box3 zone_of(const Barrier& barrier) {
    Box3 box = bounding_box(barrier.sheet.vertices);
    for (const Vec3& p : barrier.margin.vertices) {
        box.extend(p);
    }
    for (const Seed& seed : barrier.seeds) {
        box.extend(seed.position);
    }
    return box.grown(barrier.protection_radius + barrier.spacing);
}

}  // namespace

std::vector<std::int64_t> matched_samples(const Samples& before, const Samples& after) {
    const std::size_t n = before.size();
    const std::size_t m = after.size();
    const std::size_t shorter = std::min(n, m);
    std::size_t head = 0;  // most edits change one part of the rows
    while (head < shorter && before.positions[head] == after.positions[head]) {
        ++head;
    }
    std::size_t tail = 0;
    while (tail < shorter - head && before.positions[n - 1 - tail] == after.positions[m - 1 - tail]) {
        ++tail;
    }
    std::vector<std::int64_t> match(n, -1);
    std::map<Vec3, std::int64_t> between;
    for (std::size_t i = head; i < m - tail; ++i) {
        between.emplace(after.positions[i], static_cast<std::int64_t>(i));
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (i < head) {
            match[i] = static_cast<std::int64_t>(i);
        } else if (i >= n - tail) {
            match[i] = static_cast<std::int64_t>(i + m - n);
        } else if (const auto found = between.find(before.positions[i]); found != between.end()) {
            match[i] = found->second;
        }
    }
    return match;
}

MatchedSeeds::MatchedSeeds(std::span<const Barrier> before, std::span<const Barrier> after)
    : next_of_(before.size(), -1) {
    std::vector<bool> same(after.size());
    for (std::size_t b = 0; b < before.size(); ++b) {
        for (std::size_t a = 0; a < after.size() && next_of_[b] < 0; ++a) {
            if (!same[a] && before[b] == after[a]) {
                same[a] = true;
                next_of_[b] = static_cast<std::int32_t>(a);
            }
        }
        if (next_of_[b] < 0) {
            old_zones_.push_back(zone_of(before[b]));
        }
    }
    for (std::size_t a = 0; a < after.size(); ++a) {
        if (same[a]) {
            continue;
        }
        new_zones_.push_back(zone_of(after[a]));
        for (const Seed& seed : after[a].seeds) {
            const auto owner = static_cast<std::int32_t>(a);
            at_.try_emplace(seed.position, owner, seed.side);
            coming_.push_back({seed.position, owner, seed.side});
        }
    }
}

std::int32_t MatchedSeeds::owner_after(const Vertex& seed) const {
    const std::int32_t next = next_of_[static_cast<std::size_t>(seed.owner)];
    if (next >= 0) {
        return next;
    }
    const auto found = at_.find(seed.position);
    return found != at_.end() && found->second.second == seed.side ? found->second.first : -1;
}

}  // namespace terratet
