// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/live_protocol.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tools/options/command_line.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/text.hpp"
#include "tools/report/diagnostics_json.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/process.hpp"
#include "tools/run/query.hpp"

namespace terratet::tools {
namespace {

using nlohmann::ordered_json;

ordered_json cell_json(const RowCell& cell) {
    switch (cell.kind) {
        case RowCell::Kind::number:
            return std::isfinite(cell.number) ? ordered_json(cell.number) : ordered_json(nullptr);
        case RowCell::Kind::integer:
            return cell.integer;
        case RowCell::Kind::text:
            return cell.text;
        case RowCell::Kind::nothing:
            break;
    }
    return nullptr;
}

/// Rows as lists of cells; polygons beside them.
class JsonRows final : public RowSink {
  public:
    void begin(const std::vector<RowColumn>& columns) override {
        for (const RowColumn& column : columns) {
            json_["columns"].push_back(column.name);
        }
        json_["rows"] = ordered_json::array();
    }
    void add(const std::vector<Row>& rows) override {
        for (const Row& row : rows) {
            ordered_json cells = ordered_json::array();
            for (const RowCell& cell : row.cells) {
                cells.push_back(cell_json(cell));
            }
            json_["rows"].push_back(std::move(cells));
            if (row.outline.size() > 1) {
                ordered_json outline = ordered_json::array();
                for (const Vec3& p : row.outline) {
                    outline.push_back({p.x, p.y, p.z});
                }
                json_["polygons"].push_back(std::move(outline));
            }
        }
    }
    void end() override {}
    [[nodiscard]] ordered_json take() { return std::move(json_); }

  private:
    ordered_json json_ = ordered_json::object();
};

Words words_of(const ordered_json& list, const char* what) {
    if (!list.is_array() || list.empty() ||
        !std::ranges::all_of(list, [](const ordered_json& word) { return word.is_string(); })) {
        throw UsageError(std::string("\"") + what + "\" is a list of words, as on the command line");
    }
    return list.get<Words>();
}

ordered_json query(const ModelSnapshot& model, const Words& words) {
    JsonRows rows;
    QueryRemarks remarks;
    run_query(model, parse_query(words), rows, remarks);
    ordered_json result = rows.take();
    if (!remarks.diagnostics.rejected.empty()) {
        result["rejected"] = rejected_json(remarks.diagnostics);
    }
    return result;
}

ordered_json export_files(const ModelSnapshot& model, const std::string& input, const Words& words) {
    ExportArguments exporting;
    RunArguments run;
    std::vector<std::string> paths;
    Syntax syntax{"export", export_options(exporting), {"OUTPUT", 1, 1000, &paths}};
    append(syntax, run_options(run));
    parse_arguments(syntax, words);
    if (exporting.uncertainty) {
        throw UsageError("a live session exports what the model holds: build it with --uncertainty");
    }
    check_outputs(paths, {input}, exporting, run);
    ordered_json outputs = ordered_json::array();
    for (const OutputRecord& output : write_outputs(model, paths, exporting, run, {}, {}).outputs) {
        outputs.push_back({{"path", output.path}, {"bytes", output.bytes}});
    }
    return {{"outputs", outputs}};
}

using Ids = std::array<std::uint64_t, 4>;

std::vector<Ids> cell_ids(const ModelSnapshot& snapshot) {
    std::vector<Ids> cells;
    const auto& vertices = snapshot.model().vertices;
    for (const auto& cell : snapshot.mesh().cells) {
        Ids& ids = cells.emplace_back();
        std::ranges::transform(cell, ids.begin(), [&](std::uint32_t v) { return vertices[v].id; });
        std::ranges::sort(ids);
    }
    std::ranges::sort(cells);
    return cells;
}

ordered_json vertices_json(const Model& model, const std::vector<std::uint64_t>& ids) {
    ordered_json list = ordered_json::array();
    for (const std::uint64_t id : ids) {
        const auto at = std::ranges::lower_bound(model.vertices, id, {}, &Vertex::id) - model.vertices.begin();
        const Vec3 p = model.frame.to_world(model.vertices[static_cast<std::size_t>(at)].position);
        ordered_json vertex{{"id", id}, {"x", p.x}, {"y", p.y}, {"z", p.z}};
        for (std::size_t k = 0; k < model.properties.size(); ++k) {
            vertex["values"][model.properties[k].name] =
                cell_json(value_cell(model.properties[k], model.vertex_values.values[k][static_cast<std::size_t>(at)]));
        }
        list.push_back(std::move(vertex));
    }
    return list;
}

}  // namespace

ordered_json event_json(const SessionChange& change) {
    const VertexChanges vertices = vertex_changes(change.before->model(), change.after->model());
    const std::vector<Ids> before = cell_ids(*change.before);
    const std::vector<Ids> after = cell_ids(*change.after);
    std::vector<Ids> removed;
    std::vector<Ids> added;
    std::ranges::set_difference(before, after, std::back_inserter(removed));
    std::ranges::set_difference(after, before, std::back_inserter(added));
    return {{"event", "change"},
            {"edit", change.result.value("edit", ordered_json(nullptr))},
            {"vertices",
             {{"removed", vertices.removed},
              {"added", vertices_json(change.after->model(), vertices.added)},
              {"changed", vertices_json(change.after->model(), vertices.changed)}}},
            {"cells", {{"removed", removed}, {"added", added}}}};
}

ordered_json LiveProtocol::result_of(const ordered_json& request) {
    const auto asked = [&](const char* what) { return request.contains(what); };
    const bool dry_run = request.value("dry_run", ordered_json(false)) == true;
    if (asked("edit")) {
        const std::lock_guard lock(editing_);
        return session_.edit({words_of(request["edit"], "edit")}, dry_run);
    }
    if (asked("script")) {
        if (!request["script"].is_array()) {
            throw UsageError("\"script\" is a list of edits, each a list of words");
        }
        std::vector<Words> verbs;
        for (const auto& words : request["script"]) {
            verbs.push_back(words_of(words, "script"));
        }
        const std::lock_guard lock(editing_);
        return session_.edit(verbs, dry_run);
    }
    const auto state = session_.snapshot();
    if (asked("query")) {
        return query(*state, words_of(request["query"], "query"));
    }
    if (asked("section")) {
        Words words = words_of(request["section"], "section");
        words.insert(words.begin(), "section");
        return query(*state, words);
    }
    if (asked("export")) {
        return export_files(*state, session_.path(), words_of(request["export"], "export"));
    }
    const std::vector<std::string> known{"edit", "script", "query", "section", "export", "subscribe"};
    std::string meant;
    for (const auto& [key, value] : request.items()) {
        meant = meant.empty() ? did_you_mean(key, known) : meant;
    }
    throw UsageError("a request holds one of " + listed(known) + meant);
}

ordered_json LiveProtocol::answer(const std::string& request) {
    const Stopwatch watch;
    ordered_json answer{{"id", nullptr}, {"ok", false}};
    const auto fail = [&](const std::string& what) { answer["error"] = with_options(one_line(what)); };
    try {
        const ordered_json json = ordered_json::parse(request, nullptr, false);
        if (!json.is_object()) {
            throw UsageError("a request is one JSON object on one line");
        }
        answer["id"] = json.value("id", ordered_json(nullptr));
        answer["result"] = result_of(json);
        answer["ok"] = true;
    } catch (const Cancelled&) {
        fail("interrupted; nothing was changed");
    } catch (const std::bad_alloc&) {
        fail(out_of_memory);
    } catch (const std::exception& error) {
        fail(error.what());
    }
    answer["seconds"] = watch.seconds();
    return answer;
}

}  // namespace terratet::tools
