// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of a group code and its value, in text or binary. Entities begin with code 0; 8 is their layer; 10 to 13, 20 to
// 23, 30 to 33 are corners. Of POLYLINEs, polyface meshes (70 has bit 64) have VERTEX entities that are places (70: 64)
// and faces (71 to 74: their corners from 1, negative where an edge is not drawn), polygon meshes (bit 16) have M times
// N places.
#include <array>
#include <map>

#include "io/read/meshes/dxf_pairs.hpp"
#include "io/read/meshes/mesh_readers.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

constexpr int polygon_mesh = 16;
constexpr int polyface_mesh = 64;

/// What an entity says, as far as it matters here.
struct Entity {
    std::string type;
    std::string layer = "0";
    std::array<Vec3, 4> corners{Vec3{missing, missing, missing},
                                {missing, missing, missing},
                                {missing, missing, missing},
                                {missing, missing, missing}};
    std::map<int, std::int64_t> whole;  ///< 70 to 75
    std::int64_t line = 0;

    [[nodiscard]] std::int64_t number(int code) const {
        const auto found = whole.find(code);
        return found == whole.end() ? 0 : found->second;
    }
};

class Reader {
  public:
    explicit Reader(MeshBuilder& mesh) : mesh_(mesh) {}

    void entity(const Entity& entity) {
        if (entity.type == "3DFACE") {
            face(entity);
        } else if (entity.type == "POLYLINE") {
            poly_ = entity;
            places_.clear();
            faces_.clear();
        } else if (entity.type == "VERTEX") {
            vertex(entity);
        } else if (entity.type == "SEQEND") {
            finish_poly();
        }
        if (!entity.type.empty() && entity.type != "VERTEX" && entity.type != "SEQEND") {
            ++seen_[entity.type];
        }
    }

    /// "12 LINE, 3 INSERT": what is in the file, for a message.
    [[nodiscard]] std::string seen() const {
        std::string text;
        for (const auto& [type, count] : seen_) {
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + excerpt(type);
        }
        return text;
    }

  private:
    void face(const Entity& entity) {
        mesh_.object(to_utf8(entity.layer));
        std::vector<std::int64_t> corners;
        for (const Vec3& corner : entity.corners) {
            if (&corner == &entity.corners.back() && !is_finite(corner)) {
                continue;  // three will do
            }
            corners.push_back(mesh_.shared_vertex(corner, entity.line));
        }
        if (corners.size() == 4 && corners[3] == corners[2]) {
            corners.pop_back();
        }
        quad(corners, entity.line);
    }

    /// A bent or crossing quadrilateral is two triangles, as CAD draws it.
    void quad(const std::vector<std::int64_t>& corners, std::int64_t line) {
        if (corners.size() < 4) {
            return mesh_.face(corners, line);
        }
        mesh_.face(std::array{corners[0], corners[1], corners[2]}, line);
        mesh_.face(std::array{corners[0], corners[2], corners[3]}, line);
    }

    void vertex(const Entity& entity) {
        const bool place = (entity.number(70) & 64) != 0;
        const std::int64_t kind = poly_.number(70);
        if ((kind & polygon_mesh) != 0 || ((kind & polyface_mesh) != 0 && place)) {
            places_.push_back(entity.corners[0]);
        } else if ((kind & polyface_mesh) != 0) {
            faces_.push_back(entity);
        }
    }

    void finish_poly() {
        if (places_.empty()) {
            return;
        }
        mesh_.object(to_utf8(poly_.layer));
        std::vector<std::int64_t> index;
        for (const Vec3& place : places_) {
            index.push_back(mesh_.shared_vertex(place, poly_.line));
        }
        for (const Entity& entity : faces_) {
            std::vector<std::int64_t> corners;
            for (int code = 71; code <= 74; ++code) {
                const std::int64_t corner = std::abs(entity.number(code));
                if (corner > 0) {
                    const bool there = corner <= static_cast<std::int64_t>(index.size());
                    corners.push_back(there ? index[static_cast<std::size_t>(corner - 1)] : -1);
                }
            }
            if (corners.size() > 2) {
                quad(corners, entity.line);
            }
        }
        if ((poly_.number(70) & polygon_mesh) != 0) {
            polygon_grid(index);
        }
        places_.clear();
    }

    void polygon_grid(const std::vector<std::int64_t>& index) {
        const std::int64_t m = poly_.number(71);
        const std::int64_t n = poly_.number(72);
        const auto places = static_cast<std::int64_t>(index.size());
        if (m < 2 || n < 2 || m > places || n > places || m * n != places) {
            return mesh_.reject(poly_.line, "a polygon mesh of " + std::to_string(m) + " x " + std::to_string(n) +
                                                " places has " + std::to_string(places));
        }
        for (std::int64_t i = 0; i + 1 < m; ++i) {
            for (std::int64_t j = 0; j + 1 < n; ++j) {
                const auto at = static_cast<std::size_t>(i * n + j);
                const auto step = static_cast<std::size_t>(n);
                quad({index[at], index[at + 1], index[at + step + 1], index[at + step]}, poly_.line);
            }
        }
    }

    MeshBuilder& mesh_;
    Entity poly_;
    std::vector<Vec3> places_;
    std::vector<Entity> faces_;
    std::map<std::string, std::size_t> seen_;
};

void take(Entity& entity, int code, std::string_view value) {
    if (code == 8) {
        entity.layer = std::string(value);
    } else if (code >= 70 && code <= 75) {
        entity.whole[code] = whole_number<std::int64_t>(value).value_or(0);
    } else if (code >= 10 && code < 40 && code % 10 < 4) {
        Vec3& corner = entity.corners[static_cast<std::size_t>(code % 10)];
        (code < 20 ? corner.x : code < 30 ? corner.y : corner.z) = whole_number<double>(value).value_or(missing);
    }
}

}  // namespace

void read_dxf(std::string_view bytes, MeshBuilder& mesh) {
    DxfPairs pairs(bytes);
    Reader reader(mesh);
    Entity entity;
    bool section_begins = false;
    bool in_entities = false;
    std::optional<int> code;
    std::string_view value;
    while (pairs.next(code, value)) {
        if (!code) {
            mesh.reject(pairs.line() - 1, "a group code is no number, or unknown: \"" + excerpt(pairs.code_text()) +
                                              "\"; what follows is not read");
            break;
        }
        if (*code == 0) {
            if (in_entities) {
                reader.entity(entity);
            }
            entity = Entity{};
            entity.type = std::string(value);
            entity.line = pairs.line();
            section_begins = value == "SECTION";
            in_entities = in_entities && value != "ENDSEC";
        } else if (*code == 2 && section_begins) {
            in_entities = value == "ENTITIES";
            section_begins = false;
            entity.type.clear();
        } else {
            take(entity, *code, value);
        }
    }
    if (in_entities) {
        reader.entity(entity);
    }
    if (mesh.vertices() == 0) {
        throw InputError("no 3DFACE and no polyface mesh in its ENTITIES" +
                         (reader.seen().empty() ? "" : ", but " + reader.seen()) +
                         "; explode blocks and solids into 3DFACEs");
    }
}

}  // namespace terratet
