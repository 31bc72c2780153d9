// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "interp/ranks/ranks.hpp"
#include "io/write/section_image.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/run_options.hpp"
#include "tools/options/text.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

/// CSV on standard output, as it comes.
class Printed final : public RowSink {
  public:
    void begin(const std::vector<RowColumn>& columns) override { print(csv_line(columns)); }
    void add(const std::vector<Row>& rows) override { print(csv_lines(rows)); }
    void end() override {}
};

class Query final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{
            "query",
            {{"Options",
              {{{"o", "output"},
                "FILE",
                "rows to a file, - for standard output: .csv, .geojson, .gpkg, .fgb, .xlsx, …; a section's .tif, .svg",
                &output_},
               {{"overwrite"}, "", "replace it", &overwrite_},
               accept_edited_option(accept_edited_),
               threads_option(threads_),
               {{"q", "quiet"}, "", "no remarks on standard error", &quiet_}}}},
            {"MODEL.gpkg VERB POINTS", 2, 3, &words_}};
        append(syntax, query_options(arguments_));
        return syntax;
    }

    /// Estimates take long; other verbs do not.
    bool share_among(const Ranks& ranks) override {
        const bool shared = words_.size() > 1 && words_[1] == "value";
        arguments_.ranks = shared ? &ranks : nullptr;
        return shared;
    }

    int run(const std::vector<Given>&) override {
        const ThreadLimit threads(threads_);
        arguments_.words.assign(words_.begin() + 1, words_.end());
        const auto state = open_model(words_[0], accept_edited_).snapshot();
        const ModelSnapshot& opened = *state;
        const bool writes = arguments_.ranks == nullptr || arguments_.ranks->is_root();
        Printed printed;
        std::unique_ptr<RowSink> file;
        if (writes && !output_.empty() && output_ != "-") {
            const Model& model = opened.model();
            const std::string& verb = arguments_.words.front();
            file = verb == "section" && is_section_image(output_)
                       ? section_to_image(output_, model.properties, model.frame, overwrite_)
                       : rows_to_file(output_, verb, model.frame, overwrite_);
        }
        QueryRemarks remarks;
        run_query(opened, arguments_, file ? *file : printed, remarks);
        if (!quiet_) {
            tell(remarks);
        }
        return exit_done;
    }

  private:
    static void tell(const QueryRemarks& remarks) {
        for (const auto& record : remarks.diagnostics.rejected) {
            spdlog::warn("{}",
                         one_line(fmt::format("{}, line {}: {}; no value", record.file, record.line, record.reason)));
        }
        for (const auto& note : remarks.diagnostics.notes) {
            spdlog::info("{}", one_line(note));
        }
        if (remarks.excluded > 0) {
            spdlog::info("{} places are above the ground or outside the domain: no value", remarks.excluded);
        }
        for (const auto& line : remarks.deviations) {
            spdlog::info("{}", line);
        }
    }

    std::vector<std::string> words_;
    QueryArguments arguments_;
    std::string output_;
    std::uint64_t threads_ = 0;
    bool overwrite_ = false;
    bool quiet_ = false;
    bool accept_edited_ = false;
};

}  // namespace

CommandEntry query_command() {
    return {
        "query",
        "values, vertices, cells, lines, sections and volumes",
        "MODEL.gpkg VERB [POINTS | --at X,Y,Z]",
        "POINTS is a table with x, y, z, or - for standard input. Verbs: value estimates each property from the "
        "model's "
        "samples: the table's columns, then NAME, NAME_sd, NAME_ci95 (half-width of the 95 % interval) and "
        "NAME_extrapolation, empty where there is no value: also above the ground and outside the domain (a name that "
        "the table has already gets _estimate behind it). nearest -k K, within -d D, box --box B, neighbours (in the "
        "Voronoi sense; of a place or a --borehole): a row per vertex. cell: the cell a place lies in. line: a virtual "
        "borehole through two places or more, with the faults it crosses. section: polygons of a vertical curtain "
        "along "
        "places, or of a --plane. region: volumes of the fault blocks, with --above P=V the volume above a value; with "
        "places, the block that holds each. CSV on standard output, or -o FILE.",
        {"terratet query site.gpkg value places.csv > values.csv",
         "printf 'x,y,z\\n525500,6792000,-200\\n' | terratet query site.gpkg value -",
         "terratet query site.gpkg nearest --at 525500,6792000,-200 -k 8",
         "terratet query site.gpkg section line.csv -o section.gpkg", "terratet query site.gpkg region --above CU=0.6"},
        [] { return std::make_unique<Query>(); }};
}

}  // namespace terratet::tools
