// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "interp/estimator_spec.hpp"
#include "interp/ranks/ranks.hpp"
#include "io/base/output_file.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/model_options.hpp"
#include "tools/options/printable.hpp"
#include "tools/options/run_options.hpp"
#include "tools/options/site_options.hpp"
#include "tools/options/values.hpp"
#include "tools/report/diagnostics_json.hpp"
#include "tools/report/validation.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/process.hpp"
#include "tools/run/progress_display.hpp"
#include "tools/version.hpp"

namespace terratet::tools {
namespace {

bool is_fault(const Surface& surface) {
    return surface.kind == SurfaceKind::fault;
}

class Validate final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{"validate", site_options(site_), {"MODEL.gpkg", 0, 1, &models_}};
        append(
            syntax,
            {{"Validation",
              {
                  {{"estimator"},
                   "SPEC",
                   "one to try, repeatable; by default natural, idw, kriging, nearest",
                   &estimators_},
                  {{"suggest"}, "", "what --estimator auto would choose, with the table of what was tried", &suggest_},
                  {{"folds"}, "N", "boreholes share N groups; by default each is left out alone", &folds_},
                  horizon_option(single(horizon_, parse_horizon)),
                  accept_edited_option(accept_edited_),
                  {{"plot"}, "FILE.svg", "draw variograms and estimated over measured values", &plot_},
              }}});
        append(syntax, run_options(run_));
        return syntax;
    }

    bool share_among(const Ranks& ranks) override {
        run_.ranks = &ranks;
        return true;
    }

    int run(const std::vector<Given>&) override {
        std::vector<EstimatorSpec> specs;
        for (const auto& text :
             estimators_.empty() ? std::vector<std::string>{"natural", "idw", "kriging", "nearest"} : estimators_) {
            specs.push_back(with_open_chosen(parse_estimator(text)));
        }
        std::vector<std::string> inputs = input_paths(site_);
        inputs.insert(inputs.end(), models_.begin(), models_.end());
        const bool writes = run_.ranks == nullptr || run_.ranks->is_root();
        if (writes) {
            check_places(plot_.empty() ? std::vector<std::string>{} : std::vector{plot_}, inputs, run_);
        }
        start_together(run_.ranks);
        const ThreadLimit threads(run_.threads);
        Diagnostics diagnostics;
        std::shared_ptr<const ModelSnapshot> state;
        std::vector<PropertyValidation> all;
        {
            ProgressDisplay display(progress_style(run_.progress, run_.quiet), stderr);
            state = input(diagnostics, display.callback()).snapshot();
            CrossValidationOptions options;
            options.max_folds = folds_;
            options.ranks = run_.ranks;
            all = validate_all(state->model(), state->barriers(), specs, options, suggest_, display.callback());
        }
        const Model& model = state->model();
        if (all.empty()) {
            throw InputError("no property has a sample: there is nothing to validate");
        }
        if (!writes) {
            return exit_done;
        }
        if (!plot_.empty()) {
            write_svg(validation_charts(model, all), plot_, run_.overwrite);
        }
        write_json(model, diagnostics, all);
        if (run_.report != "-") {
            print(printable(validation_text(model, all), true));
        }
        return exit_done;
    }

  private:
    [[nodiscard]] LiveModel input(Diagnostics& diagnostics, const Progress& progress) const {
        if (models_.empty()) {
            ReadCounts counts;
            Site site = read_site(site_inputs(site_, run_.strict), diagnostics, counts, progress);
            composite_as_asked(site, site_, diagnostics);
            set_horizons(horizon_.value_or(HardHorizons{}), site);
            return LiveModel::measured(std::move(site));
        }
        LiveModel stored = open_model(models_.front(), accept_edited_, progress);
        if (!horizon_) {
            return stored;
        }
        Model model = stored.model();
        set_horizons(*horizon_, model);  // another than it was built with
        return LiveModel(std::move(model));
    }

    void write_json(const Model& model, const Diagnostics& diagnostics, const std::vector<PropertyValidation>& all) {
        if (run_.report.empty()) {
            return;
        }
        using Json = nlohmann::ordered_json;
        const Json report{{"terratet", version},
                          {"input",
                           {{"boreholes", model.boreholes.size()},
                            {"samples", model.samples.size()},
                            {"faults", models_.empty() ? std::ranges::count_if(model.surfaces, is_fault)
                                                       : std::ssize(model.barriers)},
                            {"rejected", rejected_json(diagnostics)},
                            {"notes", notes_json(diagnostics)}}},
                          {"properties", validation_json(model, all)}};
        const std::string text = json_text(report);
        if (run_.report == "-") {
            print(text);
            return;
        }
        OutputFile file(run_.report, run_.overwrite);
        file.write(text);
        file.commit();
    }

    SiteArguments site_;
    RunArguments run_;
    std::vector<std::string> models_;
    std::vector<std::string> estimators_;
    std::string plot_;
    std::optional<HardHorizons> horizon_;
    bool accept_edited_ = false;
    bool suggest_ = false;
    std::uint64_t folds_ = 0;
};

}  // namespace

CommandEntry validate_command() {
    return {
        "validate",
        "cross-validation: which estimator suits the data",
        "[inputs | MODEL.gpkg] [--estimator SPEC …]",
        "Leaves each borehole out, estimates it from the others, and compares with what was measured: errors, bias, "
        "rank correlation, and how often the truth lies within the stated uncertainty. Shows each property's "
        "variogram, along and across the holes. An anisotropy that is not given is chosen as build does, from all "
        "holes; --suggest shows how.",
        {"terratet validate site.gpkg --plot site.svg", "terratet validate site.gpkg --suggest",
         "terratet validate --boreholes collar.csv --survey survey.csv --log assay.csv \\",
         "  --property CU --estimator natural --estimator kriging:model=exponential"},
        [] { return std::make_unique<Validate>(); }};
}

}  // namespace terratet::tools
