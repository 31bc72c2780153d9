// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/estimator.hpp"

namespace terratet {

std::shared_ptr<const Slopes> Estimator::slopes(std::vector<std::span<const double>>) const {
    return nullptr;
}

std::unique_ptr<const ChangedPlaces> Estimator::changes_since(const Estimator&, const ExchangedSites&, const Slopes*,
                                                              const Slopes*) const {
    return nullptr;
}

}  // namespace terratet
