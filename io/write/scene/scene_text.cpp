// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/scene_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/base/crs.hpp"
#include "io/write/view_barriers.hpp"
#include "tess/fidelity.hpp"

namespace terratet {
namespace {

std::vector<double> scaled_samples(const Model& model, std::size_t property) {
    std::vector<double> scaled;
    if (property < model.samples.values.size()) {
        for (const double value : model.samples.values[property]) {
            if (const double s = to_scale(model.properties[property], value); std::isfinite(s)) {
                scaled.push_back(s);
            }
        }
    }
    return scaled;
}

std::string grouped(std::size_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;) {
        at -= 3;
        text.insert(at, "\u202f");
    }
    return text;
}

/// Of the tessellation's field at the samples; NaN where there is none.
double r_squared(const ModelView& view, std::size_t property) {
    const std::vector<double> scaled = scaled_samples(view.model, property);
    if (scaled.size() < 2) {
        return missing;
    }
    double mean = 0;
    for (const double s : scaled) {
        mean += s / static_cast<double>(scaled.size());
    }
    double variance = 0;
    for (const double s : scaled) {
        variance += (s - mean) * (s - mean) / static_cast<double>(scaled.size());
    }
    const double rms = fidelity(view.model, view.mesh, view.cells.barrier, *ViewBarriers(view))[property].rms;
    return variance > 0 ? 1 - rms * rms / variance : missing;
}

double share_beyond_reach(const SceneCells& cells) {
    double beyond = 0;
    double all = 0;
    for (std::size_t c = 0; c < cells.mesh.cells.size(); ++c) {
        if (cells.in_gap[c] == 0) {
            std::array<double, 4> level{};
            for (std::size_t k = 0; k < 4; ++k) {
                level[k] = cells.extrapolation[cells.mesh.cells[c][k]];
            }
            const double volume = cells.volume(c);
            all += volume;
            beyond += volume * share_above(level, 1 - 1e-9);
        }
    }
    return all > 0 ? beyond / all : 0;
}

}  // namespace

std::string crs_title(const Frame& frame) {
    if (frame.crs_name.find("EPSG:") == std::string::npos) {
        if (const Crs crs = crs_from_wkt(frame.crs_wkt); !crs.name.empty()) {
            return crs.name;
        }
    }
    return frame.crs_name.empty() ? "local coordinates" : frame.crs_name;
}

std::string short_unit(const Frame& frame) {
    return frame.unit == "metre" ? "m" : frame.unit.find("foot") != std::string::npos ? "ft" : frame.unit;
}

std::string honesty(const Scene& scene, const ModelView& view) {
    const Model& model = view.model;
    const auto counted = [](std::size_t n, const char* what) { return grouped(n) + " " + what + (n == 1 ? "" : "s"); };
    std::string text = counted(model.samples.size(), "sample");
    if (!model.boreholes.empty()) {
        text += " in " + counted(model.boreholes.size(), "borehole");
    }
    if (scene.coloring.has_property() && !scene.coloring.categorical()) {
        if (const double r2 = r_squared(view, scene.coloring.index()); std::isfinite(r2)) {
            text += " · R² " + number_text(r2, 3) + " (" + scene.coloring.property().name + ")";
        }
    }
    if (!model.properties.empty()) {
        text += " · " + number_text(std::round(1000 * share_beyond_reach(scene.cells)) / 10, 3) +
                " % of the volume beyond the samples’ reach";
    }
    return text;
}

double height_stretch(const Model& model) {
    const Vec3 size = model.frame.to_world_size(model.domain.extent.size());
    const double wanted = 0.2 * std::max(size.x, size.y) / std::max(size.z, 1e-9);
    double stretch = 1;
    for (const double step : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
        stretch = wanted >= 0.75 * step ? step : stretch;
    }
    return stretch;
}

std::string scene_title(const ExportOptions& options, const std::string& path) {
    return options.title.empty() ? std::filesystem::path(path).stem().string() : options.title;
}

std::vector<double> sample_quartiles(const Model& model, std::size_t property) {
    std::vector<double> scaled = scaled_samples(model, property);
    std::sort(scaled.begin(), scaled.end());
    std::vector<double> levels;
    double last = scaled.empty() ? 0 : scaled.front();
    for (const double share : {0.25, 0.5, 0.75}) {
        if (!scaled.empty()) {
            const double level = scaled[static_cast<std::size_t>(share * static_cast<double>(scaled.size() - 1))];
            if (level > last && level < scaled.back()) {
                levels.push_back(from_scale(model.properties[property], level));
                last = level;
            }
        }
    }
    return levels;
}

}  // namespace terratet
