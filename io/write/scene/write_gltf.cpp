// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// A scene to look at in any web viewer.

#include <filesystem>

#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/write/scene/gltf_document.hpp"
#include "io/write/scene/scene.hpp"

namespace terratet {

OutputRecord write_gltf(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    const Scene scene = make_scene(view, options);
    report_progress(options.progress, "write gltf", 0.5);
    const bool binary = std::filesystem::path(path).extension() != ".gltf";
    GltfText text = gltf_document(scene, view.model, options.compress.value_or(false));
    file.write(binary ? to_glb(text) : to_gltf(std::move(text)));
    report_progress(options.progress, "write gltf", 1);
    return {path, file.commit()};
}

}  // namespace terratet
