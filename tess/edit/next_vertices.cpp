// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/next_vertices.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tess/base/point_grid.hpp"
#include "tess/base/poll.hpp"
#include "tess/edit/matched_rows.hpp"
#include "tess/edit/resolution_change.hpp"
#include "tess/model/resolution.hpp"

namespace terratet {
namespace {

double l_max_at(const ResolutionField& resolution, const Vec3& p) {
    return resolution.l_max({p, p, p, p});
}

double largest_l_max(const Criteria& criteria) {
    double largest = criteria.l_max;
    for (const ResolutionOverride& part : criteria.overrides) {
        largest = std::max(largest, part.l_max);
    }
    return largest;
}

bool in_any(const std::vector<Box3>& boxes, const Vec3& p) {
    return std::ranges::any_of(boxes, [&](const Box3& box) { return box.contains(p); });
}

class VertexChooser {
  public:
    VertexChooser(const Model& before, const Model& after, const BarrierQuery& barriers, const Poll& poll)
        : before_(before),
          after_(after),
          barriers_(barriers),
          go_on_(poll),
          old_resolution_(before.criteria, before.domain, before.barriers),
          resolution_(after.criteria, after.domain, after.barriers),
          resolution_change_(old_resolution_, resolution_, before, after),
          matched_samples_(matched_samples(before.samples, after.samples)),
          matched_seeds_(before.barriers, after.barriers),
          new_hull_(before.domain.hull != after.domain.hull),
          stays_(before.vertices.size(), true) {}

    NextVertices run() {
        find_leaving_seeds();
        find_leaving_samples();
        find_coming_samples();
        find_coming_seeds();
        find_leaving_box();
        find_leaving_inserted();
        add_box();
        for (std::size_t i = 0; i < stays_.size(); ++i) {
            if (!stays_[i]) {
                next_.out.push_back(before_.vertices[i].id);
            }
        }
        add_touched_boxes();
        return std::move(next_);
    }

  private:
    void leave(std::size_t i) {
        stays_[i] = false;
        gone_.push_back(before_.vertices[i].position);
        gone_box_.extend(gone_.back());
    }

    void stay(std::size_t i, std::int32_t owner) {
        Vertex vertex = before_.vertices[i];
        if (vertex.owner != owner) {
            vertex.owner = owner;
            next_.next.emplace_back(i, vertex);
        }
    }

    void come(const Vec3& position, Role role, std::int32_t owner, std::int8_t side) {
        if (after_.domain.hull.contains(position) && taken_.insert(position).second) {
            const std::uint64_t first = before_.vertices.empty() ? 0 : before_.vertices.back().id + 1;
            next_.in.push_back({first + next_.in.size(), position, role, owner, side});
            come_box_.extend(position);
        }
    }

    void find_leaving_seeds() {
        for (std::size_t i = 0; i < before_.vertices.size(); ++i) {
            const Vertex& vertex = before_.vertices[i];
            if (vertex.role != Role::seed) {
                continue;
            }
            if (const std::int32_t owner = matched_seeds_.owner_after(vertex); owner >= 0) {
                stay(i, owner);
            } else {
                leave(i);
                ++next_.counts.seeds_out;
            }
        }
    }

    /// By a barrier that was not there before.
    [[nodiscard]] bool newly_protected(const Vec3& p) const {
        return in_any(matched_seeds_.new_zones(), p) && barriers_.protecting_barrier(p) >= 0;
    }

    void find_leaving_samples() {
        kept_.assign(after_.samples.size(), false);
        std::vector<std::pair<std::uint32_t, std::size_t>> rethinned;  // sample, vertex
        for (std::size_t i = 0; i < before_.vertices.size(); ++i) {
            const Vertex& vertex = before_.vertices[i];
            if (vertex.role != Role::sample) {
                continue;
            }
            const std::int64_t sample = matched_samples_[static_cast<std::size_t>(vertex.owner)];
            if (sample < 0 || newly_protected(vertex.position)) {
                leave_as_sample(i);
                continue;
            }
            stay(i, static_cast<std::int32_t>(sample));
            kept_[static_cast<std::size_t>(sample)] = true;
            if (resolution_change_.coarser_at(vertex.position)) {
                rethinned.emplace_back(static_cast<std::uint32_t>(sample), i);
            }
        }
        thin(rethinned);
    }

    void leave_as_sample(std::size_t i) {
        leave(i);
        ++next_.counts.samples_out;
    }

    /// Where l_min has grown, the kept ones are thinned in their order, against those that are not asked.
    void thin(std::vector<std::pair<std::uint32_t, std::size_t>>& asked) {
        std::ranges::sort(asked);
        Box3 box;
        for (const auto& [sample, vertex] : asked) {
            kept_[sample] = false;
            box.extend(after_.samples.positions[sample]);
        }
        PointGrid kept = kept_within(box.grown(resolution_.largest_sample_l_min()));
        for (const auto& [sample, vertex] : asked) {
            const Vec3& p = after_.samples.positions[sample];
            kept_[sample] = !kept.any_within(p, resolution_.sample_l_min(p));
            if (kept_[sample]) {
                kept.insert(p);
            } else {
                std::erase_if(next_.next, [&, i = vertex](const auto& entry) { return entry.first == i; });
                leave_as_sample(vertex);
            }
        }
    }

    [[nodiscard]] PointGrid kept_within(const Box3& box) const {
        PointGrid kept(resolution_.largest_sample_l_min());
        for (std::size_t i = 0; i < kept_.size(); ++i) {
            if (kept_[i] && box.contains(after_.samples.positions[i])) {
                kept.insert(after_.samples.positions[i]);
            }
        }
        return kept;
    }

    /// Samples that may find room now: new ones, and those near what has left or changed.
    void find_coming_samples() {
        std::vector<bool> is_new(after_.samples.size(), true);
        for (const std::int64_t sample : matched_samples_) {
            if (sample >= 0) {
                is_new[static_cast<std::size_t>(sample)] = false;
            }
        }
        std::vector<Box3> around = matched_seeds_.old_zones();
        around.push_back(gone_box_.grown(resolution_.largest_l_min()));
        around.insert(around.end(), resolution_change_.boxes().begin(), resolution_change_.boxes().end());
        std::vector<std::uint32_t> asked;
        Box3 box;
        for (std::uint32_t i = 0; i < after_.samples.size(); ++i) {
            const Vec3& p = after_.samples.positions[i];
            if (!after_.domain.extent.contains(p)) {
                next_.counts.outside_extent += is_new[i] ? 1 : 0;
                continue;
            }
            if (!kept_[i] && (is_new[i] || in_any(around, p))) {
                asked.push_back(i);
                box.extend(p);
            }
        }
        PointGrid kept = kept_within(box.grown(resolution_.largest_sample_l_min()));
        for (const std::uint32_t i : asked) {
            go_on_();
            const Vec3& p = after_.samples.positions[i];
            if (barriers_.protecting_barrier(p) < 0 && !kept.any_within(p, resolution_.sample_l_min(p))) {
                kept.insert(p);
                kept_[i] = true;
                come(p, Role::sample, static_cast<std::int32_t>(i), 0);
            }
        }
        next_.counts.samples_in = next_.in.size();
    }

    void find_coming_seeds() {
        const std::size_t others = next_.in.size();
        std::set<Vec3> standing;  // of other barriers, which stay
        for (std::size_t i = 0; i < stays_.size(); ++i) {
            if (stays_[i] && before_.vertices[i].role == Role::seed) {
                standing.insert(before_.vertices[i].position);
            }
        }
        for (const auto& [position, owner, side] : matched_seeds_.coming()) {
            if (!standing.contains(position)) {
                come(position, Role::seed, owner, side);
            }
        }
        next_.counts.seeds_in = next_.in.size() - others;
    }

    void find_leaving_box() {
        for (std::size_t i = 0; i < before_.vertices.size(); ++i) {
            if (before_.vertices[i].role == Role::domain &&
                (new_hull_ || taken_.contains(before_.vertices[i].position))) {
                leave(i);
            }
        }
    }

    /// Those within l_max of what left, which called for them; those too near to what comes; those that a barrier keeps
    /// off; all where the resolution got coarser.
    void find_leaving_inserted() {
        const double widest = std::max(largest_l_max(before_.criteria), largest_l_max(after_.criteria));
        PointGrid gone(widest);
        for (const Vec3& p : gone_) {
            gone.insert(p);
        }
        PointGrid coming(resolution_.largest_l_min());
        for (const Vertex& vertex : next_.in) {
            coming.insert(vertex.position);
        }
        const Box3 near_gone = gone_box_.grown(widest);
        const Box3 near_coming = come_box_.grown(resolution_.largest_l_min());
        for (std::size_t i = 0; i < before_.vertices.size(); ++i) {
            const Vertex& vertex = before_.vertices[i];
            if (vertex.role != Role::inserted) {
                continue;
            }
            const Vec3& p = vertex.position;
            if ((near_gone.contains(p) && gone.any_within(p, l_max_at(resolution_, p))) ||
                (near_coming.contains(p) && coming.any_within(p, resolution_.l_min(p))) || newly_protected(p) ||
                resolution_change_.coarser_at(p)) {
                stays_[i] = false;
                touched_box_.extend(p);
                ++next_.counts.inserted_out;
            }
        }
    }

    /// A grid on the faces of a new hull box; else the corners, which must be there.
    void add_box() {
        if (new_hull_) {
            std::vector<Vec3> obstacles;
            for (std::size_t i = 0; i < stays_.size(); ++i) {
                if (stays_[i]) {
                    obstacles.push_back(before_.vertices[i].position);
                }
            }
            for (const Vertex& vertex : next_.in) {
                obstacles.push_back(vertex.position);
            }
            for (const Vec3& p : face_grid(after_.domain.hull, after_.criteria.l_min, longest_on_faces(after_.criteria),
                                           obstacles, after_.frame, {})) {
                come(p, Role::domain, -1, 0);
            }
            return;
        }
        const Box3& hull = after_.domain.hull;
        for (const Vec3& p : gone_) {
            const auto at_end = [&](int axis) { return p[axis] == hull.lo[axis] || p[axis] == hull.hi[axis]; };
            if (at_end(0) && at_end(1) && at_end(2)) {
                come(p, Role::domain, -1, 0);
            }
        }
    }

    void add_touched_boxes() {
        std::vector<Box3>& boxes = next_.boxes;
        boxes = resolution_change_.boxes();
        for (const auto* zones : {&matched_seeds_.old_zones(), &matched_seeds_.new_zones()}) {
            boxes.insert(boxes.end(), zones->begin(), zones->end());
        }
        for (const Vec3& p : gone_) {
            touched_box_.extend(p);
        }
        if (!touched_box_.empty()) {
            boxes.push_back(touched_box_);
        }
        if (new_hull_) {
            boxes.assign(1, after_.domain.hull);
        }
        const Box3& hull = after_.domain.hull;
        std::erase_if(boxes, [](const Box3& box) { return box.empty(); });
        // A vertex in a cell's sphere may have been refused for what is near its projection onto the hull box.
        const double reach = 2 * resolution_.largest_l_min();
        for (Box3& box : boxes) {
            const Box3 near = box.grown(reach);
            box = {hull.clamped(near.lo), hull.clamped(near.hi)};
        }
    }

    const Model& before_;
    const Model& after_;
    const BarrierQuery& barriers_;
    PatientPoll go_on_;
    ResolutionField old_resolution_;
    ResolutionField resolution_;
    ResolutionChange resolution_change_;
    std::vector<std::int64_t> matched_samples_;
    MatchedSeeds matched_seeds_;
    bool new_hull_;
    std::vector<bool> stays_;  ///< by vertex of before
    std::vector<bool> kept_;   ///< by sample of after
    std::vector<Vec3> gone_;   ///< places of samples, seeds and box vertices that leave
    Box3 gone_box_;
    Box3 come_box_;
    Box3 touched_box_;
    std::set<Vec3> taken_;
    NextVertices next_;
};

}  // namespace

NextVertices next_vertices(const Model& before, const Model& after, const BarrierQuery& barriers, const Poll& poll) {
    return VertexChooser(before, after, barriers, poll).run();
}

}  // namespace terratet
