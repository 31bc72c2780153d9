// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/scene_cells.hpp"
#include "tess/base/no_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace terratet {
namespace {

/// Between two places of one cell.
CellPlace between(const CellPlace& a, const CellPlace& b, double t) {
    CellPlace result;
    std::size_t n = 0;
    const auto add = [&](const CellPlace& place, double share) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (place.weight[k] == 0 || share == 0) {
                continue;
            }
            const auto end = result.point.begin() + static_cast<std::ptrdiff_t>(n);
            const auto found = std::find(result.point.begin(), end, place.point[k]);
            if (found == end && n == 4) {
                continue;  // a weight that is no more than rounding
            }
            const auto at = static_cast<std::size_t>(found - result.point.begin());
            n += found == end ? 1 : 0;
            result.point[at] = place.point[k];
            result.weight[at] += share * place.weight[k];
        }
    };
    add(a, 1 - t);
    add(b, t);
    return result;
}

double weight_of(const CellPlace& place, std::uint32_t point) {
    for (std::size_t k = 0; k < 4; ++k) {
        if (place.weight[k] != 0 && place.point[k] == point) {
            return place.weight[k];
        }
    }
    return 0;
}

/// What of a convex polygon has f ≥ 0 (Sutherland and Hodgman).
template <class F>
std::vector<CellPlace> clipped(const std::vector<CellPlace>& polygon, F&& f) {
    std::vector<CellPlace> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const CellPlace& a = polygon[i];
        const CellPlace& b = polygon[(i + 1) % polygon.size()];
        const double fa = f(a);
        const double fb = f(b);
        if (fa >= 0) {
            result.push_back(a);
        }
        if ((fa > 0 && fb < 0) || (fa < 0 && fb > 0)) {
            result.push_back(between(a, b, fa / (fa - fb)));
        }
    }
    return result;
}

}  // namespace

std::vector<double> SceneCells::scaled(std::size_t property) const {
    std::vector<double> result;
    result.reserve(values[property].size());
    for (const double value : values[property]) {
        result.push_back(to_scale(model->properties[property], value));
    }
    return result;
}

double SceneCells::volume(std::size_t cell) const {
    const auto& v = mesh.cells[cell];
    const Vec3& d = mesh.points[v[3]];
    const double six = std::abs(dot(mesh.points[v[0]] - d, cross(mesh.points[v[1]] - d, mesh.points[v[2]] - d)));
    return six / 6 / model->frame.z_scale;
}

SceneCells scene_cells(const ModelView& view, const Progress& progress, ClippedCells which) {
    SceneCells cells{&view.model, clip_to_extent(view, which, progress), {}, {}, {}, view.cells.region_name};
    for (std::size_t p = 0; p < view.model.properties.size(); ++p) {
        cells.values.push_back(cells.mesh.values(view.model, p));
    }
    cells.extrapolation = view.model.vertex_values.extrapolation.empty()
                              ? std::vector<double>(cells.mesh.points.size(), 0)
                              : cells.mesh.extrapolation(view.model);
    for (const std::uint32_t parent : cells.mesh.parent) {
        cells.in_gap.push_back(view.cells.barrier[parent] >= 0 || view.cells.beyond[parent] != 0 ? 1 : 0);
    }
    return cells;
}

double CellPlace::level(std::span<const double> of_points) const {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        sum += weight[k] != 0 ? weight[k] * of_points[point[k]] : 0;
    }
    return sum;
}

std::uint32_t CellPlace::nearest() const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < 4; ++k) {
        if (weight[k] > weight[best] || (weight[k] == weight[best] && weight[k] > 0 && point[k] < point[best])) {
            best = k;
        }
    }
    return point[best];
}

std::vector<Vec3> CutTriangles::positions(const SceneCells& cells) const {
    std::vector<Vec3> result;
    result.reserve(places.size());
    for (const CellPlace& place : places) {
        Vec3 sum;
        for (std::size_t k = 0; k < 4; ++k) {
            sum = sum + place.weight[k] * cells.mesh.points[place.point[k]];
        }
        result.push_back(sum);
    }
    return result;
}

std::vector<double> CutTriangles::values(const SceneCells& cells, std::size_t property) const {
    const Property& p = cells.model->properties[property];
    std::vector<double> result;
    result.reserve(places.size());
    const std::vector<double> scaled = cells.scaled(property);
    for (const CellPlace& place : places) {
        const bool whole = *std::max_element(place.weight.begin(), place.weight.end()) == 1;
        result.push_back(p.kind == Kind::categorical || whole ? cells.values[property][place.nearest()]
                                                              : from_scale(p, place.level(scaled)));
    }
    return result;
}

std::vector<double> CutTriangles::extrapolation(const SceneCells& cells) const {
    std::vector<double> result;
    result.reserve(places.size());
    for (const CellPlace& place : places) {
        result.push_back(std::clamp(place.level(cells.extrapolation), 0.0, 1.0));
    }
    return result;
}

void CutTriangles::drop_unused_places() {
    std::vector<std::uint32_t> index(places.size(), no_index);
    std::vector<CellPlace> kept;
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& corner : triangle) {
            if (index[corner] == no_index) {
                index[corner] = static_cast<std::uint32_t>(kept.size());
                kept.push_back(places[corner]);
            }
            corner = index[corner];
        }
    }
    places = std::move(kept);
}

CutTriangles cut_triangles(const CellCut& cut) {
    CutTriangles result;
    result.places.reserve(cut.corners.size());
    for (const auto& [a, b, t] : cut.corners) {
        result.places.push_back(a == b ? CellPlace{{a}, {1}} : CellPlace{{a, b}, {1 - t, t}});
    }
    result.triangles = cut.triangles;
    result.cell = cut.cell;
    return result;
}

CutTriangles part_above(const CutTriangles& all, std::span<const double> level, double at) {
    std::vector<double> above;
    above.reserve(all.places.size());
    for (const CellPlace& place : all.places) {
        above.push_back(place.level(level) - at);
    }
    CutTriangles result;
    result.places = all.places;
    std::unordered_map<std::uint64_t, std::uint32_t> on_edge;
    const auto crossing = [&](std::uint32_t u, std::uint32_t v) {
        const auto [a, b] = std::minmax({u, v});
        const auto [entry, fresh] =
            on_edge.try_emplace(std::uint64_t{a} << 32 | b, static_cast<std::uint32_t>(result.places.size()));
        if (fresh) {
            result.places.push_back(between(all.places[a], all.places[b], above[a] / (above[a] - above[b])));
        }
        return entry->second;
    };
    std::vector<std::uint32_t> polygon;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        polygon.clear();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = all.triangles[t][k];
            const std::uint32_t b = all.triangles[t][(k + 1) % 3];
            if (above[a] >= 0) {
                polygon.push_back(a);
            }
            if ((above[a] > 0 && above[b] < 0) || (above[a] < 0 && above[b] > 0)) {
                polygon.push_back(crossing(a, b));
            }
        }
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            result.triangles.push_back({polygon[0], polygon[k], polygon[k + 1]});
            result.cell.push_back(all.cell[t]);
        }
    }
    result.drop_unused_places();
    return result;
}

CutTriangles by_nearest_point(const SceneCells& cells, const CutTriangles& all, std::vector<std::uint32_t>& owner) {
    CutTriangles result;
    owner.clear();
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        const auto& [a, b, c] = all.triangles[t];
        for (const std::uint32_t own : cells.mesh.cells[all.cell[t]]) {
            std::vector<CellPlace> polygon{all.places[a], all.places[b], all.places[c]};
            for (const std::uint32_t other : cells.mesh.cells[all.cell[t]]) {
                if (other != own) {
                    polygon = clipped(polygon, [&](const CellPlace& place) {
                        return weight_of(place, own) - weight_of(place, other);
                    });
                }
            }
            const auto first = static_cast<std::uint32_t>(result.places.size());
            for (std::uint32_t k = 1; k + 1 < polygon.size(); ++k) {
                result.triangles.push_back({first, first + k, first + k + 1});
                result.cell.push_back(all.cell[t]);
            }
            if (polygon.size() >= 3) {
                result.places.insert(result.places.end(), polygon.begin(), polygon.end());
                owner.insert(owner.end(), polygon.size(), own);
            }
        }
    }
    return result;
}

}  // namespace terratet
