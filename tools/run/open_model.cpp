// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/open_model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tess/error.hpp"

namespace terratet::tools {

Option accept_edited_option(bool& accept_edited) {
    return {{"accept-edited"},
            "",
            "of a model that another program edited on purpose: verify all that check verifies instead of its digest",
            &accept_edited};
}

std::vector<Verdict> verdicts_on(const LiveModel& live, const std::string& path, const Progress& progress,
                                 const VerifyOptions& options) {
    const auto history = load_history(path);
    const bool edited =
        std::ranges::any_of(history, [](const HistoryEntry& entry) { return entry.can_undo && !entry.undone; });
    return live.snapshot()->verify(edited, progress, options);
}

LiveModel open_model(const std::string& path, bool accept_edited, const Progress& progress, StoredState* state) {
    LiveModel live(load_model(path, {.accept_edited = accept_edited}, state));
    if (accept_edited) {
        for (const Verdict& verdict : verdicts_on(live, path, progress)) {
            if (!verdict.holds) {
                throw InputError(fmt::format("{}: was edited, and does not keep {} any more: {}{}", path,
                                             verdict.guarantee, verdict.statement,
                                             verdict.detail.empty() ? "" : " (" + verdict.detail + ")"));
            }
        }
    }
    return live;
}

}  // namespace terratet::tools
