// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/vtk_array.hpp"

#include <zlib.h>

#include <array>
#include <cstdint>

#include "io/base/text_lines.hpp"
#include "io/read/meshes/byte_cursor.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

std::string_view attribute(const XmlAttributes& attributes, std::string_view name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::string_view{} : std::string_view(found->second);
}

int base64_digit(char c) {
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
}

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// One piece of base64, to its padding or to `most` bytes, four letters at a time; they are taken off the text.
std::string take_base64(std::string_view& text, std::size_t most) {
    std::string bytes;
    while (bytes.size() < most) {
        std::uint32_t bits = 0;
        int letters = 0;
        int digits = 0;
        while (letters < 4 && !text.empty() &&
               (is_space(text.front()) || text.front() == '=' || base64_digit(text.front()) >= 0)) {
            const char c = text.front();
            text.remove_prefix(1);
            if (!is_space(c)) {
                ++letters;
                digits += c == '=' ? 0 : 1;
                bits = bits << 6U | static_cast<std::uint32_t>(std::max(base64_digit(c), 0));
            }
        }
        if (letters < 4) {
            break;
        }
        for (int k = 0; k + 1 < digits; ++k) {
            bytes += static_cast<char>(bits >> static_cast<unsigned>(16 - 8 * k) & 0xFFU);
        }
        if (digits < 4) {
            break;
        }
    }
    bytes.resize(std::min(bytes.size(), most));
    return bytes;
}

/// Bytes of an array, raw or in base64, piece by piece.
class Bytes {
  public:
    Bytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

    std::string take(std::size_t count, std::size_t limit) {
        if (count > limit) {
            throw InputError("an array states " + std::to_string(count) + " bytes, more than the file can hold");
        }
        std::string result;
        if (base64_) {
            result = take_base64(text_, count);
        } else {
            result = text_.substr(0, count);
            text_.remove_prefix(result.size());
        }
        if (result.size() < count) {
            throw InputError("an array is cut off");
        }
        return result;
    }

    [[nodiscard]] bool base64() const { return base64_; }

  private:
    std::string_view text_;
    bool base64_;
};

std::uint64_t header_number(ByteCursor& cursor, bool wide) {
    return wide ? cursor.take<std::uint64_t>() : cursor.take<std::uint32_t>();
}

std::string inflated(std::string_view bytes, std::size_t size) {
    std::string result(size, '\0');
    uLongf length = size;
    if (uncompress(reinterpret_cast<Bytef*>(result.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                   bytes.size()) != Z_OK ||
        length != size) {
        throw InputError("a block of an array cannot be unpacked");
    }
    return result;
}

std::string unpacked(Bytes& source, const VtkEncoding& encoding, std::size_t limit) {
    const std::size_t word = encoding.long_headers ? 8 : 4;
    const std::string blocks_bytes =
        source.base64() ? Bytes(source).take(3 * word, limit) : source.take(3 * word, limit);
    ByteCursor first(blocks_bytes, encoding.order);
    const std::uint64_t blocks = header_number(first, encoding.long_headers);
    const std::uint64_t block_size = header_number(first, encoding.long_headers);
    const std::uint64_t last_size = header_number(first, encoding.long_headers);
    constexpr std::uint64_t thousandfold = 1100;  // zlib packs no better
    if (blocks > limit || block_size > limit * thousandfold || last_size > block_size ||
        (blocks > 0 && block_size > limit * thousandfold / blocks)) {
        throw InputError("the blocks of an array are more than the file can hold");
    }
    const std::string sizes_bytes =
        source.base64() ? source.take((3 + blocks) * word, limit).substr(3 * word) : source.take(blocks * word, limit);
    ByteCursor sizes(sizes_bytes, encoding.order);
    std::vector<std::uint64_t> packed;
    std::uint64_t total = 0;
    for (std::uint64_t i = 0; i < blocks; ++i) {
        packed.push_back(header_number(sizes, encoding.long_headers));
        total += packed.back();
        if (packed.back() > limit || total > limit) {
            throw InputError("the blocks of an array are more than the file can hold");
        }
    }
    const std::string data = source.take(total, limit);
    std::string result;
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < blocks; ++i) {
        const std::uint64_t size = i + 1 == blocks && last_size > 0 ? last_size : block_size;
        if (size > packed[i] * thousandfold) {
            throw InputError("a block of an array cannot be as long as it states");
        }
        result += inflated(std::string_view(data).substr(at, packed[i]), size);
        at += packed[i];
    }
    return result;
}

std::string array_bytes(Bytes source, const VtkEncoding& encoding, std::size_t limit) {
    if (encoding.zlib) {
        return unpacked(source, encoding, limit);
    }
    const std::size_t word = encoding.long_headers ? 8 : 4;
    const std::string head = Bytes(source).take(word, limit);
    ByteCursor cursor(head, encoding.order);
    const std::uint64_t size = header_number(cursor, encoding.long_headers);
    if (size > limit) {
        throw InputError("an array states " + std::to_string(size) + " bytes, more than the file can hold");
    }
    return source.take(word + size, limit + word).substr(word);
}

template <typename Number>
std::vector<double> numbers(std::string_view bytes, std::endian order) {
    std::vector<double> result;
    ByteCursor cursor(bytes, order);
    while (cursor.left() >= sizeof(Number)) {
        result.push_back(static_cast<double>(cursor.take<Number>()));
    }
    return result;
}

std::vector<double> typed(std::string_view type, std::string_view bytes, std::endian order) {
    if (type == "Float32") {
        return numbers<float>(bytes, order);
    }
    if (type == "Float64") {
        return numbers<double>(bytes, order);
    }
    if (type == "Int64" || type == "vtkIdType") {
        return numbers<std::int64_t>(bytes, order);
    }
    if (type == "UInt64") {
        return numbers<std::uint64_t>(bytes, order);
    }
    if (type == "Int32") {
        return numbers<std::int32_t>(bytes, order);
    }
    if (type == "UInt32") {
        return numbers<std::uint32_t>(bytes, order);
    }
    if (type == "UInt8") {
        return numbers<std::uint8_t>(bytes, order);
    }
    if (type == "Int8") {
        return numbers<std::int8_t>(bytes, order);
    }
    if (type == "Int16") {
        return numbers<std::int16_t>(bytes, order);
    }
    if (type == "UInt16") {
        return numbers<std::uint16_t>(bytes, order);
    }
    throw InputError("an array of type " + excerpt(type) + " is not known");
}

}  // namespace

std::vector<double> vtk_array(const XmlAttributes& attributes, std::string_view text, const VtkEncoding& encoding,
                              std::size_t limit) {
    const std::string_view format = attribute(attributes, "format");
    const std::string_view type = attribute(attributes, "type");
    if (format == "appended") {
        const auto offset = whole_number<std::uint64_t>(attribute(attributes, "offset"));
        if (!offset || *offset > encoding.appended.size()) {
            throw InputError("an array lies beyond the appended data");
        }
        const Bytes bytes(encoding.appended.substr(*offset), encoding.appended_base64);
        return typed(type, array_bytes(bytes, encoding, limit), encoding.order);
    }
    if (format == "binary") {
        return typed(type, array_bytes(Bytes(trimmed(text), true), encoding, limit), encoding.order);
    }
    std::vector<double> result;
    TextCursor cursor(text);
    for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word()) {
        const auto value = whole_number<double>(word);
        if (!value) {
            throw InputError("an array holds \"" + excerpt(word) + "\", which is no number");
        }
        result.push_back(*value);
    }
    return result;
}

}  // namespace terratet
