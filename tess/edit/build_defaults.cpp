// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/build_defaults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "tess/edit/build_tolerance.hpp"
#include "tess/error.hpp"
#include "tess/site/site_box.hpp"

namespace terratet {

const Surface* domain_surface(const Site& site) {
    const auto found = std::ranges::find(site.surfaces, SurfaceKind::domain, &Surface::kind);
    return found == site.surfaces.end() ? nullptr : &*found;
}

namespace {

/// The highest point of the topography over the extent; −infinity without one.
double top_of_ground(const Site& site, const Box3& extent) {
    double top = -std::numeric_limits<double>::infinity();
    for (const Surface& surface : site.surfaces) {
        for (const Vec3& p : surface.vertices) {
            const bool over = p.x >= extent.lo.x && p.x <= extent.hi.x && p.y >= extent.lo.y && p.y <= extent.hi.y;
            top = surface.kind == SurfaceKind::topography && over ? std::max(top, p.z) : top;
        }
    }
    return top;
}

/// Draws the domain's outline, if there is one, to the walls' spacing. Throws InputError when nothing of it is left.
void draw_outline(const BuildOptions& options, Model& model, BuildReport& report) {
    const Surface* const domain = domain_surface(model);
    if (domain == nullptr) {
        return;
    }
    const double spacing = options.barriers.spacing > 0 ? options.barriers.spacing : model.criteria.l_min;
    OutlineReport drawn;
    model.domain.outline = outline_of(model.surfaces, spacing, drawn);
    std::ostringstream text;
    text.precision(6);
    if (model.domain.outline.empty()) {
        text << domain->file << ": the domain's area, " << drawn.area_in
             << ", is less than the square of the fault spacing, " << spacing
             << "; is its coordinate system right (srs=)? Else give a smaller `barriers.spacing`";
        throw InputError(text.str());
    }
    if (drawn.corners < drawn.corners_in) {
        text << domain->file << ": the domain is drawn to the fault spacing " << spacing << ": " << drawn.corners
             << " of " << drawn.corners_in << " corners are left, its boundary moved by " << drawn.deviation
             << " at most, its area by " << 100 * std::abs(drawn.area - drawn.area_in) / drawn.area_in << " %";
        if (drawn.dropped > 0) {
            text << "; " << drawn.dropped << " rings smaller than the spacing are left out";
        }
        report.diagnostics.note(text.str());
    }
}

/// The data's box in plan, or that of the domain and L_min more where that is smaller. Throws InputError when they are
/// apart.
Box3 bounded(Box3 extent, const Box3& data, const Model& model) {
    Box3 plan = bounding_box(model.domain.outline);
    for (const int axis : {0, 1}) {
        if (plan.hi[axis] < data.lo[axis] || plan.lo[axis] > data.hi[axis]) {
            const Vec3 lo = model.frame.to_world(plan.lo);
            const Vec3 hi = model.frame.to_world(plan.hi);
            std::ostringstream text;
            text.precision(9);
            text << domain_surface(model)->file << ": the domain, from (" << lo.x << ", " << lo.y << ") to (" << hi.x
                 << ", " << hi.y << "), lies wholly outside the "
                 << "data; is its coordinate system right? Name it with srs= after the file";
            throw InputError(text.str());
        }
        extent.lo[axis] = std::max(extent.lo[axis], plan.lo[axis] - model.criteria.l_min);
        extent.hi[axis] = std::min(extent.hi[axis], plan.hi[axis] + model.criteria.l_min);
    }
    return extent;
}

/// The data's box with what lies round it.
Box3 padded(const Box3& data, const BuildOptions& options, const Criteria& criteria) {
    if (options.pad >= 0) {
        return data.grown(options.pad);
    }
    const double height = data.size().z > 1e-6 * data.diagonal() ? data.size().z / 4 : criteria.l_max;
    const double width = data.diagonal() > 0 ? std::max(data.diagonal() / 2, criteria.l_min) : criteria.l_max;
    const double aside = std::min(criteria.l_max, width);  // else a longer l_max would make more cells, of padding
    const Vec3 margin{aside, aside, std::clamp(height, criteria.l_min, criteria.l_max)};
    return {data.lo - margin, data.hi + margin};
}

/// Far-off holes are most often slips: they set no default, and are named.
void note_far_off(const SiteBox& site, const Model& model, BuildReport& report) {
    constexpr std::size_t shown = 3;
    const bool few = site.far_off.size() <= shown;
    for (std::size_t i = 0; i < (few ? site.far_off.size() : shown); ++i) {
        const FarOff& far = site.far_off[i];
        const Vec3 world = model.frame.to_world(far.place);
        std::ostringstream note;
        note.precision(4);
        note << far.name << " lies " << far.distance * model.frame.metres_per_unit / 1000
             << " km from the others, at (";
        note.precision(10);
        note << world.x << ", " << world.y << ", " << world.z << ")"
             << (world.x == 0 && world.y == 0 ? ": no coordinates?" : ": are its coordinates right?")
             << " Resolution and extent do not follow it; give an `extent` that does if it is meant";
        report.diagnostics.note(note.str());
    }
    if (!few) {
        report.diagnostics.note(std::to_string(site.far_off.size() - shown) + " more lie as far from the others");
    }
}

/// Cells as long as the site is wide and as thin as it is high are slivers; in stretched z they are not.
void suggest_z_scale(const Box3& data, const Model& model, BuildReport& report) {
    if (const double scale = suitable_z_scale(data); scale > 1) {
        std::ostringstream note;
        note.precision(3);
        note << "the data are " << flatness(data) << " times as wide as high; consider `z_scale` "
             << model.frame.z_scale * scale;
        report.diagnostics.note(note.str());
    }
}

}  // namespace

void resolve_resolution(const BuildOptions& options, Model& model, BuildReport& report) {
    const SiteBox site = site_box(model, model.frame.metres_per_unit);
    const Box3& data = site.box;
    if (data.empty() && options.extent.empty()) {
        throw InputError("there is nothing to build from: no usable sample or borehole, and no `extent`");
    }
    const double diagonal = (options.extent.empty() ? data : options.extent).diagonal();
    model.criteria = options.criteria;
    if (model.criteria.l_min == 0) {
        model.criteria.l_min = diagonal > 0 ? diagonal / 100 : 1;
    }
    if (model.criteria.l_max == 0) {
        model.criteria.l_max = 4 * model.criteria.l_min;
    }
    model.criteria.variation.resize(model.properties.size());
    set_tolerance_defaults(options, diagonal, model);
    validate(model.criteria);
    draw_outline(options, model, report);
    Box3 extent = options.extent.empty() ? padded(data, options, model.criteria) : options.extent;
    if (!model.domain.outline.empty()) {
        const Box3 within = bounded(extent, options.extent.empty() ? data : extent, model);
        extent = options.extent.empty() ? within : extent;
    }
    if (options.extent.empty()) {
        extent.hi.z = std::max(extent.hi.z, top_of_ground(model, extent) + model.criteria.l_min);
    }
    extent = {model.frame.snapped(extent.lo), model.frame.snapped(extent.hi)};
    const Vec3 size = extent.size();
    if (std::min({size.x, size.y, size.z}) < model.criteria.l_min) {
        throw UsageError("the extent (" + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " +
                         std::to_string(size.z) + ") is thinner than `l_min` " + std::to_string(model.criteria.l_min) +
                         "; give a larger `extent` or `pad`, or a smaller `l_min`");
    }
    model.domain.extent = model.domain.hull = extent;
    note_far_off(site, model, report);
    suggest_z_scale(data, model, report);
}

}  // namespace terratet
