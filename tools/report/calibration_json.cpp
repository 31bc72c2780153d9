// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report/calibration_json.hpp"

#include <nlohmann/json.hpp>

namespace terratet::tools {

nlohmann::ordered_json calibration_json(const Calibration& calibration) {
    using Json = nlohmann::ordered_json;
    if (calibration.samples == 0) {
        return {};
    }
    Json levels = Json::array();
    for (const auto& [estimate, relative] : calibration.levels) {
        levels.push_back({{"estimate", estimate}, {"relative", relative}});
    }
    return {{"factor_sd", calibration.factor_sd},
            {"factor_95", calibration.factor_95},
            {"levels", levels},
            {"boreholes", calibration.boreholes},
            {"samples", calibration.samples}};
}

}  // namespace terratet::tools
