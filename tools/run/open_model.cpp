// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/open_model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "interp/estimator_plan.hpp"
#include "interp/plan/model_source.hpp"
#include "io/model_store.hpp"
#include "tess/error.hpp"

namespace terratet::tools {

Option accept_edited_option(bool& accept_edited) {
    return {{"accept-edited"},
            "",
            "of a model that another program edited on purpose: verify all that check verifies instead of its digest",
            &accept_edited};
}

std::vector<Verdict> verdicts_on(const Model& model, const std::string& path, const Progress& progress,
                                 const VerifyOptions& options) {
    const auto factory = [plan = parse_estimator_plan(model.estimator)](const Model& of, const BarrierQuery& faults) {
        return make_model_source(of, faults, plan);
    };
    const auto history = load_history(path);
    const bool edited =
        std::ranges::any_of(history, [](const HistoryEntry& entry) { return entry.can_undo && !entry.undone; });
    return verify(model, factory, progress, edited, options);
}

Model open_model(const std::string& path, bool accept_edited, const Progress& progress, StoredState* state) {
    Model model = load_model(path, {.accept_edited = accept_edited}, state);
    if (accept_edited) {
        for (const Verdict& verdict : verdicts_on(model, path, progress)) {
            if (!verdict.holds) {
                throw InputError(fmt::format("{}: was edited, and does not keep {} any more: {}{}", path,
                                             verdict.guarantee, verdict.statement,
                                             verdict.detail.empty() ? "" : " (" + verdict.detail + ")"));
            }
        }
    }
    return model;
}

}  // namespace terratet::tools
