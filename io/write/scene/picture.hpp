// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The scene as a picture with title, axes and legend.

#include <string>

#include "io/write/scene/camera.hpp"
#include "io/write/scene/scene.hpp"

namespace terratet {

/// The bytes of a PNG of options.picture_size. Text is drawn by Cairo, in DejaVu Sans where there is such a font.
std::string picture_png(const Scene& scene, const ModelView& view, const ExportOptions& options);

}  // namespace terratet
