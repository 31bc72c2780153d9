// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Boreholes as tubes, coloured by their samples' values: lines are one pixel wide in every web viewer, and some draw
/// none.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/write/scene.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t sides = 10;

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

/// A direction across `along`, as near to `previous` as can be: rings do not twist.
Vec3 across(const Vec3& along, const Vec3& previous) {
    Vec3 result = previous - dot(previous, along) * along;
    if (length(result) < 1e-6) {
        result = std::abs(along.x) < 0.9 ? cross(along, Vec3{1, 0, 0}) : cross(along, Vec3{0, 1, 0});
    }
    return result / length(result);
}

class TubeBuilder {
  public:
    TubeBuilder(const Model& model, const SceneFrame& frame) : model_(model), frame_(frame) {
        part_.name = "boreholes";
        part_.values.resize(model.properties.size());
        part_.colored = true;
        radius_ = tube_radius(model) * model.frame.metres_per_unit;
    }

    void add(const std::vector<Station>& stations) {
        std::vector<Vec3> centers;
        for (const Station& station : stations) {
            centers.push_back(frame_.position(station.position));
        }
        const std::size_t last = centers.size() - 1;
        Vec3 along = direction(centers, 0);
        Vec3 right = across(along, {1, 0, 0});
        cap(centers[0], along, right, stations[0], -1);
        for (std::size_t i = 0; i <= last; ++i) {
            along = direction(centers, i);
            right = across(along, right);
            const std::uint32_t ring = add_ring(centers[i], along, right, stations[i]);
            if (i > 0) {
                join(ring - sides, ring);
            }
        }
        cap(centers[last], along, right, stations[last], 1);
    }

    ScenePart take() { return std::move(part_); }

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
        return d / length(d);
    }

    void add_vertex(const Vec3& position, const Vec3& normal, const Station& station) {
        part_.positions.push_back(position);
        part_.normals.push_back(normal);
        for (std::size_t p = 0; p < part_.values.size(); ++p) {
            part_.values[p].push_back(
                station.sample < 0 ? missing : model_.samples.values[p][static_cast<std::size_t>(station.sample)]);
        }
    }

    [[nodiscard]] static Vec3 spoke(std::uint32_t k, const Vec3& along, const Vec3& right) {
        const double angle = 2 * std::numbers::pi * k / sides;
        return std::cos(angle) * right + std::sin(angle) * cross(along, right);
    }

    std::uint32_t add_ring(const Vec3& center, const Vec3& along, const Vec3& right, const Station& station) {
        const auto first = static_cast<std::uint32_t>(part_.positions.size());
        for (std::uint32_t k = 0; k < sides; ++k) {
            const Vec3 normal = spoke(k, along, right);
            add_vertex(center + radius_ * normal, normal, station);
        }
        return first;
    }

    void join(std::uint32_t lower, std::uint32_t upper) {
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t next = (k + 1) % sides;
            part_.triangles.push_back({lower + k, lower + next, upper + next});
            part_.triangles.push_back({lower + k, upper + next, upper + k});
        }
    }

    /// A disc; `sense` +1 where the tube ends, −1 where it begins.
    void cap(const Vec3& center, const Vec3& along, const Vec3& right, const Station& station, int sense) {
        const auto first = static_cast<std::uint32_t>(part_.positions.size());
        add_vertex(center, sense * along, station);
        for (std::uint32_t k = 0; k < sides; ++k) {
            add_vertex(center + radius_ * spoke(k, along, right), sense * along, station);
        }
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t a = first + 1 + k;
            const std::uint32_t b = first + 1 + (k + 1) % sides;
            part_.triangles.push_back(sense > 0 ? Triangle{first, a, b} : Triangle{first, b, a});
        }
    }

    const Model& model_;
    const SceneFrame& frame_;
    double radius_ = 0;
    ScenePart part_;
};

}  // namespace

ScenePart borehole_tubes(const ModelView& view, const Coloring& coloring, const SceneFrame& frame) {
    const Model& model = view.model;
    if (model.boreholes.empty()) {
        return {};
    }
    TubeBuilder builder(model, frame);
    const auto samples = samples_of_boreholes(model);
    for (std::size_t b = 0; b < model.boreholes.size(); ++b) {
        const std::vector<Station> stations = stations_of(model, model.boreholes[b], samples[b]);
        if (stations.size() >= 2) {  // a point has no length to draw
            builder.add(with_sharp_changes(model.samples, stations, coloring.categorical()));
        }
    }
    return builder.take();
}

}  // namespace terratet
