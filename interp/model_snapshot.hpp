// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One state of a model, and all that follows from it: tessellation, barrier queries, cell table, estimators, the mesh
/// without gaps. Each is made once, when it is first asked for, and shared by all who ask. Const, and safe from many
/// threads.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "interp/model_estimator.hpp"
#include "tess/barrier_query.hpp"
#include "tess/build.hpp"
#include "tess/collapse.hpp"
#include "tess/verify.hpp"

namespace terratet {

class ModelSnapshot {
  public:
    /// As it was stored. Throws UsageError when it names an estimator that there is not.
    explicit ModelSnapshot(Model model);

    /// As it was built or changed, with what that made; without `complete`, mesh and cells are made when they are asked
    /// for. `estimator` is of that model and its barriers, or inherited from the state before
    /// (estimator_of); null: by the model's plan, when it is asked for. `valued`: all values of vertices are from it.
    ModelSnapshot(std::unique_ptr<TessellatedModel> made, std::shared_ptr<const ModelEstimator> estimator,
                  bool complete = true, bool inherited = false, bool valued = true);
    ~ModelSnapshot();
    ModelSnapshot(const ModelSnapshot&) = delete;
    ModelSnapshot& operator=(const ModelSnapshot&) = delete;

    [[nodiscard]] const Model& model() const;
    [[nodiscard]] const BarrierQuery& barriers() const;
    [[nodiscard]] const TetMesh& mesh() const;
    [[nodiscard]] const CellTable& cells() const;

    /// Guarantee R5, verified with exact predicates: about 10 µs a cell.
    [[nodiscard]] bool is_delaunay() const;

    /// Its faults without width, or its bounds alone (tess/collapse.hpp). Throws Error when the result fails its check.
    [[nodiscard]] const CollapsedModel& collapsed(Collapsing which, const Progress& progress = {}) const;

    /// The model's own estimator, for values; the other also knows how far its errors go, for which boreholes are left
    /// out where the model does not say yet: seconds.
    [[nodiscard]] const ModelEstimator& estimator() const;
    [[nodiscard]] const ModelEstimator& estimator_with_errors() const;
    /// The same for the next state, whose samples and barriers are these; it keeps what it reads alive.
    /// \param self     this
    [[nodiscard]] static std::shared_ptr<const ModelEstimator> estimator_of(
        const std::shared_ptr<const ModelSnapshot>& self);
    /// The estimator that all values of the model's vertices came from, or their like to the last bit; null for a model
    /// that was stored since. Lives as long as this.
    [[nodiscard]] const ModelEstimator* source_of_values() const;

    /// The vertices next to a borehole's own in the Voronoi sense, ascending: whose cells share a wall with one of its
    /// samples' cells. Throws UsageError when there is no such borehole. O(cells).
    [[nodiscard]] std::vector<std::uint32_t> neighbours_of(const std::string& borehole) const;

    /// Each guarantee, verified again with the model's own estimator (tess/verify.hpp). \param edited  it was changed
    /// since it was built
    [[nodiscard]] std::vector<Verdict> verify(bool edited, const Progress& progress = {},
                                              const VerifyOptions& options = {}) const;

    /// Gives up what only queries and edits want again, for the writers to come: tessellation and estimators. Whoever
    /// asks has them made anew. \pre Nobody holds a reference to them.
    void release_memory() const;

    /// Gives the tessellation away, to be changed into the next state's; whoever asks here has it made anew.
    [[nodiscard]] Tessellation take_tessellation() const;

    /// What the estimator knows about its values becomes further properties of the vertices
    /// (interp/plan/uncertainty.hpp). \pre Nobody else has the snapshot yet.
    void add_uncertainty();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
