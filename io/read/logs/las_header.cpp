// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/logs/las_header.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/logs/well_words.hpp"

namespace terratet {

namespace {

bool is_digit(std::string_view text, std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// The colon before the description: the first that is not amidst a time.
std::size_t description_colon(std::string_view text, std::size_t from) {
    for (std::size_t colon = text.find(':', from); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
        if (!(colon > 0 && is_digit(text, colon - 1) && is_digit(text, colon + 1))) {
            return colon;
        }
    }
    return std::string_view::npos;
}

/// Does the value hold what LAS 1.2 writes there, a description?
bool is_description(const std::string& value) {
    static constexpr std::array<std::string_view, 18> usual{
        "COMPANY", "WELL",         "FIELD",  "LOCATION", "PROVINCE", "SERVICECOMPANY",
        "LOGDATE", "UNIQUEWELLID", "WELLID", "WELLNAME", "COUNTRY",  "COUNTY",
        "STATE",   "APINUMBER",    "DATE",   "UWI",      "SERVICE",  "COMPANYNAME"};
    return std::ranges::find(usual, bare(value)) != usual.end();
}

/// LAS 1.2 has descriptions first in ~Well, but for these four.
bool value_comes_first(const std::string& mnemonic) {
    static constexpr std::array<std::string_view, 4> first{"STRT", "STOP", "STEP", "NULL"};
    return std::ranges::find(first, mnemonic) != first.end();
}

void take_version(LasHeader& header, const LasItem& item) {
    const std::string key = bare(item.mnemonic);
    if (key == "VERS") {
        header.version = item.value.substr(0, item.value.find_first_of(" \t"));
    } else if (key == "WRAP") {
        header.wrapped = bare(item.value).starts_with("Y");
    } else if (key == "DLM") {
        const std::string word = bare(item.value);
        header.delimiter = word.starts_with("COMMA") ? ',' : word.starts_with("TAB") ? '\t' : ' ';
        header.delimiter_said = !word.empty();
    }
}

void take_well(LasHeader& header, LasItem item) {
    const std::string key = bare(item.mnemonic);
    const bool old = header.version.starts_with("1");
    const bool number_first = old && parse_number(item.value) && !parse_number(item.description);
    if (is_description(item.value) || (old && !value_comes_first(key) && !number_first)) {
        std::swap(item.value, item.description);
    }
    const auto [known, added] = header.well.emplace(key, item);
    if (!added && known->second.value.empty()) {
        known->second = std::move(item);
    }
}

}  // namespace

LasItem las_item(std::string_view line, std::int64_t number) {
    LasItem item;
    item.line = number;
    std::string_view text = trimmed(line);
    const std::size_t colon = description_colon(text, 0);
    const std::string_view head = text.substr(0, colon);
    if (head.starts_with('.') && head.find('.', 1) != std::string_view::npos) {
        text.remove_prefix(1);  // ".ILM .OHMM"
        return las_item(text, number);
    }
    std::size_t dot = head.find('.');
    if (const std::size_t two = head.find(".."); two != std::string_view::npos && !is_digit(head, two + 2)) {
        dot = two + 1;  // "Cond..MS/M", but not "DEPT..1IN"
    }
    if (dot == std::string_view::npos) {
        item.mnemonic = to_utf8(trimmed(head));
    } else {
        item.mnemonic = to_utf8(trimmed(head.substr(0, dot)));
        std::string_view rest = head.substr(dot + 1);
        const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
        std::string_view unit = rest.substr(0, end);
        rest.remove_prefix(end);
        if (unit.empty() && metres_in_log_unit(rest) > 0) {
            unit = trimmed(rest);  // "MD. M"
            rest = {};
        }
        item.unit = to_utf8(unit);
        item.value = to_utf8(trimmed(rest));
    }
    std::erase_if(item.unit, [](char c) { return c == '[' || c == ']'; });
    if (colon != std::string_view::npos) {
        item.description = to_utf8(trimmed(text.substr(colon + 1)));
    }
    return item;
}

const LasItem* LasHeader::find(std::initializer_list<const char*> mnemonics) const {
    const auto null = well.find("NULL");
    const auto no_value = null == well.end() ? std::nullopt : parse_number(null->second.value);
    for (const char* mnemonic : mnemonics) {
        for (const auto* section : {&well, &parameters}) {
            const auto found = section->find(mnemonic);
            if (found == section->end() || log_cell(found->second.value).empty()) {
                continue;
            }
            const auto number = parse_number(found->second.value);
            if (!(number && (number == no_value || number == -999.25))) {
                return &found->second;
            }
        }
    }
    return nullptr;
}

LasSection las_section(std::string_view title) {
    LasSection section;
    std::string_view text = trimmed(title.substr(1));
    const std::size_t bar = text.find('|');
    if (bar != std::string_view::npos) {
        section.definition = bare(text.substr(bar + 1));
    }
    std::string_view first = text.substr(0, bar);
    const std::string_view words = first;
    section.name = bare(next_word(first));
    const auto strip = [](std::string& name, std::string_view tail) {
        const bool has = name.size() > tail.size() && name.ends_with(tail);
        name.resize(name.size() - (has ? tail.size() : 0));
        return has;
    };
    const std::string whole = bare(words.substr(0, words.find('[')));  // "~Core_Data[1]"
    section.name = bar != std::string_view::npos ? whole : section.name;
    strip(section.definition, "DEFINITION");
    using Kind = LasSection::Kind;
    if (bar != std::string_view::npos) {
        section.kind = Kind::data;
        strip(section.name, "DATA");
    } else if (strip(section.name, "DEFINITION")) {
        section.kind = section.name == "LOG" ? Kind::curves : Kind::definition;
    } else if (strip(section.name, "PARAMETER")) {
        section.kind = section.name == "LOG" ? Kind::parameters : Kind::other;
    } else {
        switch (section.name.empty() ? ' ' : section.name.front()) {
            case 'V':
                section.kind = Kind::version;
                break;
            case 'W':
                section.kind = Kind::well;
                break;
            case 'C':
                section.kind = Kind::curves;
                break;
            case 'P':
                section.kind = Kind::parameters;
                break;
            case 'A':
                section.kind = Kind::data;
                section.name = "LOG";
                for (std::string_view word = next_word(first); !word.empty(); word = next_word(first)) {
                    section.titles.push_back(to_utf8(word));
                }
                break;
            default:
                if (strip(section.name, "DATA")) {
                    section.kind = Kind::data;
                }
                break;
        }
    }
    if (section.kind == Kind::data && (section.definition == "CURVE" || section.definition.starts_with("CURVEINFO"))) {
        section.name = section.definition = "LOG";  // "~ASCII | CURVE"
    }
    if (section.kind == Kind::data && section.definition.empty()) {
        section.definition = section.name;
    }
    return section;
}

void add_las_line(LasHeader& header, const LasSection& section, std::string_view line, std::int64_t number) {
    using Kind = LasSection::Kind;
    LasItem item = las_item(line, number);
    switch (section.kind) {
        case Kind::version:
            take_version(header, item);
            break;
        case Kind::well:
            take_well(header, std::move(item));
            break;
        case Kind::parameters: {
            std::string key = bare(item.mnemonic);
            const auto [known, added] = header.parameters.emplace(std::move(key), item);
            if (!added && known->second.value.empty()) {
                known->second = std::move(item);
            }
            break;
        }
        case Kind::curves:
            header.curves.push_back(std::move(item));
            break;
        case Kind::definition:
            header.definitions[section.name].push_back(std::move(item));
            break;
        case Kind::data:
        case Kind::other:
            break;
    }
}

}  // namespace terratet
