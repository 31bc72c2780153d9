// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// 3D Tiles 1.1 of the scene: NAME.json, and a folder NAME beside it with the tiles. The folder is there first, whole.

#include <tbb/parallel_for.h>

#include <atomic>
#include <filesystem>

#include "io/base/output_file.hpp"
#include "io/base/vertical_crs.hpp"
#include "io/export.hpp"
#include "io/voxels/tiles/tiles_folder.hpp"
#include "io/write/scene/gltf_document.hpp"
#include "io/write/tiles/surface_tiles.hpp"

namespace terratet {
namespace {

namespace fs = std::filesystem;
using Json = GltfBuffers::Json;

constexpr double color_share = 0.2;  ///< of the scene's diagonal: what a colour from end to end is worth in metres

/// 3D Tiles have z up.
Json box(const Box3& box, double margin) {
    const Vec3 c = box.center();
    const Vec3 half = 0.5 * box.size() + Vec3{margin, margin, margin};
    return {{"box", {c.x, -c.z, c.y, half.x, 0, 0, 0, half.z, 0, 0, 0, half.y}}};
}

class Writer {
  public:
    Writer(const ModelView& view, const std::string& path, const ExportOptions& options)
        : view_(view),
          compress_(options.compress.value_or(false)),
          file_(path, options.overwrite),
          folder_(tiles_folder(path), options.overwrite && holds_only_tiles(path)),
          name_(fs::path(tiles_folder(path)).filename().string()),
          scene_(make_scene(view, on_globe(view.model, options))),
          facts_(part_facts(scene_, view.model)) {
        for (const ScenePart& part : scene_.parts) {
            for (const Vec3& p : part.positions) {
                box_.extend(p);
            }
        }
    }

    std::uint64_t write(const Progress& progress) {
        SurfaceTileOptions options;
        options.color_metres = std::max(color_share * box_.diagonal(), 1e-6);
        const SurfaceTile top = surface_tiles(scene_.parts, options, progress);
        Json root{{"transform", transform()},
                  {"boundingVolume", box(box_, margin())},
                  {"geometricError", box_.diagonal()},
                  {"refine", "ADD"}};
        std::vector<Content> contents;
        add_frame(root, contents);
        if (!top.parts.empty()) {
            root["children"] = Json::array({tile(top, options.color_metres, contents)});
        }
        tbb::parallel_for(std::size_t{0}, contents.size(), [&](std::size_t n) { write_content(n, contents[n]); });
        report_progress(progress, "write tiles", 0.9);
        Json document{{"asset", {{"version", "1.1"}, {"generator", "Terratet"}}},
                      {"geometricError", box_.diagonal()},
                      {"root", std::move(root)}};
        document["extras"] = gltf_extras(scene_, view_.model, attribute_names(view_.model.properties));
        document["extras"]["color_metres"] = options.color_metres;
        file_.write(document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
        folder_.commit();
        return bytes_ + file_.commit();
    }

  private:
    using Content = std::vector<TilePart>;

    static ExportOptions on_globe(const Model& model, ExportOptions options) {
        options.enu = SceneFrame(model).globe().has_value();
        return options;
    }

    /// Of single precision, or of 16 bits.
    [[nodiscard]] double margin() const { return box_.diagonal() * (compress_ ? 2e-5 : 1e-6); }

    [[nodiscard]] Json transform() const {
        if (const auto& globe = scene_.frame.globe()) {
            return globe->enu_to_ecef;
        }
        const Vec3 at = scene_.frame.metres_per_unit() * scene_.frame.origin();
        return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at.x, at.y, at.z, 1};
    }

    Json content(Content parts, std::vector<Content>& contents) const {
        contents.push_back(std::move(parts));
        return {{"uri", name_ + "/content/" + std::to_string(contents.size() - 1) + ".glb"}};
    }

    /// Lines are the same at every level.
    void add_frame(Json& root, std::vector<Content>& contents) const {
        Content lines;
        for (std::uint32_t p = 0; p < scene_.parts.size(); ++p) {
            if (scene_.parts[p].triangles.empty()) {
                lines.push_back({p, {}, {}});
            }
        }
        if (!lines.empty()) {
            root["content"] = content(std::move(lines), contents);
        }
    }

    Json tile(const SurfaceTile& from, double color_metres, std::vector<Content>& contents) const {
        Json result{{"boundingVolume", box(from.box, margin())},
                    {"geometricError", from.deviation.metres(color_metres)},
                    {"refine", "REPLACE"},
                    {"content", content(from.parts, contents)},
                    {"extras", {{"deviation", from.deviation.distance}, {"color_deviation", from.deviation.color}}}};
        for (const SurfaceTile& child : from.children) {
            result["children"].push_back(tile(child, color_metres, contents));
        }
        return result;
    }

    void write_content(std::size_t number, const Content& content) {
        std::vector<ScenePart> parts;
        std::vector<PartFacts> facts;
        for (const TilePart& part : content) {
            const ScenePart& whole = scene_.parts[part.part];
            parts.push_back(whole.triangles.empty() ? whole : shown(whole, part));
            facts.push_back(facts_[part.part]);
        }
        const std::string glb = to_glb(gltf_of_parts(parts, facts, box_, view_.model, compress_));
        const std::string_view bytes = glb;
        folder_.write("content/" + std::to_string(number) + ".glb", {&bytes, 1});
        bytes_ += bytes.size();
    }

    const ModelView& view_;
    bool compress_;
    OutputFile file_;
    OutputFolder folder_;
    std::string name_;  ///< of the folder
    Scene scene_;
    std::vector<PartFacts> facts_;
    Box3 box_;
    std::atomic<std::uint64_t> bytes_ = 0;
};

}  // namespace

OutputRecord write_surface_tiles(const ModelView& view, const std::string& path, const ExportOptions& options) {
    Writer writer(view, path, options);
    OutputRecord record{path, writer.write(options.progress)};
    record.remark = heights_remark(crs_from_wkt(view.model.frame.crs_wkt), options.vertical_crs);
    report_progress(options.progress, "write tiles", 1);
    return record;
}

}  // namespace terratet
