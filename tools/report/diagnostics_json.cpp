// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report/diagnostics_json.hpp"

#include <nlohmann/json.hpp>

#include "tools/options/field_names.hpp"
#include "tools/report/rejection_kinds.hpp"

namespace terratet::tools {

using Json = nlohmann::ordered_json;

Json rejected_json(const Diagnostics& diagnostics) {
    Json rejected = Json::array();
    for (const auto& record : diagnostics.rejected) {
        rejected.push_back({{"file", record.file}, {"line", record.line}, {"reason", with_options(record.reason)}});
    }
    return rejected;
}

Json rejected_by_reason_json(const Diagnostics& diagnostics) {
    Json reasons = Json::array();
    for (const auto& [first, count] : rejection_kinds(diagnostics.rejected)) {
        reasons.push_back({{"file", first.file},
                           {"count", count},
                           {"first_line", first.line},
                           {"first", with_options(first.reason)}});
    }
    return reasons;
}

Json notes_json(const Diagnostics& diagnostics) {
    Json notes = Json::array();
    for (const auto& note : diagnostics.notes) {
        notes.push_back(with_options(note));
    }
    return notes;
}

}  // namespace terratet::tools
