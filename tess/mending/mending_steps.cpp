// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mending/mending_steps.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tess/base/tetrahedron.hpp"

namespace terratet {
namespace {

using Cell = MendableMesh::Cell;

constexpr double better = 1.05;      ///< goodness of the worst cell after a change over that before
constexpr double least_gain = 0.05;  ///< of all together, over the burden of the cell that the change is for
constexpr double good = 0.1;         ///< goodness: 18°
constexpr double sharpest = 1e-16;   ///< goodness
constexpr std::size_t max_ring = 7;  ///< cells round an edge that is taken out
constexpr double off_surface = 0.2;  ///< a kept facet moves no farther, over the least edge
constexpr double turned = 0.7;       ///< cosine: nor does it turn farther
constexpr double first_step = 0.3;   ///< of a moving point, over its star's mean edge
constexpr double last_step = 0.02;

/// What a bad cell weighs: about the cube of 18° over its angle.
double burden(double goodness) {
    const double times = good / std::max(goodness, sharpest);
    return times > 1 ? times * std::sqrt(times) - 1 : 0;
}

/// Looks for the best change at one cell.
class Search {
  public:
    Search(MendableStars& stars, std::uint32_t cell) : stars_(stars), cell_(cell) {}

    std::optional<MendingStep> run(MendingAim aim) {
        const Corners v = stars_.cell(cell_).corners;
        aim_ = aim;
        least_ = least_gain * burden(stars_.goodness(cell_));
        for (const auto& [i, j] : cell_edges) {
            contract(v[i], v[j]);
            contract(v[j], v[i]);
            take_out_edge(v[i], v[j]);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            take_out_facet(k);
        }
        for (const std::uint32_t corner : v) {
            move(corner);
        }
        return std::move(best_);
    }

    std::optional<MendingStep> shorten(double enough) {
        shortening_ = true;
        enough_ = enough;
        const Corners v = stars_.cell(cell_).corners;
        const double least = stars_.mesh().least_edge * stars_.mesh().least_edge;
        for (const auto& [i, j] : cell_edges) {
            if (squared_distance(stars_.point(v[i]), stars_.point(v[j])) < least) {
                contract(v[i], v[j]);
                contract(v[j], v[i]);
            }
        }
        return std::move(best_);
    }

  private:
    [[nodiscard]] double start() const { return aim_ == MendingAim::worst ? 1 : 0; }
    [[nodiscard]] double add(double score, double goodness) const {
        return aim_ == MendingAim::worst ? std::min(score, goodness) : score - burden(goodness);
    }
    [[nodiscard]] double score_of(const std::vector<std::uint32_t>& cells) const {
        double score = start();
        for (const std::uint32_t c : cells) {
            score = add(score, stars_.goodness(c));
        }
        return score;
    }

    /// The score that a change must exceed. Where all that is wanted is that points meet, no cell may get worse than
    /// the worst, or than `enough_`.
    [[nodiscard]] double floor(double before) const {
        if (aim_ == MendingAim::together) {
            return before + (best_ ? best_->by : least_);
        }
        const double least = shortening_ ? std::nextafter(std::min(before, enough_), -2.0) : better * before;
        return best_ ? std::max(least, best_->by) : least;
    }
    /// What a cell alone must exceed where the score is the worst cell's.
    [[nodiscard]] double cell_floor(double floor) const { return aim_ == MendingAim::worst ? floor : -2; }
    [[nodiscard]] double ranked(double before, double after) const {
        return aim_ == MendingAim::together ? after - before : after;
    }

    /// Keeps the change if it is the best so far.
    void offer(MendingStep change) {
        const double before = score_of(change.old);
        const double least = floor(before);
        double after = start();
        for (const Cell& cell : change.fresh) {
            const double there = stars_.goodness(cell, cell_floor(least));
            after = add(after, there);
            if (after <= least || there < 0 || (there == 0 && aim_ == MendingAim::together)) {
                return;
            }
        }
        if (fits(change)) {
            change.by = ranked(before, after);
            best_ = std::move(change);
        }
    }

    /// No facet of three cells: where cells are flat to rounding, places do not tell.
    [[nodiscard]] bool fits(const MendingStep& change) const {
        return std::ranges::all_of(change.fresh, [&](const Cell& cell) {
            return std::ranges::all_of(facet_corners, [&](const auto& o) {
                const std::array facet{cell.corners[o[0]], cell.corners[o[1]], cell.corners[o[2]]};
                const auto has_it = [&](const Cell& other) {
                    return std::ranges::all_of(facet, [&](std::uint32_t v) { return MendableStars::has(other, v); });
                };
                const auto stay = std::ranges::count_if(stars_.star(facet[0]), [&](std::uint32_t c) {
                    return has_it(stars_.cell(c)) && std::ranges::find(change.old, c) == change.old.end();
                });
                return stay + std::ranges::count_if(change.fresh, has_it) <= 2;
            });
        });
    }

    /// Can a, alone or with what else is at its place, go to b? Then which of the points at b's place each goes to.
    [[nodiscard]] std::vector<std::uint32_t> goals(const std::vector<std::uint32_t>& from, std::uint32_t b) {
        const std::vector<std::uint32_t> at = stars_.at_place_of(b);
        std::vector<std::uint32_t> result;
        for (const std::uint32_t a : from) {
            std::set<std::uint32_t> met;
            for (const std::uint32_t c : stars_.star(a)) {
                std::ranges::copy_if(at, std::inserter(met, met.end()),
                                     [&](std::uint32_t v) { return MendableStars::has(stars_.cell(c), v); });
            }
            if (met.size() != 1) {
                return {};
            }
            result.push_back(*met.begin());
        }
        return result;
    }

    /// Is the edge one of a kept facet, and do the kept facets at a hardly move when a goes to b?
    [[nodiscard]] bool stays_on_surface(std::uint32_t a, std::uint32_t b) const {
        bool along = false;
        for (const std::uint32_t c : stars_.star(a)) {
            const Cell& cell = stars_.cell(c);
            for (std::size_t k = 0; k < 4; ++k) {
                if (cell.corners[k] == a || !stars_.is_kept(c, k)) {
                    continue;
                }
                std::array<Vec3, 3> before{};
                std::array<Vec3, 3> after{};
                bool has_b = false;
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint32_t v = cell.corners[facet_corners[k][i]];
                    before[i] = stars_.point(v);
                    after[i] = v == a ? stars_.point(b) : before[i];
                    has_b |= v == b;
                }
                along |= has_b;
                if (has_b) {
                    continue;
                }
                const Vec3 n = cross(before[1] - before[0], before[2] - before[0]);
                const Vec3 m = cross(after[1] - after[0], after[2] - after[0]);
                const double off = std::abs(dot(n, stars_.point(b) - stars_.point(a)));
                if (off > off_surface * stars_.mesh().least_edge * length(n) ||
                    dot(n, m) < turned * length(n) * length(m)) {
                    return false;
                }
            }
        }
        return along;
    }

    void contract(std::uint32_t a, std::uint32_t b) {
        const MendableMesh::Hold hold = stars_.mesh().hold[a];
        const bool onto_face = stars_.faces(a) == 0 && stars_.faces(b) != 0;
        if (hold == MendableMesh::Hold::fixed ||
            (hold == MendableMesh::Hold::surface && !(onto_face && stars_.on_kept(a))) ||
            (stars_.faces(a) & ~stars_.faces(b)) != 0) {
            return;
        }
        const std::vector<std::uint32_t> from = stars_.at_place_of(a);
        const std::vector<std::uint32_t> to = goals(from, b);
        if (to.empty()) {
            return;
        }
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (stars_.on_kept(from[i]) && !stays_on_surface(from[i], to[i])) {
                return;
            }
        }
        MendingStep change;
        for (std::size_t i = 0; i < from.size(); ++i) {
            for (const std::uint32_t c : stars_.star(from[i])) {
                change.old.push_back(c);
                if (!MendableStars::has(stars_.cell(c), to[i])) {
                    change.fresh.push_back(stars_.cell(c));
                    std::ranges::replace(change.fresh.back().corners, from[i], to[i]);
                }
            }
        }
        offer(std::move(change));
    }

    [[nodiscard]] bool has_wall_at(std::uint32_t c, std::uint32_t a, std::uint32_t b) const {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t opposite = stars_.cell(c).corners[k];
            if (opposite != a && opposite != b && stars_.is_wall(c, k)) {
                return true;
            }
        }
        return false;
    }

    /// Points round the edge from a to b in order, seen from b anticlockwise; on a face of the box from end to end.
    /// Empty where it has to stay.
    [[nodiscard]] std::vector<std::uint32_t> ring(std::uint32_t a, std::uint32_t b,
                                                  const std::vector<std::uint32_t>& cells) const {
        std::vector<std::array<std::uint32_t, 2>> links;
        for (const std::uint32_t c : cells) {
            if (stars_.cell(c).part != stars_.cell(cells[0]).part || has_wall_at(c, a, b)) {
                return {};
            }
            links.push_back(link_of(stars_.cell(c).corners, a, b));
        }
        const auto leads_to = [&](std::uint32_t v) {
            return std::ranges::find(links, v, [](const auto& link) { return link[1]; });
        };
        auto first = std::ranges::find_if(links, [&](const auto& link) { return leads_to(link[0]) == links.end(); });
        const bool open = first != links.end();
        std::vector<std::uint32_t> result{open ? (*first)[0] : links[0][0]};
        for (std::size_t i = 0; i < links.size(); ++i) {
            const auto next = std::ranges::find(links, result.back(), [](const auto& link) { return link[0]; });
            if (next == links.end()) {
                return {};
            }
            result.push_back((*next)[1]);
        }
        if (!open) {
            if (result.back() != result.front()) {
                return {};
            }
            result.pop_back();
            return result;
        }
        const auto mask =
            stars_.faces(a) & stars_.faces(b) & stars_.faces(result.front()) & stars_.faces(result.back());
        return mask != 0 ? result : std::vector<std::uint32_t>{};
    }

    /// The other two corners of a cell, p and q, so that a, b, p, q is positive.
    static std::array<std::uint32_t, 2> link_of(const Corners& v, std::uint32_t a, std::uint32_t b) {
        Corners order{a, b, 0, 0};
        std::size_t next = 2;
        for (const std::uint32_t corner : v) {
            if (corner != a && corner != b) {
                order[next++] = corner;
            }
        }
        const bool odd = is_odd_order(v, order);
        return odd ? std::array{order[3], order[2]} : std::array{order[2], order[3]};
    }

    [[nodiscard]] Cell like(const std::vector<std::uint32_t>& old, const Corners& corners) const {
        Cell cell = stars_.cell(old[0]);
        cell.corners = corners;
        for (const std::uint32_t c : old) {
            cell.parent = std::min(cell.parent, stars_.cell(c).parent);
        }
        return cell;
    }

    void take_out_edge(std::uint32_t a, std::uint32_t b) {
        MendingStep change;
        std::ranges::copy_if(stars_.star(a), std::back_inserter(change.old),
                             [&](std::uint32_t c) { return MendableStars::has(stars_.cell(c), b); });
        if (change.old.size() > max_ring) {
            return;
        }
        const std::vector<std::uint32_t> round = ring(a, b, change.old);
        if (round.size() < 3) {
            return;
        }
        for (std::size_t apex = 0; apex < (round.size() == 3 ? 1 : round.size()); ++apex) {
            change.fresh.clear();
            const auto at = [&](std::size_t k) { return round[(apex + k) % round.size()]; };
            for (std::size_t k = 1; k + 1 < round.size(); ++k) {
                change.fresh.push_back(like(change.old, {at(0), at(k), at(k + 1), b}));
                change.fresh.push_back(like(change.old, {at(k), at(0), at(k + 1), a}));
            }
            offer(change);
        }
    }

    void take_out_facet(std::size_t k) {
        const std::uint32_t other = stars_.beyond(cell_, k);
        const Corners& v = stars_.cell(cell_).corners;
        if (other == no_index || stars_.cell(other).part != stars_.cell(cell_).part || stars_.is_wall(cell_, k)) {
            return;
        }
        const std::array<std::uint32_t, 3> facet{v[facet_corners[k][0]], v[facet_corners[k][1]],
                                                 v[facet_corners[k][2]]};
        const auto apex = std::ranges::find_if(stars_.cell(other).corners, [&](std::uint32_t corner) {
            return std::ranges::find(facet, corner) == facet.end();
        });
        MendingStep change;
        change.old = {cell_, other};
        for (std::size_t i = 0; i < 3; ++i) {
            change.fresh.push_back(like(change.old, {v[k], *apex, facet[i], facet[(i + 1) % 3]}));
        }
        offer(std::move(change));
    }

    /// Along the axes that its faces leave free, and towards the middle of its neighbours, in ever smaller steps.
    void move(std::uint32_t v) {
        if (stars_.mesh().hold[v] != MendableMesh::Hold::free || stars_.on_kept(v)) {
            return;
        }
        const Vec3 start_place = stars_.point(v);
        MendingStep change;
        change.old = stars_.star(v);
        Vec3 sum;
        double edges = 0;
        double count = 0;
        for (const std::uint32_t c : change.old) {
            for (const std::uint32_t w : stars_.cell(c).corners) {
                if (w != v) {
                    sum = sum + stars_.point(w);
                    edges += distance(start_place, stars_.point(w));
                    ++count;
                }
            }
        }
        std::vector<Vec3> directions{sum / count - start_place};
        for (int axis = 0; axis < 3; ++axis) {
            if ((stars_.faces(v) >> (2 * axis) & 3) != 0) {
                directions[0][axis] = 0;
                continue;
            }
            Vec3 along;
            along[axis] = edges / count;
            directions.push_back(along);
            directions.push_back(-along);
        }
        // First those that most places fail at.
        std::ranges::stable_sort(change.old, {}, [&](std::uint32_t c) { return stars_.goodness(c); });
        const double before = score_of(change.old);
        double score = before;
        Vec3 at = start_place;
        for (double step = first_step; step > last_step; step /= 2) {
            for (const Vec3& direction : directions) {
                const Vec3 to = at + step * direction;
                const double there =
                    stars_.score_with(change.old, v, to, start(), score, cell_floor(score),
                                      [this](double so_far, double goodness) { return add(so_far, goodness); });
                if (there > score) {
                    score = there;
                    at = to;
                }
            }
        }
        if (score > floor(before)) {
            change.mover = v;
            change.to = at;
            change.by = ranked(before, score);
            best_ = std::move(change);
        }
    }

    MendableStars& stars_;
    std::uint32_t cell_;
    bool shortening_ = false;
    MendingAim aim_ = MendingAim::worst;
    double enough_ = 1;
    double least_ = 0;
    std::optional<MendingStep> best_;
};

}  // namespace

std::optional<MendingStep> best_change(MendableStars& stars, std::uint32_t cell, MendingAim aim) {
    return Search(stars, cell).run(aim);
}

std::optional<MendingStep> best_shortening(MendableStars& stars, std::uint32_t cell, double enough) {
    return Search(stars, cell).shorten(enough);
}

void make(MendableStars& stars, const MendingStep& change) {
    if (change.mover == no_index) {
        stars.apply(change.old, change.fresh);
    } else {
        stars.move(change.mover, change.to);
    }
}

}  // namespace terratet
