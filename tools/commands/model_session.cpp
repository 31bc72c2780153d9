// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/model_session.hpp"

#include <algorithm>
#include <mutex>

#include "io/base/parse_number.hpp"
#include "tess/error.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/model_options.hpp"
#include "tools/report/diagnostics_json.hpp"
#include "tools/run/edit_verbs.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

using nlohmann::ordered_json;

ordered_json barriers_json(const std::vector<BarrierAccount>& accounts) {
    ordered_json list = ordered_json::array();
    for (const BarrierAccount& account : accounts) {
        list.push_back({{"name", account.name}, {"used", account.used}, {"reason", with_options(account.reason)}});
    }
    return list;
}

ordered_json change_json(const Model& before, const Model& after, const ChangeReport& report,
                         const Diagnostics& diagnostics) {
    const VertexChanges changes = vertex_changes(before, after);
    return {{"vertices",
             {{"before", before.vertices.size()},
              {"after", after.vertices.size()},
              {"removed", changes.removed.size()},
              {"added", changes.added.size()},
              {"changed", changes.changed.size()}}},
            {"samples",
             {{"before", before.samples.size()},
              {"after", after.samples.size()},
              {"vertices_removed", report.samples_out},
              {"vertices_added", report.samples_in},
              {"coincident", report.coincident},
              {"outside_extent", report.outside_extent}}},
            {"seeds", {{"removed", report.seeds_out}, {"added", report.seeds_in}}},
            {"refine",
             {{"taken_out", report.inserted_out},
              {"inserted", report.refine.inserted},
              {"moved", report.refine.moved},
              {"removed", report.refine.removed}}},
            {"faults", barriers_json(report.barriers)},
            {"rejected", rejected_json(diagnostics)},
            {"notes", notes_json(diagnostics)}};
}

std::size_t steps_of(const Words& words) {
    if (words.size() == 1) {
        return 1;
    }
    const auto count = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
    if (!count || !(*count >= 1 && *count <= 1e9) || *count != static_cast<double>(static_cast<std::size_t>(*count))) {
        throw UsageError("edit " + words[0] + ": it takes a number of edits, 1 by default");
    }
    return static_cast<std::size_t>(*count);
}

}  // namespace

bool is_step(const Words& words) {
    return !words.empty() && (words.front() == "undo" || words.front() == "redo");
}

ordered_json history_json(const std::string& path) {
    ordered_json list = ordered_json::array();
    for (const HistoryEntry& entry : load_history(path)) {
        ordered_json arguments = ordered_json::parse(entry.arguments, nullptr, false);
        list.push_back({{"edit", entry.edit},
                        {"time", entry.time},
                        {"command", entry.command},
                        {"arguments", arguments.is_discarded() ? ordered_json(entry.arguments) : arguments},
                        {"rows", entry.rows},
                        {"undone", entry.undone}});
    }
    return list;
}

ModelSession::ModelSession(std::string path, bool accept_edited, const Progress& progress) : path_(std::move(path)) {
    live_ = std::make_shared<LiveModel>(open_model(path_, accept_edited, progress, &state_));
}

std::shared_ptr<const ModelSnapshot> ModelSession::snapshot() const {
    std::shared_ptr<LiveModel> live;
    {
        const std::lock_guard lock(mutex_);
        live = live_;
    }
    return live->snapshot();
}

void ModelSession::reload() {
    StoredState state;
    auto live = std::make_shared<LiveModel>(open_model(path_, false, {}, &state));
    const std::lock_guard lock(mutex_);
    live_ = std::move(live);
    state_ = std::move(state);
}

ordered_json ModelSession::step(const Words& words) {
    const std::size_t count = steps_of(words);
    const auto before = snapshot();
    const auto done = words.front() == "undo" ? undo_edits(path_, count) : redo_edits(path_, count);
    reload();
    ordered_json edits = ordered_json::array();
    for (const JournalEntry& entry : done) {
        edits.push_back(entry.edit);
    }
    const auto after = snapshot();
    const VertexChanges changes = vertex_changes(before->model(), after->model());
    ordered_json result{{"edit", state_.last_edit},
                        {words.front() == "undo" ? "undone" : "redone", edits},
                        {"vertices",
                         {{"before", before->model().vertices.size()},
                          {"after", after->model().vertices.size()},
                          {"removed", changes.removed.size()},
                          {"added", changes.added.size()},
                          {"changed", changes.changed.size()}}}};
    tell(before, result);
    return result;
}

void ModelSession::tell(std::shared_ptr<const ModelSnapshot> before, const ordered_json& result) {
    if (on_change) {
        on_change({std::move(before), snapshot(), result});
    }
}

ordered_json ModelSession::edit(const std::vector<Words>& verbs, bool dry_run, const Progress& progress) {
    if (verbs.empty() || std::ranges::any_of(verbs, &Words::empty)) {
        throw UsageError("edit: a verb is missing");
    }
    if (verbs.size() == 1 && verbs.front().front() == "history") {
        return {{"history", history_json(path_)}};
    }
    if (is_step(verbs.front()) && verbs.size() == 1) {
        if (dry_run) {
            throw UsageError("edit " + verbs.front().front() +
                             " has no --dry-run; 'edit history' tells what it would do");
        }
        return step(verbs.front());
    }
    const Stopwatch watch;
    const auto before = snapshot();
    ModelPlan plan = plan_of(before->model());
    Diagnostics diagnostics;
    ordered_json words = ordered_json::array();
    for (const Words& verb : verbs) {
        apply_edit(parse_edit(verb), plan, diagnostics);
        words.push_back(verb);
    }
    LiveModel next(before);
    RefineOptions refine;
    refine.max_vertices = fitting_vertex_limit();
    const ChangeReport report = next.edit(std::move(plan), progress, refine);
    const auto after = next.snapshot();
    ordered_json result{{"edit", nullptr}};
    result.update(change_json(before->model(), after->model(), report, diagnostics));
    if (!dry_run) {
        const bool one = verbs.size() == 1;
        const ordered_json arguments{{one ? "words" : "script", one ? words.front() : words}};
        StoredState state =
            store_edit(path_, before->model(), state_, after->model(),
                       {0, "", "edit", arguments.dump(-1, ' ', false, ordered_json::error_handler_t::replace)});
        const std::lock_guard lock(mutex_);
        state_ = std::move(state);
        live_ = std::make_shared<LiveModel>(std::move(next));
        result["edit"] = state_.last_edit;
    }
    result["seconds"] = watch.seconds();
    if (!dry_run) {
        tell(before, result);
    }
    return result;
}

}  // namespace terratet::tools
