// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// All faults' sheets as one complex of triangles as large as wanted, kept up while smaller ones are asked
/// for in places and surfaces are refused.

#include <memory>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier/complex/remesh.hpp"
#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/base/size_field.hpp"

namespace terratet {

/// A place that asks for smaller triangles, for the sake of some surfaces; of none: whichever there are.
struct FinerPlace {
    Vec3 position;
    std::vector<std::uint32_t> surfaces;
};

struct WantedSize {
    FinerPlace place;
    double size;
};

class SheetMesher {
  public:
    /// \param cut     sheets that meet in shared edges only (cut_sheets.hpp)
    /// \param mode    exact: pieces with obtuse angles are remeshed even if their spacing suits, and all are kept
    ///                 regular
    /// \param bounds  by surface: does the model end at it?
    SheetMesher(SheetComplex cut, double spacing, SeedMode mode, std::vector<char> bounds);

    /// The sheets at the sizes now wanted. Pieces that suit the spacing as they came and meet no other sheet are kept
    /// as they are until something is refined.
    SheetRemesher::Result mesh(const Poll& poll = {});

    /// Asks for triangles of given sizes.
    void want(const std::vector<WantedSize>& wishes);

    /// Asks for half the size at the places, at most so many times; false when all are as fine as may be.
    bool refine(const std::vector<FinerPlace>& places, int halvings);

    /// Leaves out the surfaces not marked, and forgets what was refined for their sake.
    void keep(const std::vector<char>& active);

    /// The sheets as cut, of the surfaces still in.
    [[nodiscard]] const SheetComplex& cut() const { return cut_; }
    [[nodiscard]] const SizeField& sizes() const { return sizes_; }

    /// So many triangles more than at first that it should stop here?
    [[nodiscard]] bool overgrown() const { return triangles_ > 2 * first_triangles_ + 4000; }

  private:
    SheetComplex without_staying();

    SheetComplex cut_;
    SeedMode mode_;
    std::vector<char> bounds_;
    SizeField sizes_;
    std::vector<WantedSize> wishes_;
    SheetComplex staying_;
    std::unique_ptr<SheetRemesher> remesher_;
    std::size_t first_triangles_ = 0;
    std::size_t triangles_ = 0;
};

}  // namespace terratet
