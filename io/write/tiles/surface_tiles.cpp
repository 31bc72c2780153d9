// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/tiles/surface_tiles.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>

#include "io/write/tiles/tube_rings.hpp"

namespace terratet {
namespace {

constexpr int deepest = 12;
constexpr double worth_a_level = 0.7;  ///< of the triangles below: a level with more is left out

/// A tile on its way, with the full surfaces that it stands for.
struct Branch {
    SurfaceTile tile;
    std::map<std::uint32_t, std::vector<Triangle>> full;  ///< by part; of boreholes nothing
};

std::size_t count(const std::vector<ScenePart>& parts, const std::vector<TilePart>& shown) {
    std::size_t sum = 0;
    for (const TilePart& part : shown) {
        sum += part.triangles.size();
        sum += part.rings.empty() ? 0 : 2 * parts[part.part].sides * (part.rings.size() - 1);
    }
    return sum;
}

class Builder {
  public:
    Builder(const std::vector<ScenePart>& parts, const SurfaceTileOptions& options, const Progress& progress)
        : parts_(parts), options_(options), progress_(progress) {}

    SurfaceTile build() {
        std::vector<TilePart> all;
        Box3 box;
        for (std::uint32_t p = 0; p < parts_.size(); ++p) {
            const ScenePart& part = parts_[p];
            if (part.triangles.empty()) {
                continue;
            }
            for (const Vec3& at : part.positions) {
                box.extend(at);
            }
            TilePart whole{p, {}, {}};
            if (part.sides > 0) {
                weights_[p] = ring_weights(part, options_.color_metres);
                for (std::uint32_t r = 0; r < weights_[p].size(); ++r) {
                    whole.rings.push_back(r);
                }
            } else {
                whole.triangles = part.triangles;
            }
            all.push_back(std::move(whole));
        }
        whole_ = std::max<std::size_t>(1, count(parts_, all));
        Branch root = split(std::move(all), box, 0);
        while (count(parts_, root.tile.parts) > options_.coarsest) {
            const std::size_t before = count(parts_, root.tile.parts);
            std::vector<Branch> below;
            below.push_back(std::move(root));
            root = above(std::move(below));
            if (static_cast<double>(count(parts_, root.tile.parts)) > worth_a_level * static_cast<double>(before)) {
                SurfaceTile only = std::move(root.tile.children.front());
                return only;
            }
        }
        return std::move(root.tile);
    }

  private:
    Branch split(std::vector<TilePart> shown, const Box3& box, int depth) {
        const std::size_t triangles = count(parts_, shown);
        const bool divisible =
            std::ranges::any_of(shown, [](const TilePart& p) { return !p.triangles.empty(); }) || shown.size() > 1;
        if (triangles <= options_.most_triangles || depth == deepest || !divisible) {
            return leaf(std::move(shown), triangles);
        }
        std::array<std::vector<TilePart>, 8> octants;
        for (TilePart& part : shown) {
            share_out(part, box.center(), octants);
        }
        shown.clear();
        std::vector<Branch> below;
        for (std::size_t n = 0; n < 8; ++n) {
            if (!octants[n].empty()) {
                Box3 part_of_box = box;
                for (int axis = 0; axis < 3; ++axis) {
                    (n >> axis & 1 ? part_of_box.lo : part_of_box.hi)[axis] = box.center()[axis];
                }
                below.push_back(split(std::move(octants[n]), part_of_box, depth + 1));
            }
        }
        return below.size() == 1 ? std::move(below.front()) : above(std::move(below));
    }

    Branch leaf(std::vector<TilePart> shown, std::size_t triangles) {
        done_ += triangles;
        report_progress(progress_, "write tiles", 0.8 * static_cast<double>(done_) / static_cast<double>(whole_));
        Branch branch;
        for (const TilePart& part : shown) {
            if (part.rings.empty()) {
                branch.full[part.part] = part.triangles;
                for (const Triangle& t : part.triangles) {
                    for (const std::uint32_t v : t) {
                        branch.tile.box.extend(parts_[part.part].positions[v]);
                    }
                }
            } else {
                for (const Vec3& at : parts_[part.part].positions) {
                    branch.tile.box.extend(at);
                }
            }
        }
        branch.tile.parts = std::move(shown);
        return branch;
    }

    /// A borehole goes where its middle is, whole.
    void share_out(const TilePart& part, const Vec3& middle, std::array<std::vector<TilePart>, 8>& octants) const {
        const std::vector<Vec3>& at = parts_[part.part].positions;
        const auto octant = [&](const Vec3& p) {
            return static_cast<std::size_t>(p.x >= middle.x) + 2 * static_cast<std::size_t>(p.y >= middle.y) +
                   4 * static_cast<std::size_t>(p.z >= middle.z);
        };
        if (!part.rings.empty()) {
            octants[octant(0.5 * (at.front() + at.back()))].push_back(part);
            return;
        }
        for (const Triangle& t : part.triangles) {
            auto& to = octants[octant((at[t[0]] + at[t[1]] + at[t[2]]) / 3)];
            if (to.empty() || to.back().part != part.part) {
                to.push_back({part.part, {}, {}});
            }
            to.back().triangles.push_back(t);
        }
    }

    /// What shows all of them with fewer triangles.
    Branch above(std::vector<Branch> below) {
        std::map<std::uint32_t, TilePart> merged;
        Branch result;
        for (Branch& branch : below) {
            for (const TilePart& part : branch.tile.parts) {
                TilePart& to = merged.try_emplace(part.part, TilePart{part.part, {}, {}}).first->second;
                to.triangles.insert(to.triangles.end(), part.triangles.begin(), part.triangles.end());
                if (!part.rings.empty()) {
                    to.rings = part.rings;
                }
            }
            for (auto& [part, triangles] : branch.full) {
                auto& to = result.full[part];
                to.insert(to.end(), triangles.begin(), triangles.end());
            }
            result.tile.deviation.extend(branch.tile.deviation);
            result.tile.box.extend(branch.tile.box.lo);
            result.tile.box.extend(branch.tile.box.hi);
            result.tile.children.push_back(std::move(branch.tile));
        }
        for (auto& [index, part] : merged) {
            result.tile.parts.push_back(std::move(part));
        }
        const std::size_t before = count(parts_, result.tile.parts);
        const double share = std::min(0.25, static_cast<double>(options_.most_triangles) / static_cast<double>(before));
        coarsen(result, share);
        return result;
    }

    void coarsen(Branch& branch, double share) {
        const double heaviest = ring_weight_to_keep(branch.tile.parts, share);
        for (TilePart& part : branch.tile.parts) {
            report_progress(progress_, "write tiles", 0.8 * static_cast<double>(done_) / static_cast<double>(whole_));
            const ScenePart& whole = parts_[part.part];
            if (!part.rings.empty()) {
                const std::vector<double>& weights = weights_[part.part];
                std::erase_if(part.rings, [&](std::uint32_t ring) { return weights[ring] <= heaviest; });
                branch.tile.deviation.extend(tube_deviation(whole, part.rings, options_.color_metres));
                continue;
            }
            const SurfaceLook look{whole.positions, whole.colors, options_.color_metres};
            const auto most = static_cast<std::size_t>(share * static_cast<double>(part.triangles.size()));
            part.triangles = simplify_surface(look, std::move(part.triangles), most);
            branch.tile.deviation.extend(surface_deviation(look, branch.full[part.part], part.triangles));
        }
    }

    /// Without the rings of no more than this weight a share of them is left.
    [[nodiscard]] double ring_weight_to_keep(const std::vector<TilePart>& parts, double share) const {
        std::vector<double> weights;
        for (const TilePart& part : parts) {
            for (const std::uint32_t ring : part.rings) {
                weights.push_back(weights_.at(part.part)[ring]);
            }
        }
        if (weights.empty()) {
            return 0;
        }
        const auto kept = static_cast<std::ptrdiff_t>(share * static_cast<double>(weights.size()));
        std::ranges::nth_element(weights, weights.begin() + kept, std::greater<>());
        return std::min(weights[static_cast<std::size_t>(kept)], std::numeric_limits<double>::max());
    }

    const std::vector<ScenePart>& parts_;
    const SurfaceTileOptions& options_;
    const Progress& progress_;
    std::map<std::uint32_t, std::vector<double>> weights_;  ///< of the rings of boreholes
    std::size_t whole_ = 1;                                 ///< triangles of all
    std::size_t done_ = 0;
};

template <class T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::uint32_t>& which) {
    std::vector<T> result;
    if (!all.empty()) {
        for (const std::uint32_t v : which) {
            result.push_back(all[v]);
        }
    }
    return result;
}

}  // namespace

SurfaceTile surface_tiles(const std::vector<ScenePart>& parts, const SurfaceTileOptions& options,
                          const Progress& progress) {
    return Builder(parts, options, progress).build();
}

ScenePart shown(const ScenePart& part, const TilePart& of_tile) {
    ScenePart result;
    result.name = part.name;
    result.kind = part.kind;
    result.color = part.color;
    result.opacity = part.opacity;
    result.feature = part.feature;
    result.sides = part.sides;
    result.property = part.property;
    result.level = part.level;
    result.triangles = of_tile.rings.empty() ? of_tile.triangles : tube_triangles(part, of_tile.rings);
    std::vector<std::uint32_t> used;
    for (const Triangle& t : result.triangles) {
        used.insert(used.end(), t.begin(), t.end());
    }
    std::ranges::sort(used);
    const auto rest = std::ranges::unique(used);
    used.erase(rest.begin(), rest.end());
    for (Triangle& t : result.triangles) {
        for (std::uint32_t& v : t) {
            v = static_cast<std::uint32_t>(std::ranges::lower_bound(used, v) - used.begin());
        }
    }
    result.positions = chosen(part.positions, used);
    result.normals = chosen(part.normals, used);
    result.colors = chosen(part.colors, used);
    result.extrapolation = chosen(part.extrapolation, used);
    result.depth = chosen(part.depth, used);
    for (const std::vector<double>& values : part.values) {
        result.values.push_back(chosen(values, used));
    }
    return result;
}

}  // namespace terratet
