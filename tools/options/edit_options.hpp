// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The words of an edit: the same on the command line, in a script and in a live session.

#include <optional>
#include <string>
#include <vector>

#include "tools/options/site_options.hpp"

namespace terratet::tools {

struct EditArguments {
    std::vector<std::string> words;  ///< the verb and what it is about
    std::string by;
    std::string to;
    std::string box;
    std::optional<Length> l_min;
    std::optional<Length> l_max;
    SiteArguments site;
};

/// The verbs, for messages.
const std::vector<std::string>& edit_verbs();

std::vector<OptionGroup> edit_options(EditArguments& arguments);

/// From a list of words, as a script or a live session has them. Throws UsageError.
EditArguments parse_edit(const std::vector<std::string>& words);

}  // namespace terratet::tools
