// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/refine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tess/mesh/conflict_zone.hpp"
#include "tess/mesh/delaunay.hpp"
#include "tess/mesh/gap_cell.hpp"
#include "tess/refine/cell_queue.hpp"
#include "tess/refine/clean_up.hpp"
#include "tess/refine/coarse_cells.hpp"
#include "tess/refine/insertion_rule.hpp"
#include "tess/refine/live_cell.hpp"
#include "tess/refine/live_vertices.hpp"
#include "tess/refine/residual.hpp"
#include "tess/refine/star_facet.hpp"
#include "tess/refine/touched_cells.hpp"

namespace terratet {

namespace {

using delaunay::Cell;
using delaunay::Facet;

/// Rule 4 is tried only for a star whose smallest dihedral angle would fall below this: most circumcentres do better,
/// and trying more points for each would cost more than it saves.
const double poor_star = sharpness(std::cos(20 * std::numbers::pi / 180));
constexpr int candidate_count = 7;
/// For a cell that is merely flat: its shape is a matter of luck, and a vertex in vain asks for more and shorter edges.
constexpr int candidate_count_if_flat = 28;

/// Cells whose residual is asked at a time: enough for all threads, and few enough that insertion spares many of those
/// that wait. Of meshes with few cells, fewer.
constexpr std::size_t largest_batch = 1024;
constexpr std::size_t smallest_batch = 64;
constexpr std::size_t batches_in_mesh = 32;

/// Of the hull box: what is left to be off in fewer places than T1 allows is not worth a step.
constexpr double small_share = 1e-3;

class Refiner {
  public:
    Refiner(Tessellation& tessellation, VertexValues& values, const Domain& domain, const Frame& frame,
            const BarrierQuery& barriers, const Criteria& criteria, std::span<const Property> properties,
            const ValueSource& source, const RefineOptions& options, const Samples& dropped)
        : core_(delaunay::core(tessellation)),
          rule_(criteria, domain, frame, barriers, properties, values),
          search_(core_.triangulation, domain.hull),
          residuals_(criteria, frame, properties, values, source, dropped),
          criteria_(criteria),
          frame_(frame),
          hull_(domain.hull),
          options_(options),
          vertices_(core_, values, source, criteria.has_variation(), options.max_vertices, criteria.l_min,
                    rule_.resolution().packing_bound()),
          last_between_(rule_.resolution().between()),
          tests_residuals_(options.residuals && residuals_.active()),
          has_barriers_(!barriers.empty()) {
        set_smallest_radius();
        for (const Vertex& vertex : core_.vertices) {
            rule_.note_vertex(vertex.position);
        }
    }

    RefineReport run(const Touched* touched = nullptr) {
        touched_ = touched;
        if (touched == nullptr) {
            if (tests_residuals_) {
                begin_coarse();
            }
            queue_all();
        } else if (core_.triangulation.dimension() == 3) {
            first_new_ = static_cast<std::uint32_t>(core_.vertices.size());
            queue_bad(touched_cells(core_, *touched, first_new_));
        }
        do {
            do {
                do {
                    while (const auto bad = queue_.pop()) {
                        if (++treated_ % 256 == 0) {
                            tell();
                        }
                        treat(*bad);
                    }
                } while (test_some());
            } while (retry());
        } while (finer());
        report_.bound = rule_.resolution().packing_bound();
        report_.l_min_between = rule_.resolution().between();
        if (options_.clean_up) {
            clean_up();
        }
        vertices_.complete();
        report_.estimates = residuals_.asked() + vertices_.asked();
        return report_;
    }

  private:
    /// By steps it is seen what a finer one takes before it is tried, and the mesh is the same whether the last one was
    /// known or found.
    void begin_coarse() {
        if (rule_.resolution().between() < criteria_.l_min) {
            rule_.set_between(criteria_.l_min);
            set_smallest_radius();
        }
    }

    void set_smallest_radius() {
        const double smallest = rule_.resolution().smallest_l_min();
        smallest_squared_radius_ = smallest * smallest;
    }

    /// Queues what a finer l_min between samples lets in. False at the end.
    bool finer() {
        const double now = rule_.resolution().between();
        if (touched_ != nullptr || core_.triangulation.dimension() < 3 || now <= last_between_) {
            return false;
        }
        const double next = std::max(last_between_, now / std::numbers::sqrt2);
        CoarseCells coarse = coarse_cells(core_, rule_, hull_, next);
        const std::uint64_t enough = options_.enough_vertices;
        report_.stopped = enough > 0 && core_.vertices.size() + coarse.vertices_expected > enough;
        if (report_.stopped || (enough > 0 && coarse.varying_volume < small_share * hull_.volume())) {
            return false;
        }
        rule_.set_between(next);
        set_smallest_radius();
        add_existing(std::exchange(at_boundary_, {}), coarse.cells);
        add_existing(std::exchange(refused_, {}), coarse.cells);
        std::ranges::sort(coarse.cells, {}, [](const Cell& cell) { return &*cell; });
        coarse.cells.erase(std::unique(coarse.cells.begin(), coarse.cells.end()), coarse.cells.end());
        queue_bad(coarse.cells);  // in an order of its own
        return true;
    }

    void queue_all() {
        auto& triangulation = core_.triangulation;
        if (triangulation.dimension() < 3) {
            return;
        }
        std::vector<Cell> cells;
        for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell) {
            cell->info().tag = no_index;
            if (!triangulation.is_infinite(cell)) {
                cells.push_back(cell);
            }
        }
        queue_bad(cells);
    }

    /// Queues the bad ones among `cells`, in an order that depends on their vertices alone.
    void queue_bad(const std::vector<Cell>& cells) {
        bad_.clear();
        for (const Cell cell : cells) {
            const JudgedCell judged_cell = judged(cell);
            search_.cache(cell, judged_cell.points, judged_cell.sphere);
            if (judged_cell.sphere.squared_radius < smallest_squared_radius_) {
                continue;  // rule 2 would refuse it: R is below l_min
            }
            if (has_barriers_ && gap_barrier(judged_cell.vertices, core_.vertices) >= 0) {
                continue;
            }
            if (const double violation = rule_.violation_in_force(judged_cell); violation > 1) {
                bad_.push_back({judged_cell.vertices, violation, cell});
            } else if (tests_residuals_) {
                bad_.push_back({judged_cell.vertices, 0, cell, judged_cell.sphere.squared_radius});
            }
        }
        std::ranges::sort(bad_, std::greater(), &BadCell::vertices);
        for (const BadCell& bad : bad_) {
            if (bad.violation > 0) {
                set_estimate(queue_.push(bad.cell, bad.violation), std::nullopt);
            } else {  // the largest first, in classes of a quarter of an octave: they are likeliest to be bad
                untested_.push(bad.cell, std::pow(bad.squared_radius / smallest_squared_radius_, 0.25));
            }
        }
    }

    /// Asks for the residuals of some of the cells that wait for it. False when none does. What may have no new vertex
    /// is not asked about.
    bool test_some() {
        const std::size_t size = std::clamp(core_.vertices.size() / batches_in_mesh, smallest_batch, largest_batch);
        std::vector<JudgedCell> asked;
        std::vector<Cell> cells;
        bool any = false;
        while (cells.size() < size) {
            const auto waiting = untested_.pop();
            if (!waiting) {
                break;
            }
            any = true;
            const JudgedCell judged_cell = judged(waiting->cell);
            if (rule_.propose(judged_cell).reason == Reason::none) {
                cells.push_back(waiting->cell);
                asked.push_back(judged_cell);
            }
        }
        std::vector<Residual> residuals = residuals_.of(asked);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (residuals[i].ratio > 1) {
                set_estimate(queue_.push(cells[i], residuals[i].ratio), std::move(residuals[i].at_center));
            }
        }
        tell();
        return any;
    }

    void set_estimate(std::uint32_t slot, std::optional<Estimate> estimate) {
        if (tests_residuals_) {
            estimates_.resize(std::max(estimates_.size(), slot + std::size_t{1}));
            estimates_[slot] = std::move(estimate);
        }
    }

    /// Queues again what the boundary stood in the way of, if that has been split meanwhile: there may be another way
    /// now.
    bool retry() {
        if (report_.inserted == inserted_before_retry_) {
            return false;
        }
        inserted_before_retry_ = report_.inserted;
        std::vector<Cell> cells;
        add_existing(std::exchange(at_boundary_, {}), cells);
        queue_bad(cells);
        return true;
    }

    using Corners = std::array<delaunay::VertexHandle, 4>;  // of a cell that may be gone by the time it is asked for
    static Corners corners(Cell cell) { return {cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3)}; }

    void add_existing(const std::vector<Corners>& all, std::vector<Cell>& cells) const {
        for (const auto& v : all) {
            Cell cell;
            if (core_.triangulation.is_cell(v[0], v[1], v[2], v[3], cell)) {
                cells.push_back(cell);
            }
        }
    }

    void treat(const CellQueue::Entry& bad) {
        const Cell cell = bad.cell;
        known_ = tests_residuals_ ? std::exchange(estimates_[bad.slot], std::nullopt) : std::nullopt;
        const JudgedCell judged_cell = judged(cell);
        const Proposal proposal = rule_.propose(judged_cell);
        if (proposal.projected) {
            if (proposal.reason == Reason::none && split(bad, proposal.point)) {
                return;
            }
            const auto instead = rule_.instead_of_split(judged_cell);
            if (!instead || !find_zone(*instead, cell, zone_)) {
                at_boundary_.push_back(corners(cell));
                return;
            }
            return insert(zone_);
        }
        if (proposal.reason != Reason::none) {
            return;
        }
        if (!find_zone(proposal.point, cell, zone_)) {
            if (rule_.resolution().between() > last_between_) {
                refused_.push_back(corners(cell));
            }
            return;
        }
        if (options_.candidates) {
            const bool flat = rule_.merely_flat(judged_cell) && rule_.violation_in_force(judged_cell) > 1;
            improve(judged_cell, proposal, cell, flat ? candidate_count_if_flat : candidate_count);
        }
        insert(zone_);
    }

    /// Splits the boundary there. False when that is too near a vertex.
    bool split(const CellQueue::Entry& bad, const Vec3& place) {
        const Cell cell = bad.cell;
        delaunay::Triangulation::Locate_type where{};
        int i = 0;
        int j = 0;
        const Cell start = core_.triangulation.locate(delaunay::to_cgal(place), where, i, j, cell);
        if (where == delaunay::Triangulation::VERTEX || core_.triangulation.is_infinite(start) ||
            !find_zone(place, start, zone_)) {
            return false;
        }
        if (std::ranges::find(zone_.cells, cell) == zone_.cells.end()) {
            set_estimate(queue_.push(cell, bad.violation), known_);  // it outlives the split: its turn comes again
        }
        insert(zone_);
        return true;
    }

    /// False when the point comes nearer than l_min to a vertex: the nearest one is on its zone's boundary. Or when it
    /// is not in the sphere of `start`.
    bool find_zone(const Vec3& point, Cell start, Zone& zone) {
        const double limit = squared_l_min(point);
        return search_.find(point, start, zone) && std::ranges::all_of(zone.boundary, [&](const Facet& facet) {
                   return is_infinite(facet) || clear_of(facet_corners(facet), point, limit);
               });
    }

    /// Rule 4: where the circumcentre would make a poor star, the first of some points around it that makes a fair
    /// one, or the best of all.
    void improve(const JudgedCell& cell, const Proposal& proposal, Cell start, int count) {
        double best = -1;
        for (const Facet& facet : zone_.boundary) {
            best = is_infinite(facet) ? best : star_sharpness(facet_corners(facet), zone_.point, best, 1);
        }
        if (best <= poor_star) {
            return;
        }
        std::array<std::uint64_t, 4> ids{};
        std::ranges::transform(cell.vertices, ids.begin(), [&](std::uint32_t v) { return core_.vertices[v].id; });
        BallPoints ball(ids);
        for (int i = 0; i < count && best > poor_star; ++i) {
            const Vec3 point = frame_.snapped(proposal.point + candidate_radius * proposal.radius * ball.next());
            if (rule_.allows(point) && find_fairer_zone(point, start, best)) {
                std::swap(zone_, candidate_);
            }
        }
    }

    /// As find_zone, into candidate_; false as well when the star is no less sharp than `best`, which becomes the
    /// star's sharpness otherwise. Most candidates fail, so each facet is judged as soon as it is found.
    bool find_fairer_zone(const Vec3& point, Cell start, double& best) {
        const double limit = squared_l_min(point);
        double sharpest = -1;
        const auto fair = [&](const Facet& facet) {
            if (is_infinite(facet)) {
                return true;
            }
            const FacetCorners corners = facet_corners(facet);
            sharpest = star_sharpness(corners, point, sharpest, best);
            return sharpest < best && clear_of(corners, point, limit);
        };
        const bool found = search_.find(point, start, candidate_, fair);
        best = found ? sharpest : best;
        return found;
    }

    [[nodiscard]] double squared_l_min(const Vec3& point) const {
        const double l_min = rule_.resolution().l_min(point);
        return l_min * l_min;
    }

    [[nodiscard]] bool is_infinite(const Facet& facet) const { return core_.triangulation.is_infinite(facet); }

    void insert(const Zone& zone) {
        for (const Cell cell : zone.cells) {
            queue_.forget(cell);
            untested_.forget(cell);
        }
        outside_.clear();
        for (const auto& [cell, k] : zone.boundary) {
            outside_.emplace_back(cell->neighbor(k), cell->neighbor(k)->index(cell));
        }
        auto& triangulation = core_.triangulation;
        const auto vertex =
            triangulation.insert_in_hole(delaunay::to_cgal(zone.point), zone.cells.begin(), zone.cells.end(),
                                         zone.boundary.front().first, zone.boundary.front().second);
        const bool is_known = known_ && known_->place == zone.point;
        vertex->info() = vertices_.append(zone.point, is_known ? &*known_ : nullptr);
        rule_.note_vertex(zone.point);
        ++report_.inserted;
        star_.clear();
        for (const auto& [cell, k] : outside_) {
            if (const Cell fresh = cell->neighbor(k); !triangulation.is_infinite(fresh)) {
                star_.push_back(fresh);
            }
        }
        queue_bad(star_);
    }

    void clean_up() {
        CleanUp cleaning(core_, vertices_, rule_, search_, residuals_, criteria_, frame_, options_.progress);
        const CleanUpReport done =
            touched_ == nullptr ? cleaning.run() : cleaning.run(touched_cells(core_, *touched_, first_new_));
        report_.inserted += done.inserted;
        report_.moved = done.moved;
        report_.removed = done.removed;
        vertices_.drop(cleaning.removed());
    }

    /// Nobody knows how much is left; what is done against what waits is a fair guess that never runs backwards.
    void tell() {
        const auto done = static_cast<double>(report_.inserted);
        told_ = std::max(told_, done / (done + static_cast<double>(queue_.waiting() + untested_.waiting() / 4)));
        report_progress(options_.progress, "refine", told_);
    }

    struct BadCell {
        std::array<std::uint32_t, 4> vertices;
        double violation;  ///< 0: not known to be bad
        Cell cell;
        double squared_radius = 0;
    };

    delaunay::Core& core_;
    InsertionRule rule_;
    ConflictSearch search_;
    ResidualTest residuals_;
    const Criteria& criteria_;
    const Frame& frame_;
    const Box3& hull_;
    const RefineOptions& options_;
    LiveVertices vertices_;
    double smallest_squared_radius_ = 0;
    double last_between_;  ///< where the steps of l_min end
    bool tests_residuals_;
    bool has_barriers_;
    CellQueue queue_;
    CellQueue untested_{1};
    std::vector<std::optional<Estimate>> estimates_;  ///< by slot of the queue
    std::optional<Estimate> known_;                   ///< of the cell under treatment
    RefineReport report_;
    std::vector<Corners> at_boundary_;  ///< bad cells whose split is not allowed
    std::vector<Corners> refused_;      ///< whose vertex would come too near, until a finer step
    std::uint64_t inserted_before_retry_ = 0;
    std::uint64_t treated_ = 0;
    double told_ = 0;
    Zone zone_;
    Zone candidate_;
    std::vector<BadCell> bad_;
    std::vector<Facet> outside_;  ///< the zone's boundary seen from outside: it outlives the zone
    std::vector<Cell> star_;
    const Touched* touched_ = nullptr;  ///< null: everything
    std::uint32_t first_new_ = 0;
};

}  // namespace

RefineReport refine(Tessellation& tessellation, VertexValues& values, const Domain& domain, const Frame& frame,
                    const BarrierQuery& barriers, const Criteria& criteria, std::span<const Property> properties,
                    const ValueSource& source, const RefineOptions& options, const Samples& dropped) {
    return Refiner(tessellation, values, domain, frame, barriers, criteria, properties, source, options, dropped).run();
}

RefineReport refine_around(const Touched& touched, Tessellation& tessellation, VertexValues& values,
                           const Domain& domain, const Frame& frame, const BarrierQuery& barriers,
                           const Criteria& criteria, std::span<const Property> properties, const ValueSource& source,
                           const RefineOptions& options) {
    const Samples none;
    return Refiner(tessellation, values, domain, frame, barriers, criteria, properties, source, options, none)
        .run(&touched);
}

}  // namespace terratet
