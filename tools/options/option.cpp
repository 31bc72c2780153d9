// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/option.hpp"

#include <iterator>
#include <utility>

#include "tools/options/text.hpp"

namespace terratet::tools {
namespace {

/// The number that holds if none is given; empty for 0 (off, or chosen) and for what stands for no number at all.
std::string default_number(const Target& target) {
    constexpr double no_number = 1e15;
    double number = 0;
    if (const auto* const* real = std::get_if<double*>(&target)) {
        number = **real;
    } else if (const auto* const* count = std::get_if<std::uint64_t*>(&target)) {
        number = static_cast<double>(**count);
    }
    return number > 0 && number < no_number ? short_number(number) : "";
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || c == '-';
}

/// Where the word stands by itself; npos: nowhere.
std::size_t find_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) {
            return at;
        }
    }
    return std::string::npos;
}

}  // namespace

bool is_switch(const Option& option) {
    return std::holds_alternative<bool*>(option.target);
}

bool is_repeatable(const Option& option) {
    const auto* parsed = std::get_if<Parsed>(&option.target);
    return std::holds_alternative<std::vector<std::string>*>(option.target) ||
           (parsed != nullptr && parsed->repeatable);
}

const std::vector<std::string>& words_of(const Option& option) {
    static const std::vector<std::string> none;
    const auto* parsed = std::get_if<Parsed>(&option.target);
    return parsed == nullptr ? none : parsed->words;
}

std::string help_text(const Option& option) {
    std::string text = option.help;
    if (const std::string number = default_number(option.target); !number.empty()) {
        return text + ". Default " + number;
    }
    const auto* parsed = std::get_if<Parsed>(&option.target);
    const std::size_t at = parsed == nullptr || parsed->standard.empty() || text.find("(default") != std::string::npos
                               ? std::string::npos
                               : find_word(text, parsed->standard);
    return at == std::string::npos ? text : text.insert(at + parsed->standard.size(), " (default)");
}

void append(Syntax& syntax, std::vector<OptionGroup> groups) {
    std::move(groups.begin(), groups.end(), std::back_inserter(syntax.groups));
}

std::string dashed(const std::string& name) {
    return (name.size() == 1 ? "-" : "--") + name;
}

}  // namespace terratet::tools
