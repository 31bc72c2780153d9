// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <optional>

#include "io/read/meshes/byte_cursor.hpp"
#include "io/read/meshes/mesh_readers.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

std::optional<Type> type_named(std::string_view name) {
    static const std::map<std::string_view, Type> types{
        {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
        {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
        {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
        {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
    const auto found = types.find(name);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
    std::string name;
    Type type = Type::f32;
    std::optional<Type> count{};  ///< of a list
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    bool ascii = false;
    std::endian order = std::endian::little;
    std::vector<Element> elements;
};

Header read_header(TextCursor& text) {
    Header header;
    std::string_view line;
    bool format = false;
    while (text.next(line) && line != "end_header") {
        std::string_view words = line;
        const std::string_view keyword = next_word(words);
        if (keyword == "format") {
            const std::string_view name = next_word(words);
            header.ascii = name == "ascii";
            header.order = name == "binary_big_endian" ? std::endian::big : std::endian::little;
            format = header.ascii || name.starts_with("binary_");
        } else if (keyword == "element") {
            const std::string name(next_word(words));
            const auto count = whole_number<std::uint64_t>(next_word(words));
            if (!count) {
                throw InputError("line " + std::to_string(text.line()) + ": an element without its count");
            }
            header.elements.push_back({name, *count, {}});
        } else if (keyword == "property" && !header.elements.empty()) {
            Property property;
            std::string_view word = next_word(words);
            if (word == "list") {
                property.count = type_named(next_word(words));
                word = next_word(words);
                if (!property.count) {
                    throw InputError("line " + std::to_string(text.line()) + ": a list of an unknown type");
                }
            }
            const auto type = type_named(word);
            if (!type) {
                throw InputError("line " + std::to_string(text.line()) + ": a property of an unknown type");
            }
            property.type = *type;
            property.name = std::string(next_word(words));
            header.elements.back().properties.push_back(property);
        }
    }
    if (!format || line != "end_header") {
        throw InputError("the header of the PLY file is not complete");
    }
    return header;
}

double take(ByteCursor& bytes, Type type) {
    switch (type) {
        case Type::i8:
            return bytes.take<std::int8_t>();
        case Type::u8:
            return bytes.take<std::uint8_t>();
        case Type::i16:
            return bytes.take<std::int16_t>();
        case Type::u16:
            return bytes.take<std::uint16_t>();
        case Type::i32:
            return bytes.take<std::int32_t>();
        case Type::u32:
            return bytes.take<std::uint32_t>();
        case Type::f32:
            return static_cast<double>(bytes.take<float>());
        case Type::f64:
            return bytes.take<double>();
    }
    return missing;
}

/// Numbers of the file's body, in text or in bytes.
class Body {
  public:
    Body(const Header& header, TextCursor text)
        : ascii_(header.ascii), size_(text.rest().size()), text_(text), bytes_(text.rest(), header.order) {}

    double next(Type type) {
        if (!ascii_) {
            return take(bytes_, type);
        }
        const std::string_view word = text_.word();
        if (word.empty()) {
            throw InputError("the file is cut off: numbers are missing at its end");
        }
        const auto value = whole_number<double>(word);
        return value.value_or(missing);
    }
    [[nodiscard]] std::size_t left() const { return ascii_ ? size_ : bytes_.left(); }
    [[nodiscard]] std::int64_t line(std::uint64_t record) const {
        return ascii_ ? text_.line() : static_cast<std::int64_t>(record) + 1;
    }

  private:
    bool ascii_;
    std::size_t size_;
    TextCursor text_;
    ByteCursor bytes_;
};

std::int64_t as_index(double value) {
    return value >= 0 && value < 4294967296.0 ? static_cast<std::int64_t>(value) : -1;
}

void read_list(const Property& property, Body& body, std::vector<std::int64_t>* corners) {
    const double count = body.next(*property.count);
    if (!(count >= 0) || count > static_cast<double>(body.left())) {
        throw InputError("a list is longer than the file");
    }
    for (double k = 0; k < count; ++k) {
        const double value = body.next(property.type);
        if (corners != nullptr) {
            corners->push_back(as_index(value));
        }
    }
}

void read_element(const Element& element, Body& body, MeshBuilder& mesh) {
    const bool vertex = element.name == "vertex";
    const bool face = element.name == "face";
    if (element.count > body.left() || (element.properties.empty() && element.count > 0)) {
        throw InputError("it states " + std::to_string(element.count) + " of " + excerpt(element.name) +
                         ", more than the file can hold");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
        Vec3 position{missing, missing, missing};
        std::vector<std::int64_t> corners;
        for (const Property& property : element.properties) {
            if (property.count) {
                const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
                read_list(property, body, face && indices ? &corners : nullptr);
                continue;
            }
            const double value = body.next(property.type);
            position.x = property.name == "x" ? value : position.x;
            position.y = property.name == "y" ? value : position.y;
            position.z = property.name == "z" ? value : position.z;
        }
        if (vertex) {
            mesh.vertex(position, body.line(i));
        } else if (face) {
            mesh.face(corners, body.line(i));
        }
    }
}

}  // namespace

void read_ply(std::string_view bytes, MeshBuilder& mesh) {
    TextCursor text(bytes);
    const Header header = read_header(text);
    Body body(header, text);
    for (const Element& element : header.elements) {
        read_element(element, body, mesh);
    }
}

}  // namespace terratet
