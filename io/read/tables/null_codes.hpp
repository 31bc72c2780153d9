// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers that stand for "no value", and numbers that stand far from all others.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// A usual code of the trade: -99, -999, -999.25, -9999 and their kin, 9999.25, 99999 and longer, the least numbers of
/// 16 and 32 bits, and what mapping programs call undefined: anything from 1e19 on, either sign.
bool is_null_code(double value);

/// A usual code among values.
struct NullCode {
    double code = 0;
    std::size_t count = 0;
    bool far = false;  ///< so far outside the other values that it is none of them
};

/// Codes are far when there are no other values, or none that comes within a tenth of a negative code, a tenth or (for
/// whole numbers) a hundredth of a positive one, a thousandth of one from 1e19 on. By code, ascending. NaN: no value.
/// O(n).
std::vector<NullCode> null_codes(std::span<const double> values);

/// Some values, of eight or more one or at most a twentieth, that are a hundred times as large as all others.
struct OffScale {
    std::size_t count = 0;
    double least = 0;   ///< of them, by size
    double others = 0;  ///< the largest of the others, by size
};
std::optional<OffScale> off_scale(std::span<const double> values);

/// What a user says stands for no value: a number or a word, in all columns or in that of one property or meaning.
struct NullValue {
    std::string column;  ///< empty: all
    std::string text;
    std::optional<double> number;
};

/// Of "VALUE" or "P=VALUE". Throws UsageError for what has no value.
NullValue parse_null(const std::string& text);

/// Does one of them say that the cell (or its number) is none, in a column of one of these names? `everywhere` is
/// whether those for all columns count here.
bool says_null(const std::vector<NullValue>& nulls, std::span<const std::string> names, std::string_view cell,
               std::optional<double> number, bool everywhere = true);

}  // namespace terratet
