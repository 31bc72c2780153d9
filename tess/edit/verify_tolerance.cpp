// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/verify_tolerance.hpp"

#include <cmath>
#include <sstream>

#include "tess/cells/agreement.hpp"
#include "tess/fidelity.hpp"

namespace terratet {

namespace {

constexpr std::size_t places_asked = 20'000;
constexpr double allowed_share = 1e-3;

}  // namespace

ToleranceFinding verify_between_samples(const Model& model, const TetMesh& mesh, const CellTable& cells,
                                        const ValueSource& source) {
    if (!model.criteria.has_residual()) {
        return {true, "not promised: no tolerance"};
    }
    if (!source) {
        return {true, "not tried: it needs the estimator"};
    }
    const AgreementCheck check = check_agreement(model, mesh, cells, source, places_asked);
    const double allowed = allowed_share * static_cast<double>(check.places);
    std::ostringstream figures;
    figures << check.beyond << " of " << check.places << " random places are beyond it in cells without a reason, "
            << check.excused << " of the " << check.places_excused << " in cells with one";
    const bool holds = static_cast<double>(check.beyond) <= allowed + 3 * std::sqrt(allowed);  // chance of 0.1 %
    return {holds, figures.str()};
}

ToleranceFinding verify_samples(const Model& model, const TetMesh& mesh, const CellTable& cells,
                                const BarrierQuery& barriers) {
    std::ostringstream figures;
    bool holds = true;
    const std::vector<Fidelity> all = fidelity(model, mesh, cells.barrier, barriers);
    for (std::size_t p = 0; p < all.size(); ++p) {
        if (all[p].tolerance <= 0) {
            continue;
        }
        figures << (figures.str().empty() ? "" : "; ") << model.properties[p].name << ": " << all[p].beyond_tolerance
                << " of " << all[p].count << " samples beyond " << all[p].tolerance;
        for (const auto& [reason, count] : all[p].reasons) {
            figures << ", " << count << " " << to_string(reason);
            holds = holds && (reason != MissReason::near_fault || !barriers.empty());  // kept, and missed all the same
        }
    }
    return {holds, figures.str().empty() ? "not promised: no tolerance" : figures.str()};
}

}  // namespace terratet
