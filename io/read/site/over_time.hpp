// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Logs and samples that were measured more than once.

#include <string>
#include <vector>

#include "io/read/read_positions.hpp"
#include "io/site_inputs.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

/// The column of times, which SiteInputs::columns has under "time"; empty: none. It is taken out of them: further
/// readers need not know.
std::string take_time_column(SiteInputs& inputs);

/// Values of all times at one place become one sample's, each time's a property of its own (io/base/time_steps.hpp);
/// properties that were asked for likewise. Notes the times. Tables without that column hold at all times. Throws
/// UsageError when no table has it, or more times than 1000.
void spread_over_time(const std::string& column, std::vector<Table>& logs, std::vector<PlacedTable>& samples,
                      SiteInputs& inputs, Diagnostics& diagnostics);

}  // namespace terratet
