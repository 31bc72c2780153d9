// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/estimator.hpp"

namespace terratet {

std::shared_ptr<const Slopes> Estimator::slopes(std::vector<std::span<const double>>) const {
    return nullptr;
}

}  // namespace terratet
