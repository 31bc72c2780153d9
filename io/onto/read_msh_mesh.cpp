// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <map>

#include "io/onto/mesh_formats.hpp"
#include "io/read/meshes/text_cursor.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

struct ElementType {
    int gmsh;
    std::uint8_t vtk;
    int nodes;
};

/// Those whose nodes come in the same order in both; of the second order the nodes on edges are left out.
constexpr std::array<ElementType, 12> element_types{{{15, 1, 1},
                                                     {1, 3, 2},
                                                     {2, 5, 3},
                                                     {3, 9, 4},
                                                     {4, 10, 4},
                                                     {5, 12, 8},
                                                     {6, 13, 6},
                                                     {7, 14, 5},
                                                     {8, 3, 3},
                                                     {9, 5, 6},
                                                     {11, 10, 10},
                                                     {17, 12, 20}}};

constexpr int corners_of(std::uint8_t vtk) {
    return vtk == 1 ? 1 : vtk == 3 ? 2 : vtk == 5 ? 3 : vtk == 9 || vtk == 10 ? 4 : vtk == 14 ? 5 : vtk == 13 ? 6 : 8;
}

class MshReader {
  public:
    explicit MshReader(std::string_view bytes) : text_(bytes) {}

    PlaceMesh read() {
        std::string_view line;
        double version = 0;
        while (text_.next(line)) {
            if (line == "$MeshFormat") {
                version = number<double>("the format's version");
                if (number<int>("the file's kind") != 0) {
                    throw InputError("binary; save it as text (Mesh.Binary=0)");
                }
                if (version != 2.2 && (version < 4 || version >= 5)) {
                    throw InputError(fmt::format("version {} of Gmsh's format; 2.2 and 4.1 are read", version));
                }
                whole("the size of a number");
            } else if (line == "$Nodes") {
                version < 4 ? nodes_2() : nodes_4();
            } else if (line == "$Elements") {
                version < 4 ? elements_2() : elements_4();
            }
        }
        if (version == 0) {
            throw InputError("no mesh of Gmsh: without $MeshFormat");
        }
        return std::move(mesh_);
    }

  private:
    template <class Number>
    Number number(const char* what) {
        const auto found = text_.number<Number>();
        if (!found) {
            throw InputError(fmt::format("line {}: {} is no number", text_.line(), what));
        }
        return *found;
    }
    std::int64_t whole(const char* what) { return number<std::int64_t>(what); }

    void add_node(std::int64_t tag) {
        const Vec3 p{number<double>("x"), number<double>("y"), number<double>("z")};
        if (!index_.emplace(tag, std::ssize(mesh_.points)).second) {
            throw InputError(fmt::format("line {}: a second node {}", text_.line(), tag));
        }
        mesh_.points.push_back(p);
    }

    void nodes_2() {
        const std::int64_t count = whole("how many nodes there are");
        for (std::int64_t i = 0; i < count; ++i) {
            add_node(whole("a node's number"));
        }
    }

    void nodes_4() {
        const std::int64_t blocks = whole("how many blocks there are");
        for (int skipped = 0; skipped < 3; ++skipped) {
            whole("a number of nodes");
        }
        for (std::int64_t block = 0; block < blocks; ++block) {
            for (int skipped = 0; skipped < 2; ++skipped) {
                whole("an entity");
            }
            if (whole("whether it is parametric") != 0) {
                throw InputError(fmt::format("line {}: parametric nodes are not read", text_.line()));
            }
            const std::int64_t count = whole("how many nodes it has");
            std::vector<std::int64_t> tags;
            for (std::int64_t i = 0; i < count; ++i) {
                tags.push_back(whole("a node's number"));
            }
            for (const std::int64_t tag : tags) {
                add_node(tag);
            }
        }
    }

    void add_element(int type) {
        const auto* const known = std::ranges::find(element_types, type, &ElementType::gmsh);
        if (known == element_types.end()) {
            throw InputError(fmt::format("line {}: elements of type {} are not read", text_.line(), type));
        }
        for (int k = 0; k < known->nodes; ++k) {
            const std::int64_t tag = whole("a node's number");
            const auto node = index_.find(tag);
            if (node == index_.end()) {
                throw InputError(fmt::format("line {}: there is no node {}", text_.line(), tag));
            }
            if (k < corners_of(known->vtk)) {
                mesh_.nodes.push_back(node->second);
            }
        }
        mesh_.ends.push_back(std::ssize(mesh_.nodes));
        mesh_.types.push_back(known->vtk);
    }

    void elements_2() {
        const std::int64_t count = whole("how many elements there are");
        for (std::int64_t i = 0; i < count; ++i) {
            whole("an element's number");
            const int type = number<int>("an element's type");
            const std::int64_t tags = whole("how many tags it has");
            for (std::int64_t tag = 0; tag < tags; ++tag) {
                whole("a tag");
            }
            add_element(type);
        }
    }

    void elements_4() {
        const std::int64_t blocks = whole("how many blocks there are");
        for (int skipped = 0; skipped < 3; ++skipped) {
            whole("a number of elements");
        }
        for (std::int64_t block = 0; block < blocks; ++block) {
            for (int skipped = 0; skipped < 2; ++skipped) {
                whole("an entity");
            }
            const int type = number<int>("its elements' type");
            const std::int64_t count = whole("how many elements it has");
            for (std::int64_t i = 0; i < count; ++i) {
                whole("an element's number");
                add_element(type);
            }
        }
    }

    TextCursor text_;
    PlaceMesh mesh_;
    std::map<std::int64_t, std::int64_t> index_;  ///< by a node's number
};

}  // namespace

PlaceMesh read_msh_mesh(std::string_view bytes) {
    return MshReader(bytes).read();
}

}  // namespace terratet
