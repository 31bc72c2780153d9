// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/residual.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

namespace {

/// Below it nothing else is asked of a cell: a field that bends leaves a little less at the centroid.
constexpr double small_ratio = 0.6;

/// What is asked of the one or two places of a cell, in tolerances, so that it holds at nearly all others (T1).
constexpr double margin = 0.65;

}  // namespace

ResidualTest::ResidualTest(const Criteria& criteria, const Frame& frame, std::span<const Property> properties,
                           const VertexValues& values, const ValueSource& source, const Samples& samples)
    : criteria_(criteria),
      frame_(frame),
      properties_(properties),
      values_(values),
      source_(source),
      samples_(samples),
      places_(samples.positions),
      active_(criteria.has_residual() && source) {}

ResidualTest::Question ResidualTest::at_centroid(std::size_t index, const JudgedCell& cell) const {
    const CellPoints& p = cell.points;
    return {index, 0.25 * (p[0] + p[1] + p[2] + p[3]), {0.25, 0.25, 0.25, 0.25}, false};
}

ResidualTest::Question ResidualTest::first(std::size_t index, const JudgedCell& cell) const {
    if (is_finite(cell.sphere.center)) {
        const Vec3 place = frame_.snapped(cell.sphere.center);
        const auto weights = weights_at(cell.points, place);
        if (std::ranges::all_of(weights, [](double w) { return w >= 0; })) {
            return {index, place, weights, true};
        }
    }
    return at_centroid(index, cell);
}

double ResidualTest::ratio(const JudgedCell& cell, const Question& question, const ValueBatch& batch,
                           std::size_t k) const {
    double worst = 0;
    for (std::size_t p = 0; p < criteria_.variation.size(); ++p) {
        const double tolerance = margin * criteria_.variation[p].residual;
        if (tolerance <= 0) {
            continue;
        }
        const double off = std::abs(to_scale(properties_[p], batch.values[p][k]) - linear(cell, question.weights, p));
        worst = off > worst * tolerance ? off / tolerance : worst;  // no value on either side calls for nothing
    }
    return worst;
}

double ResidualTest::linear(const JudgedCell& cell, const std::array<double, 4>& weights, std::size_t p) const {
    double sum = 0;
    for (std::size_t corner = 0; corner < 4; ++corner) {
        sum += weights[corner] * to_scale(properties_[p], values_.values[p][cell.vertices[corner]]);
    }
    return sum;
}

/// By how many tolerances the cell misses the worst of the samples in it.
double ResidualTest::missed(const JudgedCell& cell) {
    double worst = 0;
    places_.find(cell.points, inside_);
    for (const auto& [sample, weights] : inside_) {
        for (std::size_t p = 0; p < criteria_.variation.size(); ++p) {
            const double tolerance = criteria_.variation[p].tolerance;
            if (tolerance > 0) {
                const double off =
                    std::abs(to_scale(properties_[p], samples_.values[p][sample]) - linear(cell, weights, p));
                worst = off > worst * tolerance ? off / tolerance : worst;
            }
        }
    }
    return worst;
}

void ResidualTest::ask(std::span<const JudgedCell> cells, const std::vector<Question>& questions,
                       std::vector<Residual>& result) {
    if (questions.empty()) {
        return;
    }
    std::vector<ValueQuery> queries;
    queries.reserve(questions.size());
    for (const Question& question : questions) {
        queries.push_back({question.place, -1, 0});
    }
    const ValueBatch batch = source_(queries);
    asked_ += queries.size();
    for (std::size_t k = 0; k < questions.size(); ++k) {
        const Question& question = questions[k];
        Residual& residual = result[question.cell];
        residual.ratio = std::max(residual.ratio, ratio(cells[question.cell], question, batch, k));
        if (question.at_center) {
            Estimate& estimate = residual.at_center.emplace();
            estimate.place = question.place;
            estimate.extrapolation = batch.extrapolation[k];
            for (const auto& column : batch.values) {
                estimate.values.push_back(column[k]);
            }
        }
    }
}

std::vector<Residual> ResidualTest::of(std::span<const JudgedCell> cells) {
    std::vector<Residual> result(cells.size());
    std::vector<Question> questions;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        result[i].ratio = missed(cells[i]);
        if (result[i].ratio <= 1) {
            questions.push_back(first(i, cells[i]));
        }
    }
    ask(cells, questions, result);
    questions.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (result[i].at_center && result[i].ratio > small_ratio && result[i].ratio <= 1) {
            questions.push_back(at_centroid(i, cells[i]));
        }
    }
    ask(cells, questions, result);
    return result;
}

}  // namespace terratet
