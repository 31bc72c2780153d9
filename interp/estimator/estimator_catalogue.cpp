// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/estimator_catalogue.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using Options = std::vector<EstimatorOption>;

Options operator+(Options a, const Options& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Options neighbourhood(const std::string& max_points) {
    return {{.name = "radius",
             .default_value = "",
             .unit = "length",
             .help = "samples farther away do not count; none nearer: no value",
             .lowest = 0,
             .above = true},
            {.name = "max_points",
             .default_value = max_points,
             .unit = "",
             .help = "how many of the nearest visible samples count",
             .lowest = 1,
             .highest = 100'000,
             .whole = true}};
}

Options shares(const std::string& per_octant, const std::string& per_borehole) {
    return {{.name = "per_octant",
             .default_value = per_octant,
             .unit = "",
             .help = "at most so many in each of the eight octants around the place; 0: any",
             .lowest = 0,
             .highest = 100'000,
             .whole = true,
             .implied = per_octant == "0"},
            {.name = "per_borehole",
             .default_value = per_borehole,
             .unit = "",
             .help = "at most so many of one borehole; 0: any",
             .lowest = 0,
             .highest = 100'000,
             .whole = true,
             .implied = per_borehole == "0"}};
}

Options anisotropy(const std::string& ratio3) {
    const auto ratio = [](const char* name, const std::string& value, const char* help) {
        return EstimatorOption{.name = name,
                               .default_value = value,
                               .unit = "",
                               .help = help,
                               .lowest = 0,
                               .above = true,
                               .implied = true};
    };
    const auto angle = [](const char* name, const char* help) {
        return EstimatorOption{.name = name,
                               .default_value = "0",
                               .unit = "degrees",
                               .help = help,
                               .lowest = -360,
                               .highest = 360,
                               .implied = true};
    };
    return {
        {.name = "anisotropy",
         .default_value = "",
         .unit = "",
         .help = "auto: a plane and a ratio from the samples where left-out boreholes are estimated better by them; "
                 "none: distances count alike in all directions. Not given: auto, unless one of these is given",
         .words = {"auto", "none"},
         .implied = true},
        angle("azimuth", "of the first axis of anisotropy, clockwise from grid north"),
        angle("dip", "of the first axis, down from the horizontal"),
        angle("roll", "of the second axis, about the first; 0: horizontal"),
        ratio("ratio2", "1", "range along the second axis over that along the first"),
        ratio("ratio3", ratio3,
              ratio3.empty() ? "range along the third axis, the vertical unless turned, over that along the first; "
                               "fitted by default, or 1 where another of these is given"
                             : "range along the third axis, the vertical unless turned, over that along the first")};
}

std::string shown(double number) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

}  // namespace

const std::vector<EstimatorMethod>& estimator_catalogue() {
    static const std::vector<EstimatorMethod> all = {
        {"natural", "natural neighbour (Sibson): smooth, adapts to the samples' density, nothing to tune",
         Options{{.name = "smooth",
                  .default_value = "",
                  .unit = "",
                  .help = "no kinks at the samples; may leave the range of their values",
                  .flag = true}} +
             anisotropy("1")},
        {"laplace", "natural neighbour by faces instead of volumes (Laplace): faster, less smooth", anisotropy("1")},
        {"linear", "linear in the cells of the samples' own Delaunay tessellation", anisotropy("1")},
        {"idw", "inverse distance over the nearest samples",
         Options{{.name = "power",
                  .default_value = "2",
                  .unit = "",
                  .help = "weights fall with distance to this power",
                  .lowest = 0,
                  .highest = 100}} +
             neighbourhood("12") + shares("0", "0") + anisotropy("1")},
        {"kriging",
         "the linear estimate of least variance for a variogram, fitted to the samples where it is not given",
         Options{
             {.name = "drift",
              .default_value = "constant",
              .unit = "",
              .help = "constant: ordinary kriging; linear: universal, about a plane; not given: where the variogram is "
                      "fitted, whichever estimates left-out boreholes better",
              .words = {"constant", "linear"}},
             {.name = "model",
              .default_value = "spherical",
              .unit = "",
              .help = "spherical, exponential, gaussian or matern",
              .words = {"spherical", "exponential", "gaussian", "matern"}},
             {.name = "nu",
              .default_value = "1.5",
              .unit = "",
              .help = "smoothness of matern",
              .lowest = 0,
              .highest = 50,
              .above = true,
              .implied = true},
             {.name = "nugget",
              .default_value = "",
              .unit = "value²",
              .help = "variance over no distance; fitted by default",
              .lowest = 0},
             {.name = "sill",
              .default_value = "",
              .unit = "value²",
              .help = "variance besides the nugget; fitted by default",
              .lowest = 0},
             {.name = "range",
              .default_value = "",
              .unit = "length",
              .help = "along the first axis; where the sill is reached (spherical), or the length that distances are "
                      "divided by (the others: 95 % of the sill lie at 3, √3 and, matern 1.5, 4.7 ranges); fitted "
                      "by default",
              .lowest = 0,
              .above = true}} +
             Options{{.name = "fit",
                      .default_value = "robust",
                      .unit = "",
                      .help =
                          "variogram to fit to: robust (Cressie and Hawkins) or classical; of a category always the "
                          "classical",
                      .words = {"robust", "classical"},
                      .implied = true}} +
             neighbourhood("24") + shares("4", "8") + anisotropy("")},
        {"nearest", "the value of the nearest sample that no fault hides", anisotropy("1")},
        {"auto",
         "whichever of natural, natural:smooth, kriging and idw estimates left-out boreholes best; natural unless "
         "another wins clearly",
         Options{{.name = "anisotropy",
                  .default_value = "auto",
                  .unit = "",
                  .help = "auto, or none: in no direction other distances than in another",
                  .words = {"auto", "none"},
                  .implied = true}}},
    };
    return all;
}

const EstimatorMethod& estimator_method(const std::string& name) {
    const auto& all = estimator_catalogue();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const EstimatorMethod& method) { return method.name == name; });
    if (found == all.end()) {
        const auto known = names_of(all, &EstimatorMethod::name);
        throw UsageError("estimator '" + name + "' is not known; there are " + listed(known) +
                         did_you_mean(name, known));
    }
    return *found;
}

std::string wanted(const EstimatorOption& option) {
    if (!option.words.empty()) {
        return "one of " + listed(option.words);
    }
    const EstimatorOption any;
    std::string noun = option.whole ? "a whole number" : "a number";
    if (option.lowest == any.lowest) {
        return noun;
    }
    if (option.highest == any.highest) {
        return noun + (option.above ? " above " : " from ") + shown(option.lowest);
    }
    return noun + " from " + shown(option.lowest) + " to " + shown(option.highest);
}

}  // namespace terratet
