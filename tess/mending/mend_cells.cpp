// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mending/mend_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "tess/mending/mending_steps.hpp"

namespace terratet {
namespace {

constexpr double enough = 0.1;        ///< goodness: 18°
constexpr double must_have = 0.0302;  ///< goodness: 10°; also cells that were not cut are mended below it
constexpr double may_have = 0.0076;   ///< goodness: 5°; after points have met, before cells are mended
constexpr int max_passes = 8;

struct Ranked {
    double by;
    std::uint32_t cell;
    auto operator<=>(const Ranked&) const = default;
};

constexpr std::size_t ask_every = 64;

/// Sweeps over the bad cells of a mesh; the later ones have few.
class Mender {
  public:
    Mender(MendableStars& stars, const Progress& progress) : stars_(stars), progress_(progress) {}

    /// Points nearer to each other than they should be become one. Returns how often.
    std::size_t shorten() {
        const double least = stars_.mesh().least_edge * stars_.mesh().least_edge;
        stars_.let_edges_count(false);
        const std::size_t changed = sweep(
            least, failed_shortening_,
            [&](std::uint32_t c) { return stars_.cell(c).judged ? stars_.shortest_edge(stars_.cell(c)) : least; },
            [&](std::uint32_t c) { return best_shortening(stars_, c, may_have); });
        stars_.let_edges_count(true);
        return changed;
    }

    std::size_t improve(MendingAim aim) {
        return sweep(
            enough, failed_improving_[aim == MendingAim::worst ? 0 : 1],
            [&](std::uint32_t c) { return stars_.goodness(c); },
            [&](std::uint32_t c) { return best_change(stars_, c, aim); });
    }

  private:
    /// Of the touched cells whose measure is below `least`, the worst first, each that is so still is changed, but for
    /// those round which nothing is new since they could not be.
    template <class Measure, class Find>
    std::size_t sweep(double least, std::vector<std::uint32_t>& failed, const Measure& measure, const Find& find) {
        std::vector<Ranked> bad;
        for (std::uint32_t c = 0; c < stars_.mesh().cells.size(); ++c) {
            const MendableMesh::Cell& cell = stars_.cell(c);
            if (cell.touched && !MendableStars::gone(cell)) {
                if (const double by = measure(c); by < least) {
                    bad.push_back({by, c});
                }
            }
        }
        std::ranges::sort(bad);
        std::size_t changed = 0;
        for (std::size_t i = 0; i < bad.size(); ++i) {
            if (i % ask_every == 0) {
                const double done = static_cast<double>(i) / static_cast<double>(bad.size());
                report_progress(progress_, "mend cells", 1 - std::ldexp(1 - 0.5 * done, -sweeps_));
            }
            const MendableMesh::Cell& cell = stars_.cell(bad[i].cell);
            if (MendableStars::gone(cell) || measure(bad[i].cell) >= least) {
                continue;
            }
            failed.resize(stars_.mesh().cells.size(), never);
            if (failed[bad[i].cell] != never && !stars_.changed_round(cell, failed[bad[i].cell])) {
                continue;
            }
            if (const std::optional<MendingStep> change = find(bad[i].cell)) {
                failed[bad[i].cell] = never;
                make(stars_, *change);
                ++changed;
            } else {
                failed[bad[i].cell] = stars_.now();
            }
        }
        ++sweeps_;
        return changed;
    }

    static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

    MendableStars& stars_;
    const Progress& progress_;
    std::vector<std::uint32_t> failed_shortening_;                ///< of cells: when, in the stars' changes
    std::array<std::vector<std::uint32_t>, 2> failed_improving_;  ///< by aim
    int sweeps_ = 0;
};

}  // namespace

void mend_cells(MendableMesh& mesh, const Progress& progress) {
    MendableStars stars(mesh);
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        MendableMesh::Cell& cell = mesh.cells[c];
        cell.touched |= cell.judged && stars.goodness(c) < must_have;
    }
    Mender mender(stars, progress);
    std::size_t changed = 1;
    for (int pass = 0; pass < max_passes && changed > 0; ++pass) {
        changed = mender.shorten() + mender.improve(MendingAim::worst);
        if (pass % 2 == 1 || changed == 0) {
            changed += mender.improve(MendingAim::together);
        }
    }
}

}  // namespace terratet
