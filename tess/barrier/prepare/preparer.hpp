// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The steps from surfaces to faults, in their order, and who is refused on the way.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier/complex/cut_sheets.hpp"
#include "tess/barrier/complex/repair.hpp"
#include "tess/barrier/complex/sheet_mesher.hpp"
#include "tess/barrier/seeds/seal.hpp"
#include "tess/barrier/seeds/seeding.hpp"
#include "tess/frame.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// For people: six digits.
std::string short_text(double value);

/// Every length that follows from the spacing s.
struct BarrierScale {
    BarrierScale(const BarrierOptions& options, double l_min);

    double spacing;
    double width;
    double snap;
    double protection;  ///< the largest the protection radius should be
    double margin;      ///< width of the margin
    double reach;       ///< how far surfaces go on beyond the extent
    double hull;        ///< and the hull box
};

class BarrierPreparer {
  public:
    BarrierPreparer(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame,
                    const BarrierScale& scale, const BarrierOptions& options, const Progress& progress,
                    std::span<const Vec3> samples);

    BarrierPreparation run();

    /// See separating_spacing().
    double separating_spacing();

  private:
    static constexpr int patience = 5;

    /// A surface on its way; its place in the list is its number in the complex.
    struct Candidate {
        const Surface* surface = nullptr;
        RepairedSheet repaired;
        double area_inside = 0;
        double area_dropped = 0;    ///< taken out in repair: where it ran through itself, doubles, crumbs
        std::vector<Sheet> sheets;  ///< extended across the extent's faces
        bool active = true;
        BarrierAccount account;
    };
    /// One pass over all that is left.
    struct Pass {
        SheetComplex complex;
        std::vector<double> trimmed;
        SeededComplex seeded;
        std::vector<TriMesh> skirts;
        std::vector<double> finest;  ///< size of triangles wanted, by surface
    };

    void repair();
    void screen(Candidate& candidate);
    void drop_crumbs(std::vector<TriMesh>& parts) const;
    void drop_doubles(std::vector<TriMesh>& parts) const;
    void refuse(Candidate& candidate, const std::string& reason);
    [[nodiscard]] std::string text_of(const Vec3& place) const;  ///< its world coordinates
    static std::string described(const Candidate& candidate);
    void refuse_alternatives();
    /// Two surfaces of which one mostly runs alongside the other and goes.
    struct Close {
        std::size_t larger = 0;
        std::size_t smaller = 0;
        bool apart = false;   ///< they nowhere meet: two, not two versions of one
        double distance = 0;  ///< if so: at which the smaller one runs,
        double spacing = 0;   ///< and that would keep both
    };
    std::vector<Close> close_pairs();
    [[nodiscard]] std::string reason_of(const Close& pair) const;
    [[nodiscard]] double seeds_at(double spacing) const;  ///< an estimate for all that is left
    void check_budget() const;
    void extend(std::uint32_t number);

    /// Nothing when surfaces were refused and the rest is to be tried again.
    std::optional<Pass> attempt();
    /// What a check of an attempt finds: all is well, the mesher was told where triangles have to be finer, or surfaces
    /// were refused. At the last halving it asks for nothing finer.
    enum class Finding { good, finer, refused };
    Finding check_crossings(const Pass& pass, const std::vector<std::array<std::uint32_t, 2>>& crossings, bool last);
    Finding check_bends(Pass& pass, bool last);
    void place_seeds(Pass& pass, const std::vector<char>& walls) const;
    Finding check_crowding(const Pass& pass, const std::vector<char>& walls, bool last);
    Finding check_separation(const Pass& pass, bool last);
    /// Enough was tried: from now on triangles stay as large as they are, and of two surfaces that do not get along
    /// both go, so that it ends soon. What is tried is counted, not timed: the same surfaces give the same faults.
    [[nodiscard]] bool hurries() const { return attempts_ > patience; }
    void cut();
    bool refuse_failed(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, const std::string& what);
    void seed(Pass& pass, const SizeField& sizes, const Poll& poll, bool mend = false) const;
    /// \pre The stage's name outlives what is returned.
    [[nodiscard]] Poll told(std::string_view stage, double fraction) const;
    [[nodiscard]] std::vector<TriMesh> skirts(const SheetComplex& complex, const EdgeTable& edges) const;

    /// False when surfaces were refused that could not be sealed.
    bool seal(Pass& pass);
    /// The surfaces as faults, but for a domain's walls, and their numbers.
    struct Sealable {
        std::vector<Barrier> barriers;
        std::vector<std::uint32_t> numbers;
    };
    [[nodiscard]] Sealable sealable(const Pass& pass) const;
    bool relax(std::vector<Seal::Open>& open, int round);
    bool refuse_leaking(const std::vector<Seal::Open>& open, const std::vector<std::uint32_t>& numbers);

    /// A surface as a fault, and which triangles of its sheet are certified.
    struct Piece {
        Barrier barrier;
        std::vector<std::uint8_t> certified;
    };
    [[nodiscard]] Piece piece_of(const Pass& pass, std::uint32_t number) const;
    void finish(const Pass& pass, BarrierPreparation& result);
    void collect(const Pass& pass, std::uint32_t number, BarrierPreparation& result);

    const std::vector<Surface>& surfaces_;
    const Box3& extent_;
    Box3 limit_;
    const Frame& frame_;
    BarrierScale scale_;
    const BarrierOptions& options_;
    const Progress& progress_;
    std::span<const Vec3> samples_;
    std::vector<Candidate> candidates_;
    CutSheets cut_;  ///< but for its complex, which the mesher has
    std::unique_ptr<SheetMesher> mesher_;
    std::vector<Vec3> relaxed_;  ///< see SeedTask
    int passes_ = 0;             ///< of the mesher
    int seals_ = 0;
    int attempts_ = 0;
};

}  // namespace terratet
