// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Boreholes as tubes, coloured by their samples' values: lines are one pixel wide in every web viewer, and some draw
/// none.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/write/scene/scene.hpp"

namespace terratet {
namespace {

constexpr std::size_t most_vertices = 60'000;  ///< of all tubes

/// A ring of the tube: where, and with which values.
struct Station {
    Vec3 position;
    double depth = 0;
    std::int64_t sample = -1;  ///< whose values it shows; −1: none
};

/// Thick enough to see, thin enough to tell neighbours apart.
double tube_radius(const Model& model) {
    const Vec3 side = model.frame.to_world_size(model.domain.extent.size());
    const double apart = std::sqrt(side.x * side.y / static_cast<double>(model.boreholes.size()));
    return std::min(0.005 * length(side), 0.08 * apart);
}

std::vector<std::vector<std::uint32_t>> samples_of_boreholes(const Model& model) {
    std::vector<std::vector<std::uint32_t>> result(model.boreholes.size());
    for (std::size_t s = 0; s < model.samples.size(); ++s) {
        if (const std::int32_t hole = model.samples.borehole[s]; hole >= 0) {
            result[static_cast<std::size_t>(hole)].push_back(static_cast<std::uint32_t>(s));
        }
    }
    return result;
}

/// The sample whose value stands for a depth: the nearest one, unless the depth is beyond all their intervals.
std::int64_t sample_at(const Samples& samples, const std::vector<std::uint32_t>& of_hole, double depth) {
    std::int64_t nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    bool before = false;
    bool after = false;
    for (const std::uint32_t s : of_hole) {
        const double away = samples.depth[s] - depth;
        before |= away <= 0.5 * samples.length[s];
        after |= away >= -0.5 * samples.length[s];
        if (std::abs(away) < least) {
            nearest = s;
            least = std::abs(away);
        }
    }
    return before && after ? nearest : -1;
}

/// Samples and the path's points, by depth.
std::vector<Station> stations_of(const Model& model, const Borehole& hole, const std::vector<std::uint32_t>& samples) {
    std::vector<Station> stations;
    for (const std::uint32_t s : samples) {
        stations.push_back({model.samples.positions[s], model.samples.depth[s], s});
    }
    for (std::size_t i = 0; i < hole.path.size(); ++i) {
        stations.push_back({hole.path[i], hole.path_depth[i], sample_at(model.samples, samples, hole.path_depth[i])});
    }
    std::stable_sort(stations.begin(), stations.end(),
                     [](const Station& a, const Station& b) { return a.depth < b.depth; });
    const auto same_place = [](const Station& a, const Station& b) { return a.position == b.position; };
    stations.erase(std::unique(stations.begin(), stations.end(), same_place), stations.end());
    return stations;
}

/// Where between two stations the colour changes at once, as a fraction; negative: it blends. Classes do not blend, and
/// what is beyond the samples does not take part in it.
double sharp_change(const Samples& samples, const Station& a, const Station& b, bool categorical) {
    if (a.sample == b.sample) {
        return -1;
    }
    if (a.sample >= 0 && b.sample >= 0) {
        return categorical ? 0.5 : -1;
    }
    const Station& known = a.sample >= 0 ? a : b;
    const double end = 0.5 * samples.length[static_cast<std::size_t>(known.sample)] / (b.depth - a.depth);
    return std::clamp(a.sample >= 0 ? end : 1 - end, 0.0, 1.0);
}

/// With a double station wherever the colour changes at once.
std::vector<Station> with_sharp_changes(const Samples& samples, const std::vector<Station>& stations,
                                        bool categorical) {
    std::vector<Station> result;
    for (std::size_t i = 0; i < stations.size(); ++i) {
        if (i > 0) {
            const Station& a = stations[i - 1];
            const Station& b = stations[i];
            if (const double f = sharp_change(samples, a, b, categorical); f >= 0) {
                const Vec3 place = a.position + f * (b.position - a.position);
                result.push_back({place, a.depth + f * (b.depth - a.depth), a.sample});
                result.push_back({place, a.depth + f * (b.depth - a.depth), b.sample});
            }
        }
        result.push_back(stations[i]);
    }
    return result;
}

/// How far a station's colour may be from what its neighbours give there, as a fraction of the map: further between
/// neighbours that are no farther from each other than the tube is thick, where the eye sees one spot.
constexpr double same_color = 0.015;
constexpr double same_spot = 0.1;
constexpr std::size_t longest_run = 200;  ///< of stations left out
constexpr double straight = 5e-3;         ///< of the tube's radius aside of the line from station to station

/// What a tube needs to look and read as before: stations where it bends, and where its colours stop being what the
/// stations about them give. The property's values are those of the samples, in the property's scale.
std::vector<Station> needed_stations(const std::vector<Station>& stations, const Model& model, const Coloring& coloring,
                                     double radius) {
    const auto shade = [&](const Station& station) {
        if (station.sample < 0 || !coloring.has_property()) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        const double s = to_scale(coloring.property(),
                                  model.samples.values[coloring.index()][static_cast<std::size_t>(station.sample)]);
        const ColorRange& range = coloring.range();
        return coloring.categorical() ? s : std::clamp((s - range.low) / (range.high - range.low), 0.0, 1.0);
    };
    const auto fits = [&](const Station& a, const Station& b, const Station& between) {
        const double t = b.depth > a.depth ? (between.depth - a.depth) / (b.depth - a.depth) : 0;
        const Vec3 aside = between.position - (a.position + t * (b.position - a.position));
        if (length(aside) > straight * radius) {
            return false;
        }
        const double tolerance = b.depth - a.depth <= 2 * radius ? same_spot : same_color;
        const double sa = shade(a);
        const double sb = shade(b);
        const double s = shade(between);
        if (std::isnan(s) || std::isnan(sa) || std::isnan(sb)) {
            return std::isnan(s) && std::isnan(sa) && std::isnan(sb);
        }
        return coloring.categorical() ? s == sa && s == sb : std::abs(sa + t * (sb - sa) - s) <= tolerance;
    };
    std::vector<Station> result{stations.front()};
    for (std::size_t i = 0; i + 1 < stations.size();) {
        std::size_t next = i + 1;  // the farthest that all between fit to
        while (next + 1 < stations.size() && next - i < longest_run &&
               std::all_of(stations.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                           stations.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                           [&](const Station& between) { return fits(stations[i], stations[next + 1], between); })) {
            ++next;
        }
        result.push_back(stations[next]);
        i = next;
    }
    return result;
}

/// A direction across `along`, as near to `previous` as can be: rings do not twist.
Vec3 across(const Vec3& along, const Vec3& previous) {
    Vec3 result = previous - dot(previous, along) * along;
    if (length(result) < 1e-6) {
        result = std::abs(along.x) < 0.9 ? cross(along, Vec3{1, 0, 0}) : cross(along, Vec3{0, 1, 0});
    }
    return result / length(result);
}

/// One borehole's. It is closed by rings of no radius, so that the triangles of a tube are the first ones of any longer
/// tube, and many can share them. It is not lit: its colours are the legend's.
class TubeBuilder {
  public:
    TubeBuilder(const Model& model, const Coloring& coloring, const SceneFrame& frame, double radius,
                std::uint32_t sides)
        : model_(model), coloring_(coloring), frame_(frame), radius_(radius), sides_(sides) {
        part_.kind = ScenePart::Kind::borehole;
        part_.values.resize(model.properties.size());
        part_.color = missing_color;
        part_.sides = sides;
    }

    ScenePart build(const Borehole& hole, const std::vector<Station>& stations) {
        part_.name = "borehole: " + hole.id;
        std::vector<Vec3> centers;
        for (const Station& station : stations) {
            centers.push_back(station.position);
        }
        centers = frame_.positions(centers);
        Vec3 right{1, 0, 0};
        for (std::size_t i = 0; i < centers.size(); ++i) {
            const Vec3 along = direction(centers, i);
            right = across(along, right);
            if (i == 0) {
                add_ring(centers[i], along, right, 0, stations[i]);
            }
            add_ring(centers[i], along, right, radius_, stations[i]);
            if (i + 1 == centers.size()) {
                add_ring(centers[i], along, right, 0, stations[i]);
            }
        }
        return std::move(part_);
    }

  private:
    /// Along the tube: between the neighbours that are not at the same place.
    static Vec3 direction(const std::vector<Vec3>& centers, std::size_t i) {
        std::size_t a = i;
        std::size_t b = i;
        while (a > 0 && centers[a] == centers[i]) {
            --a;
        }
        while (b + 1 < centers.size() && centers[b] == centers[i]) {
            ++b;
        }
        const Vec3 d = centers[b] - centers[a];
        return length(d) > 0 ? d / length(d) : Vec3{0, -1, 0};
    }

    void add_ring(const Vec3& center, const Vec3& along, const Vec3& right, double radius, const Station& station) {
        const auto first = static_cast<std::uint32_t>(part_.positions.size());
        for (std::uint32_t k = 0; k < sides_; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides_;
            part_.positions.push_back(center +
                                      radius * (std::cos(angle) * right + std::sin(angle) * cross(along, right)));
            part_.depth.push_back(station.depth);
            for (std::size_t p = 0; p < part_.values.size(); ++p) {
                part_.values[p].push_back(
                    station.sample < 0 ? missing : model_.samples.values[p][static_cast<std::size_t>(station.sample)]);
            }
            part_.colors.push_back(coloring_.has_property() ? coloring_.at(part_.values[coloring_.index()].back())
                                                            : missing_color);
        }
        if (first > 0) {
            join(first - sides_, first);
        }
    }

    void join(std::uint32_t lower, std::uint32_t upper) {
        for (std::uint32_t k = 0; k < sides_; ++k) {
            const std::uint32_t next = (k + 1) % sides_;
            part_.triangles.push_back({lower + k, lower + next, upper + next});
            part_.triangles.push_back({lower + k, upper + next, upper + k});
        }
    }

    const Model& model_;
    const Coloring& coloring_;
    const SceneFrame& frame_;
    double radius_;
    std::uint32_t sides_;
    ScenePart part_;
};

/// So many that a polygon for a circle is not seen in a picture of the whole, and not more than there is room for.
std::uint32_t sides_for(double radius, double scene_size, std::size_t rings) {
    const double tolerance = std::min(0.5, scene_size / 1500 / radius);
    const auto wanted = static_cast<std::size_t>(std::ceil(std::numbers::pi / std::acos(1 - tolerance)));
    return static_cast<std::uint32_t>(
        std::clamp<std::size_t>(std::min(wanted, most_vertices / std::max<std::size_t>(rings, 1)), 3, 8));
}

}  // namespace

std::vector<ScenePart> borehole_parts(const ModelView& view, const Coloring& coloring, const SceneFrame& frame) {
    const Model& model = view.model;
    if (model.boreholes.empty()) {
        return {};
    }
    const double radius = tube_radius(model);
    const auto samples = samples_of_boreholes(model);
    std::vector<std::vector<Station>> tubes;
    std::size_t rings = 0;
    for (std::size_t b = 0; b < model.boreholes.size(); ++b) {
        std::vector<Station> stations = stations_of(model, model.boreholes[b], samples[b]);
        if (stations.size() >= 2) {  // a point has no length to draw
            stations = needed_stations(with_sharp_changes(model.samples, stations, coloring.categorical()), model,
                                       coloring, radius);
        }
        rings += stations.size();
        tubes.push_back(std::move(stations));
    }
    const std::uint32_t sides = sides_for(radius, length(model.frame.to_world_size(model.domain.extent.size())), rings);
    std::vector<ScenePart> parts;
    for (std::size_t b = 0; b < tubes.size(); ++b) {
        if (tubes[b].size() >= 2) {
            parts.push_back(TubeBuilder(model, coloring, frame, radius * model.frame.metres_per_unit, sides)
                                .build(model.boreholes[b], tubes[b]));
            parts.back().feature = static_cast<std::int64_t>(b);
        }
    }
    return parts;
}

}  // namespace terratet
