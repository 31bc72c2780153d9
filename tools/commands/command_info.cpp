// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/base/output_file.hpp"
#include "io/write/write_hole_svg.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/printable.hpp"
#include "tools/options/site_options.hpp"
#include "tools/report/describe.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

class Info final : public Command {
  public:
    Syntax syntax() override {
        Syntax result{"info",
                      {{"Options",
                        {{{"json"}, "", "as JSON", &json_},
                         accept_edited_option(accept_edited_),
                         {{"digest"}, "", "of a model: the hash of its content, and nothing else", &digest_},
                         {{"holes"}, "", "quality of the boreholes that the inputs name, instead of a FILE", &holes_},
                         {{"o", "output"}, "FILE.svg", "with --holes: a picture of the worst hole", &output_},
                         {{"overwrite"}, "", "replace that picture if it exists", &overwrite_}}}},
                      {"FILE", 0, 1, &paths_}};
        append(result, hole_options(site_));
        return result;
    }

    int run(const std::vector<Given>&) override {
        const bool named = !site_.boreholes.empty() || !site_.surveys.empty() || !site_.logs.empty();
        if (holes_ || named) {
            return report_holes();
        }
        if (paths_.empty()) {
            throw UsageError("info: name a FILE, or the boreholes with --holes --boreholes FILE");
        }
        if (!output_.empty()) {
            throw UsageError("info: -o is for the picture of --holes");
        }
        const Source source = parse_source(paths_.front());
        std::string text;
        if (is_model(source.path)) {
            const LiveModel live = open_model(source.path, accept_edited_);
            const Model& model = live.model();
            text = digest_ ? model_digest(model) + "\n" : rendered(describe_model(model, load_journal(source.path)));
        } else if (digest_) {
            throw InputError(source.path + ": not a Terratet model; --digest is for models");
        } else {
            text = rendered(describe_file(source, column_names(site_.columns)));
        }
        return print(text);
    }

  private:
    int report_holes() {
        if (!holes_) {
            throw UsageError("info: --boreholes, --survey and --log go with --holes");
        }
        if (!paths_.empty()) {
            throw UsageError(fmt::format("info: --holes takes its inputs by --boreholes, --survey and --log, not '{}'",
                                         paths_.front()));
        }
        if (!output_.empty()) {
            require_writable(output_, overwrite_);
        }
        Diagnostics diagnostics;
        const HoleQuality quality = hole_quality(site_inputs(site_, false), diagnostics);
        if (!output_.empty() && quality.worst() != nullptr) {
            write_hole_svg(quality, *quality.worst(), output_, overwrite_);
        }
        return print(rendered(describe_holes(quality, diagnostics)));
    }

    [[nodiscard]] std::string rendered(const nlohmann::ordered_json& description) const {
        return json_ ? json_text(description) : as_text(description);
    }

    std::vector<std::string> paths_;
    bool json_ = false;
    bool accept_edited_ = false;
    bool digest_ = false;
    bool holes_ = false;
    bool overwrite_ = false;
    std::string output_;
    SiteArguments site_;
};

}  // namespace

CommandEntry info_command() {
    return {"info",
            "what is in an input or a model",
            "FILE | --holes --boreholes F [--survey F] [--log F]",
            "Says what a file is and holds: a model, a table and its layers, a well log (LAS, AGS, GEF, GOCAD, RMS), "
            "surfaces, or an output (glTF, VTK, OpenVDB, rasters): coordinates, columns and their ranges, what was "
            "guessed, defects "
            "with their reasons. With --holes, how good the boreholes are: overlaps, gaps, missing surveys, kinks, "
            "duplicates, "
            "holes without logs, each counted and listed.",
            {"terratet info site.gpkg", "terratet info well.las", "terratet info --json 'wells.gpkg,layer=collar'",
             "terratet info --digest site.gpkg",
             "terratet info --holes --boreholes collar.csv --log assay.csv -o worst.svg"},
            [] { return std::make_unique<Info>(); }};
}

}  // namespace terratet::tools
