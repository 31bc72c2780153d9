// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Lists of names in messages, and which name was meant by one that is not among them.

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// "a, b, c", or "none"; of more than `most` the first so many and "…".
std::string listed(const std::vector<std::string>& names, std::size_t most = std::numeric_limits<std::size_t>::max());

/// What `name` gives of each item: a member, a function.
template <class Items, class Name>
std::vector<std::string> names_of(Items&& items, Name name) {
    std::vector<std::string> names;
    for (auto&& item : items) {
        names.emplace_back(std::invoke(name, item));
    }
    return names;
}

/// The candidate with the smallest edit distance to `word`, in whatever case (ties: the first), or nothing when none
/// comes near: more than a third of the letters differ.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// The end of a message on a word that is none of the names: "; did you mean b?", or nothing where none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace terratet
