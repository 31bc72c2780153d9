// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/meshes/vtk_tags.hpp"

#include <algorithm>

#include "io/base/text_lines.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

}  // namespace

std::string_view VtkTag::value(std::string_view attribute) const {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? std::string_view{} : std::string_view(found->second);
}

bool VtkTags::next(VtkTag& tag) {
    const std::size_t open = rest_.find('<');
    const std::size_t close = open == std::string_view::npos ? open : rest_.find('>', open);
    if (close == std::string_view::npos) {
        return false;
    }
    std::string_view inside = rest_.substr(open + 1, close - open - 1);
    rest_.remove_prefix(close + 1);
    tag = {};
    tag.empty = inside.ends_with('/');
    const auto end = std::ranges::find_if(inside, is_blank);
    tag.name = inside.substr(0, static_cast<std::size_t>(end - inside.begin()));
    if (tag.name.size() > 1 && tag.name.ends_with('/')) {
        tag.name.remove_suffix(1);
    }
    inside.remove_prefix(std::min(tag.name.size(), inside.size()));
    for (std::size_t equals = inside.find('='); equals != std::string_view::npos; equals = inside.find('=')) {
        const std::string key(trim(inside.substr(0, equals)));
        inside = inside.substr(equals + 1);
        const std::size_t quote = inside.find_first_of("\"'");
        const std::size_t last = quote == std::string_view::npos ? quote : inside.find(inside[quote], quote + 1);
        if (last == std::string_view::npos) {
            break;
        }
        tag.attributes[key] = std::string(inside.substr(quote + 1, last - quote - 1));
        inside = inside.substr(last + 1);
    }
    return true;
}

VtkEncoding vtk_encoding(std::string_view bytes, std::string_view type) {
    VtkEncoding encoding;
    const std::size_t appended = bytes.find("<AppendedData");
    VtkTags tags(bytes.substr(0, appended));
    VtkTag tag;
    while (tags.next(tag) && tag.name != "VTKFile") {
    }
    if (tag.name != "VTKFile" || tag.value("type") != type) {
        throw InputError("no " + std::string(type) + " of VTK, but " +
                         (tag.name == "VTKFile" ? excerpt(tag.value("type")) : std::string("something else")));
    }
    encoding.order = tag.value("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    encoding.long_headers = tag.value("header_type") == "UInt64";
    const std::string_view compressor = tag.value("compressor");
    encoding.zlib = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !encoding.zlib) {
        throw InputError("compressed by " + excerpt(compressor) + ", which is not read; zlib is");
    }
    if (appended != std::string_view::npos) {
        VtkTags behind(bytes.substr(appended));
        behind.next(tag);
        encoding.appended_base64 = tag.value("encoding") == "base64";
        const std::size_t underscore = bytes.find('_', bytes.find('>', appended));
        encoding.appended = underscore == std::string_view::npos ? std::string_view{} : bytes.substr(underscore + 1);
    }
    return encoding;
}

}  // namespace terratet
