// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Properties over time. One tessellation serves all times: the property P at the time T is a property of its own,
/// named P@T.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// A time as names have it: the shortest text of a number, other text without colons (which part the words that
/// describe a property).
std::string time_label(std::string_view text);

/// Does the first come before the second? Numbers by their value and before words; dates as ISO 8601 has them are words
/// that sort.
bool time_before(const std::string& a, const std::string& b);

/// P@T.
std::string name_at(const std::string& property, const std::string& time);

/// The time in a name; empty: none.
std::string time_of(const std::string& name);

/// Of a label that begins as YYYY-MM-DD; nothing for another.
std::optional<double> days_since_1970(const std::string& label);

/// The name without its time; as it is where it has none.
std::string name_without_time(const std::string& name);

/// The times of a model's properties, ascending, each once; none: nothing changes.
std::vector<std::string> time_steps(const std::vector<Property>& properties);

/// The label of the step that a user names. Throws UsageError that lists the steps there are.
std::string require_time(const std::vector<Property>& properties, const std::string& time);

/// Which properties there are at a time: its own, and those without any.
std::vector<std::size_t> properties_at(const std::vector<Property>& properties, const std::string& time);

/// The model at a time: properties_at(), by their names without it. Copies all.
Model model_at(const Model& model, const std::string& time);

}  // namespace terratet
