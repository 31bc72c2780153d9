// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// The scene as a picture.

#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/write/scene/picture.hpp"
#include "io/write/scene/scene_text.hpp"

namespace terratet {

OutputRecord write_png(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    ExportOptions own = options;
    own.enu = false;
    own.title = scene_title(options, path);
    const Scene scene = make_scene(view, own);
    report_progress(options.progress, "write png", 0.5);
    file.write(picture_png(scene, view, own));
    report_progress(options.progress, "write png", 1);
    return {path, file.commit()};
}

}  // namespace terratet
