// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "io/base/csv_text.hpp"
#include "io/base/text_lines.hpp"
#include "tess/error.hpp"
#include "tools/commands/model_session.hpp"
#include "tools/options/command.hpp"
#include "tools/options/command_line.hpp"
#include "tools/options/edit_options.hpp"
#include "tools/options/printable.hpp"
#include "tools/options/run_options.hpp"
#include "tools/options/text.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"
#include "tools/run/progress_display.hpp"

namespace terratet::tools {
namespace {

using nlohmann::ordered_json;

constexpr const char* own_group = "Options";

/// A list of edits, each a list of words as on the command line.
std::vector<Words> read_script(const std::string& path) {
    std::string text;
    LineReader lines(path == "-" ? "/vsistdin/" : path);
    for (std::string_view line; lines.next(line);) {
        text += std::string(line) + '\n';
    }
    const ordered_json script = ordered_json::parse(text, nullptr, false);
    if (script.is_discarded() || !script.is_array()) {
        throw InputError(path +
                         ": is no JSON list of edits, such as [[\"move-borehole\", \"KR1\", \"--by\", \"5,0,0\"]]");
    }
    std::vector<Words> verbs;
    for (const auto& words : script) {
        if (!words.is_array() || words.empty() ||
            !std::ranges::all_of(words, [](const ordered_json& word) { return word.is_string(); })) {
            throw InputError(fmt::format("{}: edit {} is no list of words", path, verbs.size() + 1));
        }
        verbs.push_back(words.get<Words>());
    }
    if (verbs.empty()) {
        throw InputError(path + ": holds no edit");
    }
    return verbs;
}

std::string history_text(const std::string& path) {
    std::string text = "edit,time,command,arguments,rows,undone\n";
    for (const auto& entry : history_json(path)) {
        const bool words = entry["arguments"].contains("words");
        std::string arguments;
        if (words) {
            for (const auto& word : entry["arguments"]["words"]) {
                arguments += (arguments.empty() ? "" : " ") + word.get<std::string>();
            }
        } else {
            arguments = entry["arguments"].dump();
        }
        text += fmt::format("{},", entry["edit"].get<std::int64_t>());
        for (const std::string& cell :
             {entry["time"].get<std::string>(), entry["command"].get<std::string>(), arguments}) {
            append_csv_text(text, cell);
            text += ',';
        }
        text += fmt::format("{},{}\n", entry["rows"].get<std::size_t>(), entry["undone"].get<bool>() ? 1 : 0);
    }
    return text;
}

class Edit final : public Command {
  public:
    Syntax syntax() override {
        Syntax syntax{"edit",
                      {{own_group,
                        {{{"dry-run"}, "", "say what would change, as JSON; change nothing", &dry_run_},
                         {{"script"},
                          "FILE.json",
                          "a list of edits, each a list of words as here; all or nothing, one edit to undo",
                          &script_},
                         {{"json"}, "", "say what was changed as JSON on standard output", &json_},
                         accept_edited_option(accept_edited_),
                         threads_option(threads_),
                         progress_option(progress_),
                         {{"q", "quiet"}, "", "no summary", &quiet_}}}},
                      {"MODEL.gpkg VERB", 1, 4, &words_}};
        append(syntax, edit_options(arguments_));
        return syntax;
    }

    int run(const std::vector<Given>& given) override {
        const std::string path = words_.front();
        const ThreadLimit threads(threads_);
        const std::vector<Words> verbs = verbs_given(given);
        if (verbs.front().front() == "history") {
            return json_ ? print(json_text(history_json(path))) : print(history_text(path));
        }
        ordered_json result;
        {
            ProgressDisplay display(progress_style(progress_, quiet_), stderr);
            ModelSession session(path, accept_edited_, display.callback());
            result = session.edit(verbs, dry_run_, display.callback());
        }
        if (json_ || dry_run_) {
            print(json_text(result));
        }
        summarise(result);
        return exit_done;
    }

  private:
    [[nodiscard]] std::vector<Words> verbs_given(const std::vector<Given>& given) const {
        if (!script_.empty()) {
            if (words_.size() > 1) {
                throw UsageError("edit: give either a verb or --script");
            }
            return read_script(script_);
        }
        if (words_.size() < 2) {
            throw UsageError("edit: a verb is missing: 'terratet help edit' lists them");
        }
        Words words(words_.begin() + 1, words_.end());
        for (const Given& option : given) {
            for (const std::string& value : option.values) {
                if (option.group != own_group) {
                    words.push_back("--" + option.name + "=" + value);
                }
            }
        }
        return {words};
    }

    void summarise(const ordered_json& result) const {
        if (quiet_) {
            return;
        }
        const auto& v = result["vertices"];
        spdlog::info("{}: {} vertices out, {} in, {} with other values; {} in all{}",
                     result["edit"].is_null() ? "dry run" : fmt::format("edit {}", result["edit"].get<std::int64_t>()),
                     grouped(v["removed"].get<std::uint64_t>()), grouped(v["added"].get<std::uint64_t>()),
                     grouped(v["changed"].get<std::uint64_t>()), grouped(v["after"].get<std::uint64_t>()),
                     result.contains("seconds") ? fmt::format(", {:.3g} s", result["seconds"].get<double>()) : "");
        if (!result.contains("notes")) {
            return;
        }
        for (const auto& record : result["rejected"]) {
            spdlog::warn("{}", one_line(record.dump()));
        }
        for (const auto& note : result["notes"]) {
            spdlog::info("{}", one_line(note.get<std::string>()));
        }
        for (const auto& fault : result["faults"]) {
            if (!fault["used"].get<bool>() || !fault["reason"].get<std::string>().empty()) {
                spdlog::warn("fault '{}': {}", one_line(fault["name"].get<std::string>()),
                             one_line(fault["reason"].get<std::string>()));
            }
        }
    }

    std::vector<std::string> words_;
    EditArguments arguments_;
    std::string script_;
    ProgressStyle progress_ = ProgressStyle::automatic;
    std::uint64_t threads_ = 0;
    bool dry_run_ = false;
    bool json_ = false;
    bool accept_edited_ = false;
    bool quiet_ = false;
};

}  // namespace

CommandEntry edit_command() {
    return {
        "edit",
        "change a model without building it anew",
        "MODEL.gpkg VERB ... | --script FILE.json",
        "Verbs: add-fault FILE, remove-fault NAME, replace-fault NAME FILE, add-boreholes with --boreholes, --survey "
        "and "
        "--log, remove-borehole ID, move-borehole ID --by dx,dy[,dz] or --to x,y,z, add-samples FILE, remove-samples "
        "--where SQL, set OPTION=VALUE (an option of build without its dashes), set-resolution WHERE=LMIN,LMAX, refine "
        "--box B, undo [N], redo [N], history. What is touched is tessellated and refined again, the rest stays as it "
        "is "
        "(set builds the model again); estimators keep what was fitted. Each call is one transaction: all of it is in "
        "the "
        "file, or nothing. undo needs no source file.",
        {"terratet edit site.gpkg remove-fault HZ20", "terratet edit site.gpkg move-borehole KR1 --by 5,0,0",
         "terratet edit site.gpkg set-resolution 0,0,-200,100,100,-100=5,20", "terratet edit site.gpkg undo"},
        [] { return std::make_unique<Edit>(); }};
}

}  // namespace terratet::tools
