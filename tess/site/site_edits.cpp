// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/site_edits.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::size_t most_named = 8;  ///< in a message

bool removable(const Surface& surface) {
    return !is_bound(surface.kind);
}

/// Which of the site's properties another's is; −1: none.
std::vector<std::int64_t> matched_properties(const Site& site, const Site& other, std::vector<std::string>& unknown) {
    std::vector<std::int64_t> match;
    for (const Property& property : other.properties) {
        const auto found = std::ranges::find(site.properties, property.name, &Property::name);
        match.push_back(found == site.properties.end() ? -1 : found - site.properties.begin());
        if (match.back() < 0) {
            unknown.push_back(property.name);
        } else if (found->kind != property.kind) {
            throw UsageError("property '" + property.name + "' is " +
                             (found->kind == Kind::categorical ? "a category" : "a number") +
                             " in the model, and not so in what is added");
        }
    }
    return match;
}

/// The same class in the site's property, added there if it is new.
double class_in(Property& property, const std::string& name) {
    const auto found = std::ranges::find(property.classes, name);
    const auto index = found - property.classes.begin();
    if (found == property.classes.end()) {
        property.classes.push_back(name);
    }
    return static_cast<double>(index);
}

void require_new_names(const Site& site, const Site& other) {
    for (const Borehole& borehole : other.boreholes) {
        if (std::ranges::find(site.boreholes, borehole.id, &Borehole::id) != site.boreholes.end()) {
            throw UsageError("borehole '" + borehole.id + "' is in the model already; remove it first");
        }
    }
    for (const Surface& surface : other.surfaces) {
        if (!removable(surface)) {
            throw UsageError(std::string(to_string(surface.kind)) + " '" + surface.name +
                             "' cannot be added to a model: build it anew");
        }
        if (std::ranges::find(site.surfaces, surface.name, &Surface::name) != site.surfaces.end()) {
            throw UsageError("surface '" + surface.name + "' is in the model already; replace or remove it");
        }
    }
}

Vec3 brought(const Vec3& p, const Frame& from, const Frame& to) {
    const Vec3 local = to.snapped(to.to_local(from.to_world(p)));
    if (!is_acceptable(local)) {
        throw UsageError("a place lies beyond " + std::to_string(max_coordinate) + " from the model's origin");
    }
    return local;
}

}  // namespace

std::size_t find_borehole(const Site& site, const std::string& id) {
    const auto found = std::ranges::find(site.boreholes, id, &Borehole::id);
    if (found == site.boreholes.end()) {
        const auto known = names_of(site.boreholes, &Borehole::id);
        throw UsageError("there is no borehole '" + id + "'; there is " + listed(known, most_named) +
                         did_you_mean(id, known));
    }
    return static_cast<std::size_t>(found - site.boreholes.begin());
}

void remove_borehole(Site& site, const std::string& id) {
    const auto hole = static_cast<std::int32_t>(find_borehole(site, id));
    std::vector<bool> marked(site.samples.size());
    for (std::size_t i = 0; i < marked.size(); ++i) {
        marked[i] = site.samples.borehole[i] == hole;
    }
    remove_samples(site, marked);
    site.boreholes.erase(site.boreholes.begin() + hole);
    for (std::int32_t& owner : site.samples.borehole) {
        owner -= owner > hole ? 1 : 0;
    }
}

void move_borehole(Site& site, const std::string& id, const Vec3& by) {
    const std::size_t hole = find_borehole(site, id);
    Borehole moved = site.boreholes[hole];
    const auto place = [&](const Vec3& p) {
        const Vec3 next = site.frame.snapped(p + by);
        if (!is_acceptable(next)) {
            throw UsageError("borehole '" + id + "' would lie beyond " + std::to_string(max_coordinate));
        }
        return next;
    };
    moved.collar = place(moved.collar);
    std::ranges::transform(moved.path, moved.path.begin(), place);
    std::vector<Vec3> positions = site.samples.positions;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (site.samples.borehole[i] == static_cast<std::int32_t>(hole)) {
            positions[i] = place(positions[i]);
        }
    }
    site.boreholes[hole] = std::move(moved);
    site.samples.positions = std::move(positions);
}

void remove_surface(Site& site, const std::string& name) {
    const auto named = [&](const Surface& surface) { return surface.name == name && removable(surface); };
    if (std::erase_if(site.surfaces, named) == 0) {
        const auto known = names_of(site.surfaces | std::views::filter(removable), &Surface::name);
        throw UsageError("there is no surface '" + name + "' that can be removed; there is " +
                         listed(known, most_named) + did_you_mean(name, known));
    }
}

void remove_samples(Site& site, const std::vector<bool>& marked) {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < marked.size(); ++i) {
        if (!marked[i]) {
            kept.push_back(i);
        }
    }
    site.samples = selected(site.samples, kept);
}

std::vector<std::string> add_site(Site& site, const Site& other) {
    std::vector<std::string> unknown;
    const auto match = matched_properties(site, other, unknown);
    require_new_names(site, other);
    Site next = site;
    const auto first_hole = static_cast<std::int32_t>(next.boreholes.size());
    const auto here = [&](const Vec3& p) { return brought(p, other.frame, next.frame); };
    for (Borehole borehole : other.boreholes) {
        borehole.collar = here(borehole.collar);
        std::ranges::transform(borehole.path, borehole.path.begin(), here);
        next.boreholes.push_back(std::move(borehole));
    }
    for (Surface surface : other.surfaces) {
        std::ranges::transform(surface.vertices, surface.vertices.begin(), here);
        next.surfaces.push_back(std::move(surface));
    }
    Samples& samples = next.samples;
    const std::size_t first = samples.size();
    for (std::size_t i = 0; i < other.samples.size(); ++i) {
        const std::int32_t hole = other.samples.borehole[i];
        samples.positions.push_back(here(other.samples.positions[i]));
        samples.borehole.push_back(hole < 0 ? -1 : first_hole + hole);
        samples.depth.push_back(other.samples.depth[i]);
        samples.length.push_back(other.samples.length[i]);
    }
    for (auto& column : samples.values) {
        column.resize(samples.size(), missing);
    }
    for (auto& column : samples.censored) {
        column.resize(samples.size(), Censoring::none);
    }
    for (std::size_t p = 0; p < match.size(); ++p) {
        if (match[p] < 0) {
            continue;
        }
        const auto to = static_cast<std::size_t>(match[p]);
        for (std::size_t i = 0; i < other.samples.size(); ++i) {
            const double value = other.samples.values[p][i];
            const bool category = other.properties[p].kind == Kind::categorical && !std::isnan(value);
            samples.values[to][first + i] =
                category ? class_in(next.properties[to], other.properties[p].classes[static_cast<std::size_t>(value)])
                         : value;
            if (const Censoring censoring = other.samples.censoring(p, i); censoring != Censoring::none) {
                samples.set_censoring(to, first + i, censoring);
            }
        }
    }
    site = std::move(next);
    return unknown;
}

}  // namespace terratet
