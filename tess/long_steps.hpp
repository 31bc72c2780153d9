// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The steps of a build that may take seconds, in a form that asks on its way whether to go on. Private to this floor.

#include "tess/density.hpp"
#include "tess/domain.hpp"
#include "tess/poll.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

/// Asks once in so many small steps.
class PatientPoll {
  public:
    explicit PatientPoll(const Poll& poll) : poll_(poll) {}
    void operator()() {
        if (++steps_ % 512 == 0) {
            ask(poll_);
        }
    }

  private:
    const Poll& poll_;
    std::size_t steps_ = 0;
};

std::vector<Vec3> face_grid(const Box3& hull, double l_min, double l_max, std::span<const Vec3> obstacles,
                            const Frame& frame, const Poll& poll);

DensityResult edit_density(const Samples& samples, const ResolutionField& resolution, DensityMode mode,
                           const FaultProximity& faults, const Poll& poll);

/// Tessellation::insert().
void insert_vertices(Tessellation& tessellation, std::span<const Vertex> vertices, const Poll& poll);

}  // namespace terratet
