// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fidelity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "tess/barrier/query/own_side.hpp"
#include "tess/mesh/mesh_walk.hpp"

namespace terratet {
namespace {

/// The sides as each property sees them: horizons part some properties and not others.
class PropertySides {
  public:
    PropertySides(const Model& model, const TetMesh& mesh, std::span<const std::int32_t> gap,
                  const BarrierQuery& barriers)
        : soft_(mesh, gap, barriers, model.domain.extent) {
        for (std::size_t property = 0; property < model.properties.size(); ++property) {
            const BarrierQuery& seen = barriers.seen_by(property);
            if (&seen != &barriers && !hard_) {
                hard_ = std::make_unique<const OwnSide>(mesh, gap, seen, model.domain.extent);
            }
            of_.push_back(&seen != &barriers ? hard_.get() : &soft_);
        }
    }
    [[nodiscard]] const OwnSide& of(std::size_t property) const { return *of_[property]; }

  private:
    OwnSide soft_;
    std::unique_ptr<const OwnSide> hard_;
    std::vector<const OwnSide*> of_;
};

/// In the property's scale; NaN where the field has no value.
double field_at(const Model& model, std::size_t property, const VertexWeights& own) {
    const Property& kind = model.properties[property];
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) {
        values[k] = to_scale(kind, model.vertex_values.values[property][own.vertices[k]]);
    }
    return mixed(own.weights, values, kind.kind == Kind::categorical);
}

/// Of each sample, as what the tessellation has of it; kept ones may be missed beside barriers alone.
std::vector<MissReason> miss_reasons(const Model& model, const BarrierQuery& barriers) {
    std::vector<char> kept(model.samples.size(), 0);
    for (const Vertex& vertex : model.vertices) {
        if (vertex.role == Role::sample) {
            kept[static_cast<std::size_t>(vertex.owner)] = 1;
        }
    }
    std::vector<MissReason> reasons(model.samples.size(), MissReason::near_fault);
    for (std::size_t i = 0; i < reasons.size(); ++i) {
        const Vec3& p = model.samples.positions[i];
        if (!model.domain.extent.contains(p)) {
            reasons[i] = MissReason::outside;
        } else if (kept[i] == 0 && barriers.protecting_barrier(p) < 0) {
            reasons[i] = MissReason::too_close;
        }
    }
    return reasons;
}

/// Errors of one property as they come.
class Tally {
  public:
    Tally(const Model& model, std::size_t property, std::span<const MissReason> reasons)
        : property_(model.properties[property]), reasons_(reasons) {
        result_.tolerance =
            property < model.criteria.variation.size() ? model.criteria.variation[property].tolerance : 0;
    }

    void add(std::size_t sample, double measured, double value) {
        if (std::isnan(measured) || std::isnan(value)) {
            return;
        }
        const bool categorical = property_.kind == Kind::categorical;
        const double error = categorical ? (measured == value ? 0.0 : 1.0) : std::abs(value - measured);
        squares_ += error * error;
        result_.max = std::max(result_.max, error);
        ++result_.count;
        const double before = measured - mean_;  // Welford's way: no difference of large sums
        mean_ += before / static_cast<double>(result_.count);
        deviations_ += categorical ? 0 : before * (measured - mean_);
        if (result_.tolerance > 0 && error > result_.tolerance) {
            ++result_.beyond_tolerance;
            ++result_.reasons[reasons_[sample]];
        }
    }

    [[nodiscard]] Fidelity result() const {
        Fidelity done = result_;
        if (done.count > 0) {
            done.rms = std::sqrt(squares_ / static_cast<double>(done.count));
            done.sd = std::sqrt(deviations_ / static_cast<double>(done.count));
            const double rounding = static_cast<double>(done.count) * std::pow(1e-12 * mean_, 2);
            done.r2 = deviations_ > rounding ? 1 - squares_ / deviations_ : squares_ > rounding ? 0 : 1;
        }
        return done;
    }

  private:
    const Property& property_;
    std::span<const MissReason> reasons_;
    Fidelity result_;
    double squares_ = 0;
    double mean_ = 0;
    double deviations_ = 0;
};

}  // namespace

std::string to_string(MissReason reason) {
    constexpr const char* names[] = {"too_close", "near_fault", "outside"};
    return names[static_cast<std::size_t>(reason)];
}

std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh, std::span<const std::int32_t> gap,
                               const BarrierQuery& barriers) {
    const std::vector<MissReason> reasons = miss_reasons(model, barriers);
    std::vector<Tally> tallies;
    for (std::size_t property = 0; property < model.properties.size(); ++property) {
        tallies.emplace_back(model, property, reasons);
    }
    MeshWalk walk(mesh);
    const PropertySides sides(model, mesh, gap, barriers);
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        const Vec3& p = model.samples.positions[i];
        const auto position = model.domain.hull.contains(p) ? walk.locate(p) : std::nullopt;
        for (std::size_t property = 0; position && property < tallies.size(); ++property) {
            const double value = field_at(model, property, sides.of(property).at(position->cell, p, position->weights));
            tallies[property].add(i, to_scale(model.properties[property], model.samples.values[property][i]), value);
        }
    }
    std::vector<Fidelity> result;
    for (const Tally& tally : tallies) {
        result.push_back(tally.result());
    }
    return result;
}

}  // namespace terratet
