// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/kriging_system.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace terratet {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double pivot_min = 1e-12;       // of a correlation matrix's diagonal, 1
constexpr double rescue_nugget = 1e-8;    // for correlation matrices below it
constexpr double drift_pivot_min = 1e-9;  // of what the drift's other terms leave of one

/// The Cholesky factor of `a` in its lower triangle; false where a pivot is below `least` times the diagonal.
bool factor(Eigen::Ref<Matrix> a, double least) {
    const Vector diagonal = a.diagonal();
    const Eigen::LLT<Eigen::Ref<Matrix>> factored(a);
    return factored.info() == Eigen::Success && (a.diagonal().array().square() >= least * diagonal.array()).all();
}

}  // namespace

struct KrigingSystem::Impl {
    Variogram variogram;
    Drift drift;
    double structured;  ///< sill / (nugget + sill)
    std::vector<Vec3> places;
    Matrix lower;  ///< L of K = L·Lᵀ
    bool rescued = false;
    bool usable = false;
    // Kept from query to query for their memory.
    Matrix right;  ///< L⁻¹·[drift, k]
    Vector weights;

    Impl(const Variogram& v, Drift d)
        : variogram(v), drift(d), structured(v.nugget + v.sill > 0 ? v.sill / (v.nugget + v.sill) : 1) {}

    void fill(double nugget) {
        const auto n = static_cast<Eigen::Index>(places.size());
        lower.resize(n, n);
        for (Eigen::Index j = 0; j < n; ++j) {
            lower(j, j) = 1 + nugget;
            for (Eigen::Index i = j + 1; i < n; ++i) {
                lower(i, j) = structured * variogram.correlation(distance(places[static_cast<std::size_t>(i)],
                                                                          places[static_cast<std::size_t>(j)]));
            }
        }
    }

    /// With the first `terms` of 1, x, y, z as drift. False where the places don't determine them.
    bool solve(Eigen::Index terms, std::span<const Vec3> offsets, Result& result) {
        const auto n = static_cast<Eigen::Index>(places.size());
        double reach = 0;
        for (const Vec3& offset : offsets) {
            reach = std::max({reach, std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
        }
        right.col(0).setOnes();
        for (Eigen::Index term = 1; term < terms; ++term) {
            for (Eigen::Index i = 0; i < n; ++i) {
                right(i, term) = offsets[static_cast<std::size_t>(i)][static_cast<int>(term) - 1] / reach;
            }
        }
        const auto triangle = lower.triangularView<Eigen::Lower>();
        auto drifts = right.leftCols(terms);
        triangle.solveInPlace(drifts);
        const auto k = right.col(4);
        Matrix among = drifts.transpose() * drifts;
        if (!factor(among, drift_pivot_min)) {
            return false;
        }
        Vector multipliers = drifts.transpose() * k;
        result.mean_share = std::clamp(1 - multipliers(0), 0.0, 1.0);
        multipliers(0) -= 1;  // of the drift's terms at the query, only the constant is not 0

        among.triangularView<Eigen::Lower>().solveInPlace(multipliers);
        const double of_drift = multipliers.squaredNorm();
        among.transpose().triangularView<Eigen::Upper>().solveInPlace(multipliers);
        weights = k - drifts * multipliers;
        lower.transpose().triangularView<Eigen::Upper>().solveInPlace(weights);
        result.variance = std::max(1 - k.squaredNorm() + of_drift, 0.0);
        const double sum = weights.sum();
        weights /= sum;  // 1 but for rounding
        return std::abs(sum - 1) < 1e-6 && weights.allFinite() && std::isfinite(result.variance);
    }
};

KrigingSystem::KrigingSystem(const Variogram& variogram, Drift drift) : impl_(new Impl(variogram, drift)) {}

KrigingSystem::~KrigingSystem() = default;

void KrigingSystem::set_places(std::span<const Vec3> places) {
    impl_->places.assign(places.begin(), places.end());
    impl_->fill(0);
    impl_->rescued = false;
    impl_->usable = factor(impl_->lower, pivot_min);
    if (!impl_->usable) {
        impl_->fill(rescue_nugget);
        impl_->rescued = true;
        impl_->usable = factor(impl_->lower, 0);
    }
}

bool KrigingSystem::solve(const Vec3& query, std::span<const Vec3> offsets, std::vector<double>& weights,
                          Result& result) {
    Impl& m = *impl_;
    if (!m.usable) {
        return false;
    }
    const auto n = static_cast<Eigen::Index>(m.places.size());
    m.right.resize(n, 5);
    for (Eigen::Index i = 0; i < n; ++i) {
        m.right(i, 4) = m.structured * m.variogram.correlation(distance(m.places[static_cast<std::size_t>(i)], query));
    }
    auto k = m.right.col(4);
    m.lower.triangularView<Eigen::Lower>().solveInPlace(k);
    result.fallback = m.rescued;
    if (m.drift == Drift::constant || !m.solve(4, offsets, result)) {
        result.fallback = m.rescued || m.drift == Drift::linear;
        if (!m.solve(1, offsets, result)) {
            return false;
        }
    }
    weights.assign(m.weights.data(), m.weights.data() + n);
    return true;
}

std::vector<double> without_linear_trend(std::span<const Vec3> places, std::span<const double> values) {
    const auto n = static_cast<Eigen::Index>(places.size());
    Box3 box;
    for (const Vec3& p : places) {
        box.extend(p);
    }
    const double scale = std::max(box.diagonal(), std::numeric_limits<double>::min());
    Matrix design(n, 4);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Vec3 p = (places[static_cast<std::size_t>(i)] - box.center()) / scale;
        design.row(i) << 1, p.x, p.y, p.z;
    }
    const Eigen::Map<const Vector> given(values.data(), n);
    const Vector rest = given - design * design.completeOrthogonalDecomposition().solve(given);
    return {rest.data(), rest.data() + n};
}

}  // namespace terratet
