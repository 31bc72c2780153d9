// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/sheet_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "tess/barrier/complex/measure_sheet.hpp"

namespace terratet {
namespace {

constexpr double zip = 0.15;          ///< in edge lengths: sheets nearer to each other than that become one
constexpr double widest_exact = 1.5;  ///< radians: the seeds of right-angled neighbours would coincide

/// Which connected piece each triangle belongs to.
std::vector<std::uint32_t> pieces_of(const SheetComplex& complex) {
    std::vector<std::uint32_t> parent(complex.points.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) {
            v = parent[v] = parent[parent[v]];
        }
        return v;
    };
    for (const Triangle& t : complex.triangles) {
        for (const std::uint32_t v : {t[1], t[2]}) {
            const auto [low, high] = std::minmax({root(t[0]), root(v)});
            parent[high] = low;
        }
    }
    std::vector<std::uint32_t> piece;
    for (const Triangle& t : complex.triangles) {
        piece.push_back(root(t[0]));
    }
    return piece;
}

SheetComplex only(const SheetComplex& complex, const std::vector<char>& active) {
    SheetComplex result{complex.points, {}, {}};
    for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
        if (active[complex.sheet[t]] != 0) {
            result.triangles.push_back(complex.triangles[t]);
            result.sheet.push_back(complex.sheet[t]);
        }
    }
    compact(result);
    return result;
}

void append(SheetComplex& to, const SheetComplex& more) {
    const auto offset = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), more.points.begin(), more.points.end());
    for (const Triangle& t : more.triangles) {
        to.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    to.sheet.insert(to.sheet.end(), more.sheet.begin(), more.sheet.end());
}

}  // namespace

SheetMesher::SheetMesher(SheetComplex cut, double spacing, SeedMode mode, std::vector<char> bounds)
    : cut_(std::move(cut)), mode_(mode), bounds_(std::move(bounds)), sizes_(spacing) {}

SheetRemesher::Result SheetMesher::mesh(const Poll& poll) {
    if (!remesher_ || (!staying_.triangles.empty() && !sizes_.uniform())) {
        staying_ = {};
        remesher_ = std::make_unique<SheetRemesher>(
            sizes_.uniform() ? without_staying() : cut_, sizes_, zip,
            mode_ == SeedMode::exact ? SheetRemesher::Contract::where_changed : SheetRemesher::Contract::everywhere,
            bounds_);
    }
    SheetRemesher::Result result = remesher_->pass(poll);
    append(result.complex, staying_);
    triangles_ = result.complex.triangles.size();
    first_triangles_ = first_triangles_ == 0 ? triangles_ : first_triangles_;
    return result;
}

/// Puts the pieces that may stay into staying_, and returns the others.
SheetComplex SheetMesher::without_staying() {
    const std::vector<std::uint32_t> piece_of = pieces_of(cut_);
    std::map<std::uint32_t, TriMesh> pieces;
    for (std::uint32_t t = 0; t < cut_.triangles.size(); ++t) {
        pieces[piece_of[t]].triangles.push_back(cut_.triangles[t]);
    }
    std::map<std::uint32_t, bool> stays;
    for (auto& [number, piece] : pieces) {
        piece.points = cut_.points;
        compact(piece);
        stays[number] = suits(piece, sizes_.spacing(), mode_ == SeedMode::exact ? widest_exact : std::numbers::pi);
    }
    const EdgeTable edges(cut_.triangles);
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        if (of_edge.size() > 1 && !is_smooth(cut_, of_edge)) {
            stays[piece_of[of_edge[0]]] = false;
        }
    }
    SheetComplex changing{cut_.points, {}, {}};
    staying_ = {cut_.points, {}, {}};
    for (std::uint32_t t = 0; t < cut_.triangles.size(); ++t) {
        SheetComplex& to = stays[piece_of[t]] ? staying_ : changing;
        to.triangles.push_back(cut_.triangles[t]);
        to.sheet.push_back(cut_.sheet[t]);
    }
    compact(changing);
    compact(staying_);
    return changing;
}

void SheetMesher::want(const std::vector<WantedSize>& wishes) {
    for (const WantedSize& wish : wishes) {
        sizes_.refine(wish.place.position, wish.size);
        wishes_.push_back(wish);
    }
}

bool SheetMesher::refine(const std::vector<FinerPlace>& places, int halvings) {
    const double finest = std::ldexp(sizes_.spacing(), -halvings);
    std::vector<WantedSize> wishes;
    for (const FinerPlace& place : places) {
        if (const double here = sizes_.at(place.position); here > 1.01 * finest) {
            wishes.push_back({place, std::max(finest, 0.5 * here)});
        }
    }
    want(wishes);
    return !wishes.empty();
}

void SheetMesher::keep(const std::vector<char>& active) {
    cut_ = only(cut_, active);
    staying_ = only(staying_, active);
    if (remesher_) {
        remesher_->keep(active);
    }
    sizes_ = SizeField(sizes_.spacing());
    std::vector<WantedSize> wishes = std::move(wishes_);
    wishes_.clear();
    std::erase_if(wishes, [&](const WantedSize& wish) {
        return std::ranges::any_of(wish.place.surfaces, [&](std::uint32_t k) { return active[k] == 0; });
    });
    want(wishes);
}

}  // namespace terratet
