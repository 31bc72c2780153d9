// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report/rejection_kinds.hpp"

#include <cctype>
#include <map>

namespace terratet::tools {
namespace {

/// A reason without what is in quotes, without words that hold a digit, and without the name of a hole.
std::string general(const std::string& reason) {
    std::string result;
    std::string word;
    bool named = false;
    const auto finish = [&](char end) {
        const bool number = word.find_first_of("0123456789'\"") != std::string::npos;
        result += number || named ? "*" : word;
        result += end;
        named = word == "hole";
        word.clear();
    };
    for (const char c : reason) {
        if (c == ' ' || c == ',' || c == ';' || c == ':') {
            finish(c);
        } else {
            word += c;
        }
    }
    finish('\0');
    return result;
}

}  // namespace

std::vector<RejectionKind> rejection_kinds(const std::vector<Rejected>& rejected) {
    std::vector<RejectionKind> kinds;
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    for (const Rejected& record : rejected) {
        const auto [entry, added] = known.emplace(std::pair(record.file, general(record.reason)), kinds.size());
        if (added) {
            kinds.push_back({record, 0});
        }
        ++kinds[entry->second].count;
    }
    return kinds;
}

}  // namespace terratet::tools
