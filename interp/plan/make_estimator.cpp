// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/make_estimator.hpp"

#include <cassert>
#include <utility>

#include "interp/estimator/estimator_catalogue.hpp"
#include "interp/kriging/kriging.hpp"
#include "interp/kriging/kriging_spec.hpp"
#include "interp/natural/linear.hpp"
#include "interp/natural/natural_neighbour.hpp"
#include "interp/sites/idw.hpp"
#include "interp/sites/nearest.hpp"

namespace terratet {

std::unique_ptr<Estimator> make_estimator(const EstimatorSpec& spec, std::vector<Vec3> sites,
                                          const BarrierQuery* barriers, std::vector<std::int32_t> boreholes) {
    const std::string& name = estimator_method(spec.name).name;
    if (name == "nearest") {
        return std::make_unique<Nearest>(std::move(sites), barriers, anisotropy_of(spec));
    }
    if (name == "kriging") {
        assert(!needs_values(spec));
        return std::make_unique<Kriging>(std::move(sites), barriers, kriging_options(spec), boreholes);
    }
    if (name == "idw") {
        return std::make_unique<InverseDistance>(
            std::move(sites), barriers, IdwOptions{spec.number("power"), neighbourhood_of(spec), anisotropy_of(spec)},
            std::move(boreholes));
    }
    if (name == "linear") {
        return std::make_unique<LinearInCells>(std::move(sites), barriers, anisotropy_of(spec));
    }
    NaturalNeighbourOptions options;
    options.weighting = name == "laplace" ? Weighting::laplace : Weighting::sibson;
    options.smooth = spec.options.contains("smooth");
    options.anisotropy = anisotropy_of(spec);
    return std::make_unique<NaturalNeighbour>(std::move(sites), barriers, options);
}

}  // namespace terratet
