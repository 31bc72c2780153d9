// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The header of a LAS file (CWLS LAS 1.2, 1992; 2.0, 1999; 3.0, 2000), as files have it rather than as the standard
/// has it: lasio's experience (https://lasio.readthedocs.io) in what to forgive.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// MNEM.UNIT  VALUE : DESCRIPTION.
struct LasItem {
    std::string mnemonic;
    std::string unit;
    std::string value;
    std::string description;
    std::int64_t line = 0;
};

/// A line of a header section. A dot before the mnemonic, dots within it (`Cond..MS/M`), a missing mnemonic, a time in
/// the value (12:30) are understood.
LasItem las_item(std::string_view line, std::int64_t number);

/// What the header says. Items of ~Well and ~Parameter by mnemonic (bare, upper case), the first of each that has a
/// value.
struct LasHeader {
    std::string version;  ///< "2.0"; empty: not said
    bool wrapped = false;
    char delimiter = ' ';  ///< ' ', ',' or '\t'
    bool delimiter_said = false;
    std::map<std::string, LasItem> well;
    std::map<std::string, LasItem> parameters;
    std::vector<LasItem> curves;                              ///< of the main log
    std::map<std::string, std::vector<LasItem>> definitions;  ///< LAS 3: of the section's data, by its bare name

    /// The value of the first of these mnemonics that has one other than the null value; empty: none.
    [[nodiscard]] const LasItem* find(std::initializer_list<const char*> mnemonics) const;
};

/// What a line that begins with ~ begins.
struct LasSection {
    enum class Kind { version, well, curves, parameters, definition, data, other };
    Kind kind = Kind::other;
    std::string name;                 ///< "LOG", "CORE", "TOPS", …: bare; "LOG" for ~A
    std::string definition;           ///< bare name after |, without DEFINITION
    std::vector<std::string> titles;  ///< words after ~A: names of columns in a file without ~Curve
};
LasSection las_section(std::string_view title);

/// Takes a line of a header section in.
void add_las_line(LasHeader& header, const LasSection& section, std::string_view line, std::int64_t number);

}  // namespace terratet
