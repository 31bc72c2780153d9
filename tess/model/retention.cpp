// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/model/retention.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tess/base/poll.hpp"
#include "tess/base/seed_tree.hpp"
#include "tess/mesh/mesh_walk.hpp"
#include "tess/model/density_edition.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

namespace {

/// Values of one property at all samples, in its scale, and what is made of the kept ones at each.
struct Column {
    std::size_t property;
    double tolerance;
    std::vector<double> measured;
    std::vector<double> field;

    [[nodiscard]] bool misses(std::uint32_t i) const {
        return !std::isnan(measured[i]) && !(std::abs(measured[i] - field[i]) <= tolerance);
    }
};

/// The kept samples' own tessellation, for loose ones.
class LooseField {
  public:
    LooseField(const Samples& samples, std::span<const std::uint32_t> kept, const Poll& poll)
        : kept_(kept.begin(), kept.end()) {
        std::vector<Vertex> vertices;
        for (const std::uint32_t i : kept_) {
            vertices.push_back({vertices.size(), samples.positions[i], Role::sample, static_cast<std::int32_t>(i), 0});
            points_.push_back(samples.positions[i]);
        }
        tessellation_.insert(vertices, poll);
        mesh_ = tessellation_.mesh();
        nearest_.emplace(points_);
        walk_.emplace(mesh_);
    }

    /// Linear in a cell whose corners have values, else the nearest one's.
    double at(const Vec3& p, const std::vector<double>& measured) {
        if (const auto position = mesh_.cells.empty() ? std::nullopt : walk_->locate(p)) {
            double sum = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                sum += position->weights[k] * measured[kept_[mesh_.cells[position->cell][k]]];
            }
            if (!std::isnan(sum)) {
                return sum;
            }
        }
        const std::uint32_t i = nearest_->nearest(p, std::numeric_limits<double>::infinity());
        return i == no_index ? missing : measured[kept_[i]];
    }

  private:
    std::vector<std::uint32_t> kept_;
    std::vector<Vec3> points_;
    Tessellation tessellation_;
    TetMesh mesh_;
    std::optional<SeedTree> nearest_;
    std::optional<MeshWalk> walk_;
};

class Retainer {
  public:
    Retainer(const Samples& samples, std::span<const Property> properties, std::span<const double> tolerance,
             std::span<const std::uint32_t> candidates, ResolutionField& resolution, double floor, const Poll& poll)
        : samples_(samples),
          properties_(properties),
          candidates_(candidates),
          resolution_(resolution),
          poll_(poll),
          l_min_(samples.size(), std::numeric_limits<double>::infinity()),
          limit_(samples.size(), floor),
          kept_(samples.size(), 0) {
        for (std::size_t p = 0; p < tolerance.size(); ++p) {
            if (tolerance[p] > 0) {
                columns_.push_back({p, tolerance[p], {}, std::vector<double>(samples.size(), missing)});
                for (const double value : samples.values[p]) {
                    columns_.back().measured.push_back(to_scale(properties[p], value));
                }
            }
        }
        split_into_holes(floor);
    }

    Retention run() {
        do {
            resolution_.set_fine(fine());
            keep();
            evaluate();
        } while (ask_for_more());
        Retention result{without_implied(fine()), std::vector<Agreement>(properties_.size())};
        resolution_.set_fine(result.fine);
        for (const Column& column : columns_) {
            result.agreement[column.property] = agreement(column);
        }
        return result;
    }

  private:
    using Chain = std::vector<std::uint32_t>;

    /// Candidates of one hole follow each other; loose ones come last.
    void split_into_holes(double floor) {
        for (const std::uint32_t i : candidates_) {
            const std::int32_t hole = samples_.borehole[i];
            if (hole < 0) {
                loose_.push_back(i);
                continue;
            }
            if (holes_.empty() || samples_.borehole[holes_.back().back()] != hole) {
                holes_.emplace_back();
            }
            holes_.back().push_back(i);
        }
        for (const Chain& hole : holes_) {
            for (std::size_t k = 0; k < hole.size(); ++k) {
                double next = std::numeric_limits<double>::infinity();
                for (const std::size_t other : {k - 1, k + 1}) {
                    if (other < hole.size()) {
                        next = std::min(next, distance(samples_.positions[hole[k]], samples_.positions[hole[other]]));
                    }
                }
                limit_[hole[k]] = std::isinf(next) ? floor : std::max(floor, next / 2);
            }
        }
    }

    [[nodiscard]] std::vector<FinePlace> fine() const {
        std::vector<FinePlace> places;
        for (const std::uint32_t i : candidates_) {
            if (!std::isinf(l_min_[i])) {
                places.push_back({samples_.positions[i], l_min_[i]});
            }
        }
        return places;
    }

    void keep() {
        std::ranges::fill(kept_, 0);
        kept_list_ = keep_in_order(samples_, candidates_, resolution_, poll_);
        for (const std::uint32_t i : kept_list_) {
            kept_[i] = 1;
        }
    }

    void evaluate() {
        ask(poll_);
        for (Column& column : columns_) {
            for (const Chain& hole : holes_) {
                evaluate_along(hole, column);
            }
        }
        if (loose_.empty()) {
            return;
        }
        LooseField field(samples_, kept_list_, poll_);
        for (Column& column : columns_) {
            for (const std::uint32_t i : loose_) {
                column.field[i] = kept_[i] != 0 ? column.measured[i] : field.at(samples_.positions[i], column.measured);
            }
        }
    }

    /// Linear between the kept ones that have a value, constant beyond the last.
    void evaluate_along(const Chain& hole, Column& column) const {
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        std::size_t before = none;
        const auto fill = [&](std::size_t begin, std::size_t end, std::size_t after) {
            for (std::size_t k = begin; k < end; ++k) {
                column.field[hole[k]] = between(column, hole, before, k, after);
            }
        };
        for (std::size_t k = 0; k < hole.size(); ++k) {
            if (kept_[hole[k]] != 0 && !std::isnan(column.measured[hole[k]])) {
                fill(before == none ? 0 : before + 1, k, k);
                column.field[hole[k]] = column.measured[hole[k]];
                before = k;
            }
        }
        fill(before == none ? 0 : before + 1, hole.size(), none);
    }

    [[nodiscard]] double between(const Column& column, const Chain& hole, std::size_t before, std::size_t k,
                                 std::size_t after) const {
        if (before >= hole.size() || after >= hole.size()) {
            const std::size_t only = std::min(before, after);
            return only < hole.size() ? column.measured[hole[only]] : missing;
        }
        const Vec3& p = samples_.positions[hole[k]];
        const double up = distance(p, samples_.positions[hole[before]]);
        const double down = distance(p, samples_.positions[hole[after]]);
        return (down * column.measured[hole[before]] + up * column.measured[hole[after]]) / (up + down);
    }

    /// False when no place may have a smaller l_min.
    bool ask_for_more() {
        bool more = false;
        for (const std::uint32_t i : candidates_) {
            if (kept_[i] == 0 && std::ranges::any_of(columns_, [&](const Column& c) { return c.misses(i); })) {
                const double has = resolution_.sample_l_min(samples_.positions[i]);
                const double wanted = std::max(has / 2, limit_[i]);
                if (wanted < has * (1 - 1e-9)) {
                    l_min_[i] = wanted;
                    more = true;
                }
            }
        }
        return more;
    }

    [[nodiscard]] Agreement agreement(const Column& column) const {
        const Property& property = properties_[column.property];
        std::vector<std::pair<double, double>> values;  // measured, field
        for (const std::uint32_t i : candidates_) {
            if (!std::isnan(column.measured[i]) && !std::isnan(column.field[i])) {
                values.emplace_back(column.measured[i], column.field[i]);
            }
        }
        double mean = 0;
        for (const auto& [measured, field] : values) {
            mean += measured / static_cast<double>(values.size());
        }
        double variance = 0;
        double squares = 0;
        for (const auto& [measured, field] : values) {
            variance += (measured - mean) * (measured - mean);
            squares += (measured - field) * (measured - field);
        }
        std::ranges::sort(values, std::greater());
        double rich_measured = 0;
        double rich_field = 0;
        for (std::size_t k = 0; k < (values.size() + 99) / 100; ++k) {
            rich_measured += from_scale(property, values[k].first);
            rich_field += from_scale(property, values[k].second);
        }
        return {variance > 0 ? 1 - squares / variance : 1, rich_measured != 0 ? rich_field / rich_measured : 1};
    }

    const Samples& samples_;
    std::span<const Property> properties_;
    std::span<const std::uint32_t> candidates_;
    ResolutionField& resolution_;
    const Poll& poll_;
    std::vector<Column> columns_;
    std::vector<Chain> holes_;
    Chain loose_;
    std::vector<double> l_min_;  ///< by sample, where asked for; infinity elsewhere
    std::vector<double> limit_;  ///< by sample, of that
    std::vector<char> kept_;
    std::vector<std::uint32_t> kept_list_;
};

}  // namespace

Retention retain(const Samples& samples, std::span<const Property> properties, std::span<const double> tolerance,
                 std::span<const std::uint32_t> candidates, ResolutionField& resolution, double floor,
                 const Poll& poll) {
    return Retainer(samples, properties, tolerance, candidates, resolution, floor, poll).run();
}

}  // namespace terratet
