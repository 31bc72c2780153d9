// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the verbs of an edit do to a model's plan.

#include "tess/change_model.hpp"
#include "tools/options/edit_options.hpp"

namespace terratet::tools {

/// Applies one verb. Notes and rejected records go to `diagnostics`. Throws UsageError for a verb or name there is none
/// of and words that do not fit, InputError for inputs that cannot be used; the plan then is as it was.
void apply_edit(const EditArguments& arguments, ModelPlan& plan, Diagnostics& diagnostics);

}  // namespace terratet::tools
