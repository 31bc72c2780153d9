// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// A scene to look at in any web viewer: the faces of the domain, the walls of fault blocks, faults and boreholes.

#include <filesystem>

#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/write/scene.hpp"

namespace terratet {

OutputRecord write_gltf(const ModelView& view, const std::string& path, const ExportOptions& options) {
    const Coloring coloring(view, options.color_property, options.color_map);
    OutputFile file(path, options.overwrite);
    const SceneFrame frame(view.model);

    std::vector<ScenePart> parts = tessellation_surfaces(view, frame);
    report_progress(options.progress, "write gltf", 0.4);
    for (std::size_t f = 0; f < view.model.barriers.size(); ++f) {
        if (!is_bound(view.model.barriers[f].sheet.kind)) {  // the domain ends there
            parts.push_back(fault_sheet(view.model, f, frame));
        }
    }
    parts.push_back(borehole_tubes(view, coloring, frame));
    std::erase_if(parts, [](const ScenePart& part) { return part.triangles.empty(); });
    report_progress(options.progress, "write gltf", 0.5);

    const bool binary = std::filesystem::path(path).extension() != ".gltf";
    file.write(to_gltf(parts, view.model, coloring, frame, binary));
    report_progress(options.progress, "write gltf", 1);
    return {path, file.commit()};
}

}  // namespace terratet
