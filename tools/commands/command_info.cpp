// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/printable.hpp"
#include "tools/report/describe.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

/// A layer of triangles is a table too, of attributes only: what it is for are its surfaces.
nlohmann::ordered_json describe_input(const Source& source) {
    Diagnostics diagnostics;
    if (is_gocad(source.path)) {
        return describe_surfaces(read_surfaces(source, SurfaceKind::fault, {}, diagnostics), diagnostics);
    }
    const Table table = read_table(source);
    const bool has_places = !table.points.empty() || find_column(table, Meaning::x, {}) >= 0;
    if (!has_places) {
        try {
            const RawSurfaces surfaces = read_surfaces(source, SurfaceKind::fault, {}, diagnostics);
            return describe_surfaces(surfaces, diagnostics);
        } catch (const InputError&) {
            // A plain table, then.
        }
    }
    return describe_table(table);
}

class Info final : public Command {
  public:
    Syntax syntax() override {
        return {"info",
                {{"Options",
                  {{{"json"}, "", "as JSON", &json_},
                   accept_edited_option(accept_edited_),
                   {{"digest"}, "", "of a model: the hash of its content, and nothing else", &digest_}}}},
                {"FILE", 1, 1, &paths_}};
    }

    int run(const std::vector<Given>&) override {
        const Source source = parse_source(paths_.front());
        std::string text;
        if (is_model(source.path)) {
            const Model model = open_model(source.path, accept_edited_);
            text = digest_ ? model_digest(model) + "\n" : rendered(describe_model(model, load_journal(source.path)));
        } else if (digest_) {
            throw InputError(source.path + ": not a Terratet model; --digest is for models");
        } else {
            text = rendered(describe_input(source));
        }
        return print(text);
    }

  private:
    [[nodiscard]] std::string rendered(const nlohmann::ordered_json& description) const {
        return json_ ? json_text(description) : as_text(description);
    }

    std::vector<std::string> paths_;
    bool json_ = false;
    bool accept_edited_ = false;
    bool digest_ = false;
};

}  // namespace

CommandEntry info_command() {
    return {
        "info",
        "what is in an input or a model",
        "FILE[,layer=L]",
        "Says what a model, a table or a file of surfaces holds: coordinates, columns and their ranges, surfaces and "
        "their dips, criteria and history.",
        {"terratet info site.gpkg", "terratet info fault.ts", "terratet info --json 'wells.gpkg,layer=collar'",
         "terratet info --digest site.gpkg"},
        [] { return std::make_unique<Info>(); }};
}

}  // namespace terratet::tools
