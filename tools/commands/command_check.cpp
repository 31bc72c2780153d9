// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/model_store.hpp"
#include "tools/options/command.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/printable.hpp"
#include "tools/options/run_options.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"
#include "tools/run/progress_display.hpp"

namespace terratet::tools {
namespace {

std::string as_json(const std::vector<Verdict>& verdicts) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& verdict : verdicts) {
        list.push_back({{"guarantee", verdict.guarantee},
                        {"holds", verdict.holds},
                        {"statement", verdict.statement},
                        {"detail", with_options(verdict.detail)}});
    }
    return json_text(list);
}

std::string as_lines(const std::vector<Verdict>& verdicts) {
    std::string out;
    for (const auto& verdict : verdicts) {
        out += fmt::format("{:4} {:7} {}{}\n", verdict.guarantee, verdict.holds ? "holds" : "BROKEN", verdict.statement,
                           verdict.detail.empty() ? "" : " (" + printable(with_options(verdict.detail)) + ")");
    }
    return out;
}

class Check final : public Command {
  public:
    Syntax syntax() override {
        return {"check",
                {{"Options",
                  {{{"json"}, "", "as JSON", &json_},
                   {{"all"},
                    "",
                    "ask the estimator at every cell, not at 20,000 random places alone: as long as the build took",
                    &all_},
                   accept_edited_option(accept_edited_),
                   threads_option(threads_),
                   progress_option(progress_),
                   {{"q", "quiet"}, "", "no bar", &quiet_}}}},
                {"MODEL.gpkg", 1, 1, &paths_}};
    }

    int run(const std::vector<Given>&) override {
        const ThreadLimit threads(threads_);
        const LiveModel live(load_model(paths_.front(), {.accept_edited = accept_edited_}));
        std::vector<Verdict> verdicts;
        {
            ProgressDisplay display(progress_style(progress_, quiet_), stderr);
            verdicts = verdicts_on(live, paths_.front(), display.callback(), {.all = all_});
        }
        print(json_ ? as_json(verdicts) : as_lines(verdicts));
        const bool all = std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.holds; });
        return all ? exit_done : exit_failed;
    }

  private:
    std::vector<std::string> paths_;
    std::uint64_t threads_ = 0;
    ProgressStyle progress_ = ProgressStyle::automatic;
    bool json_ = false;
    bool all_ = false;
    bool accept_edited_ = false;
    bool quiet_ = false;
};

}  // namespace

CommandEntry check_command() {
    return {
        "check",
        "verify a model's guarantees again",
        "MODEL.gpkg",
        "Verifies each guarantee of a stored model from its definition, one line each; to see that it depends on its "
        "input alone, the model is built again. Exit code 1 when one does not hold.",
        {"terratet check site.gpkg"},
        [] { return std::make_unique<Check>(); }};
}

}  // namespace terratet::tools
