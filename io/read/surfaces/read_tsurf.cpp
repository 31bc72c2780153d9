// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GOCAD TSurf, as GOCAD, SKUA, Leapfrog, Move and others write it. One object:
//
//     GOCAD TSurf 1
//     HEADER {
//     name: My fault
//     }
//     GOCAD_ORIGINAL_COORDINATE_SYSTEM
//     AXIS_UNIT "m" "m" "m"
//     ZPOSITIVE Elevation            or Depth
//     END_ORIGINAL_COORDINATE_SYSTEM
//     TFACE                          any number of parts
//     VRTX id x y z                  PVRTX, with property values behind
//     ATOM id other                  the same place as an earlier vertex; PATOM likewise
//     TRGL id id id
//     BSTONE, BORDER                 not needed
//     END
//
// Ids start anywhere and may have gaps; files are known that restart them in each TFACE.
#include <cpl_conv.h>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "io/base/rejections.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/surfaces/gocad_words.hpp"
#include "io/read/surfaces/graph_check.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// A triangle as the file gives it, until the end of its TFACE: some files name vertices before they define them.
struct RawTriangle {
    std::array<VertexId, 3> ids;
    std::int64_t line;
};

class Parser {
  public:
    Parser(const Source& source, SurfaceKind kind, Diagnostics& diagnostics)
        : file_(source.path), kind_(kind), diagnostics_(diagnostics), rejections_(diagnostics, source.path) {
        if (!source.srs.empty()) {
            crs_ = parse_crs(source.srs);
        }
    }

    std::vector<Surface> parse();

  private:
    enum class Where { outside, tsurf, points, other_object };

    void line(std::string_view text);
    void begin_object(std::string_view rest);
    void end_object();
    void header(std::string_view text);
    void coordinate_system(std::string_view keyword, std::string_view rest);
    void record(std::string_view keyword, std::string_view rest);
    void vertex(std::string_view rest);
    void atom(std::string_view rest);
    void triangle(std::string_view rest);
    void end_face();
    void end_points();
    void axis_units(std::string_view rest);
    void reject(const char* what, std::string_view rest) {
        rejections_.add(number_, [&] { return std::string(what) + ": \"" + excerpt(trimmed(rest)) + "\""; });
    }

    std::string file_;
    SurfaceKind kind_;
    Diagnostics& diagnostics_;
    Rejections rejections_;
    std::optional<Crs> crs_;
    std::vector<Surface> surfaces_;
    std::set<std::string> other_kinds_;
    std::set<std::string> notes_;  ///< each once a file
    std::int64_t unknown_lines_ = 0;
    std::string first_unknown_;
    std::int64_t number_ = 0;

    Where where_ = Where::outside;
    bool in_block_ = false;   ///< between { and }
    bool in_header_ = false;  ///< that block is the object's HEADER
    bool in_system_ = false;
    std::int64_t object_line_ = 0;
    Surface surface_;
    VertexIds ids_;
    std::vector<RawTriangle> face_;
    Vec3 scale_{1, 1, 1};
};

/// A vertex is refused where it stands, so the triangles that name it find no such id.
void Parser::vertex(std::string_view rest) {
    std::string_view words = rest;
    const auto id = whole_number<VertexId>(next_word(words));
    const auto x = whole_number<double>(next_word(words));
    const auto y = whole_number<double>(next_word(words));
    const auto z = whole_number<double>(next_word(words));
    if (!id || !x || !y || !z) {
        return reject("a vertex needs an id and three coordinates", rest);
    }
    const Vec3 position{*x * scale_.x, *y * scale_.y, *z * scale_.z};
    if (!is_acceptable(position)) {
        return reject("coordinates must be numbers within 1e9", rest);
    }
    if (surface_.vertices.size() >= std::numeric_limits<std::uint32_t>::max() - 1) {
        throw InputError(file_ + ", line " + std::to_string(number_) + ": more than 4294967294 vertices in one object");
    }
    ids_.set(*id, static_cast<std::uint32_t>(surface_.vertices.size()));
    surface_.vertices.push_back(position);
}

void Parser::atom(std::string_view rest) {
    std::string_view words = rest;
    const auto id = whole_number<VertexId>(next_word(words));
    const auto other = whole_number<VertexId>(next_word(words));
    const auto index = other ? ids_.find(*other) : std::nullopt;
    if (!id || !index) {
        return reject("an atom needs an id and that of an earlier vertex", rest);
    }
    ids_.set(*id, *index);
}

void Parser::triangle(std::string_view rest) {
    std::string_view words = rest;
    const auto a = whole_number<VertexId>(next_word(words));
    const auto b = whole_number<VertexId>(next_word(words));
    const auto c = whole_number<VertexId>(next_word(words));
    if (!a || !b || !c) {
        return reject("a triangle needs three vertex ids", rest);
    }
    face_.push_back({{*a, *b, *c}, number_});
}

void Parser::end_face() {
    for (const RawTriangle& raw : face_) {
        Triangle triangle{};
        bool complete = true;
        for (std::size_t k = 0; k < 3 && complete; ++k) {
            const auto index = ids_.find(raw.ids[k]);
            complete = index.has_value();
            if (complete) {
                triangle[k] = *index;
            } else {
                rejections_.add(raw.line, [&] {
                    return "the triangle names vertex " + std::to_string(raw.ids[k]) + ", which is not there";
                });
            }
        }
        if (!complete) {
            continue;
        }
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
            rejections_.add(raw.line, [] { return std::string("the triangle names one vertex twice"); });
            continue;
        }
        surface_.triangles.push_back(triangle);
    }
    face_.clear();
}

/// Brings all axes to one unit: that of the CRS given with the file, else metres.
void Parser::axis_units(std::string_view rest) {
    std::string unit[3];
    double scale[3] = {1, 1, 1};
    const bool geographic = crs_ && crs_->geographic;
    const double target = crs_ && !geographic ? crs_->metres_per_unit : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        unit[axis] = std::string(trimmed(next_word(rest)));
        const auto metres = metres_per(unit[axis]);
        if (metres && !(geographic && axis < 2)) {
            const double factor = *metres / target;
            scale[axis] = std::abs(factor - 1) < 1e-5 ? 1 : factor;  // one foot as good as another
        }
    }
    const double sign = scale_.z < 0 ? -1 : 1;
    scale_ = {scale[0], scale[1], sign * scale[2]};
    if (scale[0] != 1 || scale[1] != 1 || scale[2] != 1) {
        notes_.insert("AXIS_UNIT is " + excerpt(unit[0]) + " " + excerpt(unit[1]) + " " + excerpt(unit[2]) +
                      "; converted to " + (crs_ && !geographic ? crs_->unit : "metre"));
    }
}

void Parser::coordinate_system(std::string_view keyword, std::string_view rest) {
    const bool late = !surface_.vertices.empty();
    if (keyword == "END_ORIGINAL_COORDINATE_SYSTEM") {
        in_system_ = false;
    } else if (keyword == "AXIS_UNIT" || keyword == "ZPOSITIVE") {
        if (late) {
            return reject("the coordinate system stands behind vertices and was not applied to them", rest);
        }
        if (keyword == "AXIS_UNIT") {
            return axis_units(rest);
        }
        const std::string_view direction = next_word(rest);
        if (direction == "Depth" || direction == "DEPTH" || direction == "depth") {
            scale_.z = -std::abs(scale_.z);
            notes_.insert("ZPOSITIVE is Depth; heights are its negative");
        }
    }
}

/// One line within braces; only the name matters.
void Parser::header(std::string_view text) {
    if (text.substr(0, 5) != "name:") {
        return;
    }
    std::string_view name = trimmed(text.substr(5));
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
        name = trimmed(name.substr(1, name.size() - 2));
    }
    if (!name.empty()) {
        surface_.name = to_utf8(name);
    }
}

void Parser::begin_object(std::string_view rest) {
    if (where_ == Where::tsurf || where_ == Where::points) {
        notes_.insert("an object ends without END");
        end_object();
    }
    const std::string_view kind = next_word(rest);
    where_ = kind == "TSurf" ? Where::tsurf : kind == "VSet" || kind == "PLine" ? Where::points : Where::other_object;
    if (where_ == Where::other_object) {
        other_kinds_.insert(excerpt(kind));
    }
    object_line_ = number_;
    surface_ = {};
    surface_.name = to_utf8(CPLGetBasename(file_.c_str()));
    surface_.kind = kind_;
    surface_.file = to_utf8(file_);
    ids_ = {};
    scale_ = {1, 1, 1};
}

void Parser::end_object() {
    if (where_ == Where::tsurf) {
        end_face();
        if (surface_.triangles.empty()) {
            rejections_.add(object_line_, [&] { return "\"" + surface_.name + "\" has no usable triangle"; });
        } else {
            surfaces_.push_back(std::move(surface_));
        }
    }
    if (where_ == Where::points) {
        end_points();
    }
    where_ = Where::outside;
    in_block_ = in_header_ = in_system_ = false;
}

/// Points of a VSet or of a PLine's lines, triangulated in their plane.
void Parser::end_points() {
    Surface surface = triangulate_in_best_fit_plane(surface_.name, std::move(surface_.vertices));
    const bool graph = is_graph(surface);
    if (surface.triangles.empty() || !graph) {
        return rejections_.add(object_line_, [&] {
            return "\"" + surface_.name + "\": its points " +
                   (graph ? "span no surface (three off a line are needed)"
                          : "are no graph over their plane: they fill a volume, or the sheet lies over itself");
        });
    }
    notes_.insert("points of VSet and PLine objects are triangulated in their best-fit plane");
    surface.kind = kind_;
    surface.file = surface_.file;
    surfaces_.push_back(std::move(surface));
}

void Parser::record(std::string_view keyword, std::string_view rest) {
    if (keyword == "VRTX" || keyword == "PVRTX") {
        vertex(rest);
    } else if (keyword == "TRGL") {
        triangle(rest);
    } else if (keyword == "ATOM" || keyword == "PATOM") {
        atom(rest);
    } else if (keyword == "TFACE") {
        end_face();
    } else if (keyword == "END") {
        end_object();
    } else if (keyword == "GOCAD_ORIGINAL_COORDINATE_SYSTEM") {
        in_system_ = true;
    } else if (!is_ignorable(keyword)) {
        if (unknown_lines_++ == 0) {
            first_unknown_ = excerpt(keyword) + " in line " + std::to_string(number_);
        }
    }
}

void Parser::line(std::string_view text) {
    text = trimmed(text);
    std::string_view rest = text;
    const std::string_view keyword = next_word(rest);
    if (keyword == "GOCAD") {
        return begin_object(rest);
    }
    if (where_ != Where::tsurf && where_ != Where::points) {
        return;
    }
    if (!in_block_) {
        if (in_system_) {
            return coordinate_system(keyword, rest);
        }
        const std::size_t brace = text.find('{');
        const bool opens = keyword.substr(0, 6) == "HEADER" || keyword.substr(0, 21) == "PROPERTY_CLASS_HEADER" ||
                           (!text.empty() && text.back() == '{');
        if (!opens || brace == std::string_view::npos) {
            return record(keyword, rest);
        }
        in_block_ = true;
        in_header_ = keyword.substr(0, 6) == "HEADER";
        text = trimmed(text.substr(brace + 1));
    }
    const bool closes = !text.empty() && text.back() == '}';
    if (in_header_) {
        header(closes ? trimmed(text.substr(0, text.size() - 1)) : text);
    }
    in_block_ = !closes;
}

std::vector<Surface> Parser::parse() {
    LineReader reader(file_);
    std::string_view text;
    while (reader.next(text)) {
        if (reader.number() == 1 && text.substr(0, 3) == "\xEF\xBB\xBF") {
            text.remove_prefix(3);
        }
        number_ = reader.number();
        // A last line that is cut off may hold half a number: used only when it is the END.
        if (reader.terminated() || trimmed(text) == "END") {
            line(text);
        } else if (!trimmed(text).empty() && (where_ == Where::tsurf || where_ == Where::points)) {
            reject("the file ends within this line", text);
        }
    }
    if (where_ == Where::tsurf || where_ == Where::points) {
        rejections_.add(number_,
                        [&] { return "the file ends within \"" + surface_.name + "\", without END; is it cut off?"; });
        end_object();
    }
    for (const std::string& note : notes_) {
        diagnostics_.note(file_ + ": " + note);
    }
    if (unknown_lines_ > 0) {
        diagnostics_.note(file_ + ": " + std::to_string(unknown_lines_) +
                          " lines with unknown keywords skipped, first " + first_unknown_);
    }
    std::string others;
    for (const std::string& kind : other_kinds_) {
        others += (others.empty() ? "" : ", ") + kind;
    }
    if (!others.empty() && !surfaces_.empty()) {
        diagnostics_.note(file_ + ": objects that are no TSurf skipped: " + others);
    }
    if (surfaces_.empty()) {
        throw InputError(file_ + ": no usable GOCAD TSurf, VSet or PLine in it" +
                         (others.empty() ? "" : ", only " + others) + rejections_.first() +
                         "; surfaces are objects that begin with GOCAD TSurf and have TRGL lines");
    }
    return std::move(surfaces_);
}

}  // namespace

bool is_gocad(const std::string& path) {
    try {
        LineReader reader(path);
        std::string_view text;
        while (reader.next(text)) {
            if (reader.number() == 1 && text.substr(0, 3) == "\xEF\xBB\xBF") {
                text.remove_prefix(3);
            }
            if (!trimmed(text).empty()) {
                return next_word(text) == "GOCAD";
            }
        }
    } catch (const InputError&) {  // not there, or not text: whoever reads it in earnest says so
    }
    return false;
}

RawSurfaces read_tsurf(const Source& source, SurfaceKind kind, Diagnostics& diagnostics) {
    return {Parser(source, kind, diagnostics).parse(), {}, true};
}

}  // namespace terratet
