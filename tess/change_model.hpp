// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model into another by a local change of its tessellation, without building it anew (DESIGN §4.5): boreholes,
/// samples, faults and horizons come, go and move; the resolution of a part changes.
///
/// Vertices whose samples and seeds are gone leave, with what refinement had put within l_max of them; new ones come,
/// inserted ones in their way leave; what was touched is refined as a build refines. Hull box, extent, defaults and the
/// estimator's fitted parameters stay as they are. An edit thins only what it adds, against what is kept.
///
/// Guarantees
///  X1  Cells whose circumsphere does not meet the edit's geometry grown by 3 l_max stay as they are, and their values
///      where the samples they come from do.
///  All of building but D3 and R6, which speak of building; R7 of insertion.

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tess/build.hpp"

namespace terratet {

/// All that an edit may change; the rest of the model follows or stays.
struct ModelPlan {
    Site site;  ///< in the model's frame
    Criteria criteria;
    DensityMode density = DensityMode::canonical;
    BarrierOptions barriers;
    std::vector<RegionName> region_names;
    std::string estimator;  ///< as it was fitted, or another specification
};

/// The model as it is: what an edit starts from.
ModelPlan plan_of(const Model& model);

/// Can change_model do it? Criteria that hold everywhere, density, estimator and barrier options ask for a build.
bool is_local_change(const Model& before, const ModelPlan& plan);

/// Ids of vertices, ascending.
struct VertexChanges {
    std::vector<std::uint64_t> removed;
    std::vector<std::uint64_t> added;
    std::vector<std::uint64_t> changed;  ///< other place, role, owner's side or values
};

/// By ids. O(n). \pre ids ascend in both
VertexChanges vertex_changes(const Model& before, const Model& after);

/// Values of the next state, and where they differ from those before.
struct NextValues {
    NextValues(ValueSource values) : source(std::move(values)) {}  // NOLINT: mostly nothing more is known

    ValueSource source;
    /// Which of these places, whose extrapolation was this, may; none of the others does, to the last bit. Empty: all.
    std::function<std::vector<std::uint8_t>(std::span<const ValueQuery>, std::span<const double>)> differs;
};

struct ChangeReport {
    std::size_t samples_out = 0;  ///< of vertices: those that stood for a sample that left, or that was thinned
    std::size_t samples_in = 0;
    std::size_t seeds_out = 0;
    std::size_t seeds_in = 0;
    std::size_t inserted_out = 0;    ///< of refinement, called for by what left or in the way of what comes
    std::size_t coincident = 0;      ///< samples merged
    std::size_t outside_extent = 0;  ///< samples beyond the extent: they feed the estimator only
    RefineReport refine;
    std::vector<BarrierAccount> barriers;  ///< of surfaces that were prepared
};

/// The next model with its tessellation and barriers; mesh and cell table are left to be made. `tessellation` is that
/// of `before`, and is spent whatever happens. `factory` is asked once the next samples and barriers are there;
/// `same_values` says that they are the old ones, `same_barriers` that those are. Ids go on above those of `before`.
/// Throws as build() does, UsageError when the model would be left without a sample.
/// Local, but for walks over vertices, samples and values of some nanoseconds each; estimates are made where the
/// factory's answer says that they differ. \pre is_local_change
std::unique_ptr<TessellatedModel> change_model(
    const Model& before, Tessellation tessellation, ModelPlan plan,
    const std::function<NextValues(const Model&, const BarrierQuery&, bool same_values, bool same_barriers)>& factory,
    ChangeReport& report, const Progress& progress = {}, const RefineOptions& refine = {});

}  // namespace terratet
