// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The residual criterion (DESIGN §4.1): how far a cell's linear field is from the estimator, in tolerances.
///
/// Asked at the circumcentre where that lies inside the cell, else at the centroid; where the circumcentre's answer is
/// neither small nor too large, at the centroid as well. So a cell's residual depends on its vertices alone (R6, R7),
/// and most cells cost one estimate; a circumcentre's serves the vertex that may come there. Samples that are no
/// vertices say what they measured, for nothing.

#include <optional>
#include <span>
#include <vector>

#include "tess/criteria.hpp"
#include "tess/frame.hpp"
#include "tess/property.hpp"
#include "tess/refine/insertion_rule.hpp"
#include "tess/refine/samples_in_cell.hpp"
#include "tess/samples.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// An estimate at a place.
struct Estimate {
    Vec3 place;
    std::vector<double> values;  ///< by property, in measured units
    double extrapolation = 0;
};

struct Residual {
    double ratio = 0;                   ///< the largest |estimate − linear field| over its tolerance; above 1: bad
    std::optional<Estimate> at_center;  ///< at the circumcentre, if it was asked there
};

class ResidualTest {
  public:
    /// All must outlive it. `values` are those of the cells' vertices, `samples` those that are no vertices.
    ResidualTest(const Criteria& criteria, const Frame& frame, std::span<const Property> properties,
                 const VertexValues& values, const ValueSource& source, const Samples& samples);

    [[nodiscard]] bool active() const { return active_; }

    /// One a cell. The source is asked twice at most.
    [[nodiscard]] std::vector<Residual> of(std::span<const JudgedCell> cells);

    /// So many places were asked for.
    [[nodiscard]] std::uint64_t asked() const { return asked_; }

  private:
    [[nodiscard]] double missed(const JudgedCell& cell);
    [[nodiscard]] double linear(const JudgedCell& cell, const std::array<double, 4>& weights, std::size_t p) const;

    struct Question {
        std::size_t cell;
        Vec3 place;
        std::array<double, 4> weights;
        bool at_center;
    };
    [[nodiscard]] Question at_centroid(std::size_t index, const JudgedCell& cell) const;
    [[nodiscard]] Question first(std::size_t index, const JudgedCell& cell) const;
    void ask(std::span<const JudgedCell> cells, const std::vector<Question>& questions, std::vector<Residual>& result);
    [[nodiscard]] double ratio(const JudgedCell& cell, const Question& question, const ValueBatch& batch,
                               std::size_t k) const;

    const Criteria& criteria_;
    const Frame& frame_;
    std::span<const Property> properties_;
    const VertexValues& values_;
    const ValueSource& source_;
    const Samples& samples_;
    SamplesInCell places_;
    std::vector<SamplesInCell::Inside> inside_;
    bool active_;
    std::uint64_t asked_ = 0;
};

}  // namespace terratet
