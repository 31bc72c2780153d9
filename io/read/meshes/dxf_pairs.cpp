// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/dxf_pairs.hpp"

#include <charconv>
#include <cstdint>

namespace terratet {
namespace {

constexpr std::string_view sentinel("AutoCAD Binary DXF\r\n\x1A\0", 22);

enum class Kind : std::uint8_t { string, real, int16, int32, int64, byte, chunk, unknown };

struct Range {
    int first;
    int last;
    Kind kind;
};

Kind kind_of(int code) {
    static constexpr std::array<Range, 29> ranges{
        {{0, 9, Kind::string},      {10, 59, Kind::real},       {60, 79, Kind::int16},    {90, 99, Kind::int32},
         {100, 105, Kind::string},  {110, 149, Kind::real},     {160, 169, Kind::int64},  {170, 179, Kind::int16},
         {210, 239, Kind::real},    {270, 289, Kind::int16},    {290, 299, Kind::byte},   {300, 309, Kind::string},
         {310, 319, Kind::chunk},   {320, 369, Kind::string},   {370, 389, Kind::int16},  {390, 399, Kind::string},
         {400, 409, Kind::int16},   {410, 419, Kind::string},   {420, 429, Kind::int32},  {430, 439, Kind::string},
         {440, 459, Kind::int32},   {460, 469, Kind::real},     {470, 481, Kind::string}, {999, 1003, Kind::string},
         {1004, 1004, Kind::chunk}, {1005, 1009, Kind::string}, {1010, 1059, Kind::real}, {1060, 1070, Kind::int16},
         {1071, 1071, Kind::int32}}};
    for (const Range& range : ranges) {
        if (code >= range.first && code <= range.last) {
            return range.kind;
        }
    }
    return Kind::unknown;
}

}  // namespace

DxfPairs::DxfPairs(std::string_view bytes)
    : bytes_(bytes), text_(bytes), cursor_(bytes), binary_(bytes.starts_with(sentinel.substr(0, 18))) {
    if (binary_) {
        cursor_.skip(sentinel.size());
        // The first pair is 0 and SECTION.
        wide_codes_ = bytes.size() > sentinel.size() + 1 && bytes[sentinel.size() + 1] == '\0';
    }
}

bool DxfPairs::next(std::optional<int>& code, std::string_view& value) {
    if (binary_) {
        return next_binary(code, value);
    }
    if (!text_.next(code_text_) || !text_.next(value)) {
        return false;
    }
    code = whole_number<int>(code_text_);
    return true;
}

/// Up to a NUL.
std::string_view DxfPairs::string() {
    const std::string_view rest = bytes_.substr(bytes_.size() - cursor_.left());
    const std::size_t end = rest.find('\0');
    if (end == std::string_view::npos) {
        throw InputError("the file is cut off: a text has no end");
    }
    cursor_.skip(end + 1);
    return trimmed(rest.substr(0, end));
}

template <typename Number>
std::string_view DxfPairs::number() {
    const auto value = cursor_.take<Number>();
    const auto [end, error] = std::to_chars(digits_.data(), digits_.data() + digits_.size(), value);
    return {digits_.data(), static_cast<std::size_t>(end - digits_.data())};
}

bool DxfPairs::next_binary(std::optional<int>& code, std::string_view& value) {
    if (cursor_.left() < 2) {
        return false;
    }
    ++pairs_;
    code_text_ = "of the binary DXF";
    int number_of_group = 0;
    if (wide_codes_) {
        number_of_group = cursor_.take<std::int16_t>();
    } else {
        number_of_group = cursor_.take<std::uint8_t>();
        number_of_group = number_of_group == 255 ? cursor_.take<std::int16_t>() : number_of_group;
    }
    code = number_of_group;
    value = {};
    switch (kind_of(number_of_group)) {
        case Kind::string:
            value = string();
            break;
        case Kind::real:
            value = number<double>();
            break;
        case Kind::int16:
            value = number<std::int16_t>();
            break;
        case Kind::int32:
            value = number<std::int32_t>();
            break;
        case Kind::int64:
            value = number<std::int64_t>();
            break;
        case Kind::byte:
            cursor_.skip(1);
            break;
        case Kind::chunk:
            cursor_.skip(cursor_.take<std::uint8_t>());
            break;
        case Kind::unknown:
            code.reset();
            break;
    }
    return true;
}

}  // namespace terratet
