// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model to work with: from a site, or as it was stored, to values, meshes, and back after a change.
///
/// One writer at a time, any number of readers: a reader takes a snapshot, which stays as it is for as long as it is
/// held, whatever happens to the model meanwhile. The functions here that only read speak of the newest state.

#include <memory>
#include <string>

#include "interp/model_snapshot.hpp"
#include "tess/build.hpp"
#include "tess/change_model.hpp"
#include "tess/value_source.hpp"

namespace terratet {

class LiveModel {
  public:
    /// A stored model. Throws UsageError when it names an estimator that there is not.
    explicit LiveModel(Model model);

    /// Builds (tess/build.hpp says how, and what it throws). options.estimator names the estimator, empty: natural
    /// neighbour; its anisotropy, where left open, is chosen for each property (plan/estimator_choice.hpp). The model
    /// keeps it as it was chosen and fitted.
    explicit LiveModel(Site site, const BuildOptions& options = {}, const Progress& progress = {});
    LiveModel(Site site, const BuildOptions& options, BuildReport& report, const Progress& progress = {});
    /// A site as it was measured, to estimate from and nothing else: its samples are merged as a build merges them, its
    /// faults bar as they are, and its horizons where they are hard for some property. It has no vertices.
    static LiveModel measured(Site site);

    /// From a state of another one on: what is edited here leaves the other as it is.
    explicit LiveModel(const std::shared_ptr<const ModelSnapshot>& state);
    ~LiveModel();
    LiveModel(LiveModel&&) noexcept;
    LiveModel& operator=(LiveModel&&) noexcept;

    /// The newest state. Safe from any thread.
    [[nodiscard]] std::shared_ptr<const ModelSnapshot> snapshot() const;
    [[nodiscard]] const Model& model() const { return snapshot()->model(); }

    /// All properties at a place, in frame-local coordinates (Frame::to_local), with deviations.
    [[nodiscard]] std::vector<PropertyEstimates> values(std::span<const ValueQuery> places) const {
        return snapshot()->estimator_with_errors().estimates(places);
    }
    /// The value of each property at one place, likewise; NaN where there is none.
    [[nodiscard]] std::vector<double> value_at(const Vec3& place) const;

    /// The vertices next to a borehole's own (ModelSnapshot::neighbours_of), as indices into model().vertices.
    [[nodiscard]] std::vector<std::uint32_t> neighbours_of(const std::string& borehole) const {
        return snapshot()->neighbours_of(borehole);
    }

    /// What the estimator knows about its values becomes further properties of the vertices
    /// (interp/plan/uncertainty.hpp), and the model keeps how far errors go.
    void add_uncertainty();

    /// Brings the model to what the plan says: by a local change where that can do it (tess/change_model.hpp), else by
    /// building it again with its own options. The estimator stays as it was fitted. Properties that hold uncertainty
    /// are brought up to date. Snapshots that somebody holds stay as they are. Nothing has changed when it throws: as
    /// change_model and build do.
    ChangeReport edit(ModelPlan plan, const Progress& progress = {}, const RefineOptions& refine = {});

    /// Takes a fault or horizon of that name out. Throws UsageError when there is none.
    void remove_surface(const std::string& name, const Progress& progress = {});

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
