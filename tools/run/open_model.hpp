// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How every command opens a stored model.

#include <string>
#include <vector>

#include "interp/live_model.hpp"
#include "io/model_store.hpp"
#include "tess/progress.hpp"
#include "tess/verify.hpp"
#include "tools/options/option.hpp"

namespace terratet::tools {

/// --accept-edited, for all commands that open a model.
Option accept_edited_option(bool& accept_edited);

/// Loads the model. One that was edited is verified instead of told by its digest. Throws InputError as load_model
/// does, and naming what does not hold.
LiveModel open_model(const std::string& path, bool accept_edited, const Progress& progress = {},
                     StoredState* state = nullptr);

/// Each guarantee. \param path  where its journal tells whether edits stand
std::vector<Verdict> verdicts_on(const LiveModel& live, const std::string& path, const Progress& progress,
                                 const VerifyOptions& options = {});

}  // namespace terratet::tools
