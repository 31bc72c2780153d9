// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report/report.hpp"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "interp/estimator_plan.hpp"
#include "io/base/output_file.hpp"
#include "io/base/time_steps.hpp"
#include "tess/barrier_query.hpp"
#include "tess/mesh/quality.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/printable.hpp"
#include "tools/report/calibration_json.hpp"
#include "tools/report/diagnostics_json.hpp"
#include "tools/run/process.hpp"
#include "tools/version.hpp"

namespace terratet::tools {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // kilobytes on Linux
}

Json censored_json(const Model& model) {
    Json censored = Json::object();
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (const std::size_t count = model.samples.censored_count(p); count > 0) {
            censored[model.properties[p].name] = count;
        }
    }
    return censored;
}

Json input_json(const BuildRecord& build, const Model& model) {
    return {{"boreholes", build.counts.boreholes},
            {"samples", build.counts.samples},
            {"times", time_steps(model.properties)},
            {"faults", build.counts.faults},
            {"censored", censored_json(model)},
            {"rejected", rejected_json(build.diagnostics)},
            {"rejected_by_reason", rejected_by_reason_json(build.diagnostics)},
            {"notes", notes_json(build.diagnostics)}};
}

Json faults_json(const std::vector<BarrierAccount>& accounts) {
    Json faults = Json::array();
    for (const auto& account : accounts) {
        faults.push_back({{"name", account.name},
                          {"kind", to_string(account.kind)},
                          {"file", account.file},
                          {"used", account.used},
                          {"reason", with_options(account.reason)},
                          {"parts", account.parts},
                          {"seeds", account.seeds},
                          {"area_in", account.area_in},
                          {"area_used", account.area_used},
                          {"area_outside", account.area_outside},
                          {"area_trimmed", account.area_trimmed},
                          {"area_refused", account.area_refused},
                          {"deviation_median", account.deviation_median},
                          {"deviation_p95", account.deviation_p95},
                          {"deviation_max", account.deviation_max},
                          {"triangles", account.triangles},
                          {"certified", account.certified},
                          {"unseparated", account.unseparated},
                          {"finest_spacing", account.finest_spacing},
                          {"dropped_triangles", account.dropped_triangles}});
    }
    return faults;
}

/// The samples that left the tessellation for faults, each with the fault.
Json near_faults_json(const BuildReport& report, const Model& model) {
    Json list = Json::array();
    const BarrierQuery faults(model.barriers);
    for (const std::uint32_t i : report.density.near_faults) {
        const Vec3& p = model.samples.positions[i];
        const Vec3 at = model.frame.to_world(p);
        Json sample = Json::object();
        if (const std::int32_t hole = model.samples.borehole[i]; hole >= 0) {
            sample["borehole"] = model.boreholes[static_cast<std::size_t>(hole)].id;
            sample["depth"] = model.samples.depth[i];
        }
        sample["position"] = {at.x, at.y, at.z};
        if (const std::int32_t fault = faults.protecting_barrier(p); fault >= 0) {
            sample["fault"] = model.barriers[static_cast<std::size_t>(fault)].name;
        }
        list.push_back(std::move(sample));
    }
    return list;
}

Json preprocess_json(const BuildReport& report, const Model& model) {
    return {{"samples_kept", report.density.kept.size()},
            {"samples_deleted", report.density.deleted},
            {"samples_near_faults", report.density.near_faults.size()},
            {"near_faults", near_faults_json(report, model)},
            {"seeds", report.seeds},
            {"domain_vertices", report.domain_vertices},
            {"coincident", report.coincident},
            {"outside_extent", report.outside_extent}};
}

Json initial_json(const CellStatistics& cells) {
    return {{"vertices", cells.vertices},
            {"tetrahedra", cells.tetrahedra},
            {"skinny_percent", cells.skinny_percent},
            {"flat_percent", cells.flat_percent},
            {"bad_percent", cells.bad_percent}};
}

Json refine_json(const RefineReport& report) {
    Json skipped = Json::object();
    for (const auto& [reason, cells] : report.skipped) {
        skipped[to_string(reason)] = cells;
    }
    return {{"inserted", report.inserted},   {"moved", report.moved}, {"removed", report.removed},
            {"estimates", report.estimates}, {"bound", report.bound}, {"skipped", skipped}};
}

Json final_json(const RunRecord& record) {
    const CellStatistics& cells = record.build->report.final;
    const double metres = record.model->model().frame.metres_per_unit;
    return {{"vertices", cells.vertices},
            {"tetrahedra", cells.tetrahedra},
            {"gap_tetrahedra", cells.gap_tetrahedra},
            {"skinny_percent", cells.skinny_percent},
            {"flat_percent", cells.flat_percent},
            {"bad_percent", cells.bad_percent},
            {"dihedral_deg",
             {{"min", cells.dihedral_min_deg},
              {"p1", cells.dihedral_p1_deg},
              {"p5", cells.dihedral_p5_deg},
              {"median", cells.dihedral_median_deg}}},
            {"edge_m", {{"min", cells.edge_min * metres}, {"max", cells.edge_max * metres}}},
            {"fault_crossing_edges", record.build->report.fault_crossing_edges},
            {"delaunay", record.model->is_delaunay()},
            {"regions", cells.regions},
            {"below",
             {{"dihedral", cells.below_dihedral},
              {"dihedral_given", cells.below_dihedral_given},
              {"vmin", cells.below_v_min}}}};
}

Json regions_json(const RunRecord& record) {
    Json list = Json::array();
    // Of the collapsed mesh: what is in a fault's gap belongs to the two sides.
    const CollapsedModel& collapsed = record.model->collapsed(Collapsing::all);
    const CellTable& cells = collapsed.cells;
    const auto volumes = region_volumes({collapsed.model, collapsed.mesh, cells, nullptr, &record.model->barriers()});
    for (std::size_t region = 0; region < volumes.size(); ++region) {
        list.push_back({{"number", region},
                        {"name", cells.region_name[region]},
                        {"volume", volumes[region]},
                        {"without_values", Json::array()}});
    }
    for (const EmptyBlock& block : record.build->report.empty_blocks) {
        list[static_cast<std::size_t>(block.region)]["without_values"] = block.properties;
    }
    return list;
}

/// By property, of those whose errors were learnt.
Json uncertainty_json(const Model& model) {
    Json uncertainty = Json::object();
    for (const auto& [property, calibration] : parse_estimator_plan(model.estimator).calibrations) {
        uncertainty[property] = calibration_json(calibration);
    }
    return uncertainty;
}

/// By property, of those whose estimator was chosen.
Json choices_json(const Model& model) {
    Json choices = Json::object();
    const EstimatorPlan plan = parse_estimator_plan(model.estimator);
    for (const auto& [property, choice] : plan.choices) {
        const auto tried = [](double rms) { return rms > 0 ? Json(rms) : Json(); };
        choices[property] = {{"estimator", plan.of(property).as_given()},
                             {"rms", tried(choice.rms)},
                             {"rms_plain", tried(choice.rms_plain)},
                             {"better_folds", choice.better_folds},
                             {"folds", choice.folds}};
    }
    return choices;
}

Json fidelity_json(const RunRecord& record) {
    Json fidelity = Json::object();
    const auto& all = record.build->report.fidelity;
    for (std::size_t p = 0; p < all.size(); ++p) {
        Json& json = fidelity[record.model->model().properties[p].name];
        json = {{"rms", all[p].rms}, {"max", all[p].max},    {"count", all[p].count},      {"sd", all[p].sd},
                {"r2", all[p].r2},   {"tolerance", nullptr}, {"beyond_tolerance", nullptr}};
        if (all[p].tolerance > 0) {
            json["tolerance"] = all[p].tolerance;
            json["beyond_tolerance"] = all[p].beyond_tolerance;
            json["reasons"] = Json::object();
            for (const auto& [reason, count] : all[p].reasons) {
                json["reasons"][to_string(reason)] = count;
            }
        }
    }
    return fidelity;
}

Json seconds_json(const RunRecord& record) {
    Json seconds = Json::object();
    if (record.build != nullptr) {
        for (const char* stage : {"read", "density", "boundary", "refine", "estimate"}) {
            const auto found = record.build->seconds.find(stage);
            seconds[stage] = found == record.build->seconds.end() ? 0.0 : found->second;
        }
    }
    seconds["write"] = record.write_seconds;
    seconds["total"] = record.total_seconds;
    return seconds;
}

Json places_json(const std::vector<Vec3>& places, const Frame& frame) {
    Json list = Json::array();
    for (const Vec3& place : places) {
        const Vec3 p = frame.to_world(place);
        list.push_back({p.x, p.y, p.z});
    }
    return list;
}

Json clipped_json(const ClippedShapes& shapes) {
    return {{"cells", shapes.cells},
            {"dihedral_deg", {{"min", shapes.dihedral_min_deg}, {"p1", shapes.dihedral_p1_deg}}},
            {"edge_min", shapes.edge_min},
            {"below_1_deg", shapes.below_1_deg},
            {"below_10_deg", shapes.below_10_deg},
            {"short_edges", shapes.short_edges},
            {"at_samples", shapes.at_sample},
            {"at_faults", shapes.at_fault},
            {"as_tessellated", shapes.as_tessellated},
            {"other", shapes.other}};
}

Json collapse_json(const CollapseReport& collapse, const Frame& frame) {
    return {{"dropped_cells", collapse.dropped_cells},
            {"mirrored_facets", collapse.conformity.mirrored_facets},
            {"split_places", collapse.split_places},
            {"added_places", collapse.added_places},
            {"split_area", collapse.split_area},
            {"sheet_area", collapse.sheet_area},
            {"unsplit_between_regions", collapse.conformity.leaking},
            {"volume_error", collapse.conformity.volume_error},
            {"apart", places_json(collapse.apart, frame)},
            {"aside", places_json(collapse.aside, frame)}};
}

}  // namespace

std::string report_text(const RunRecord& record) {
    const Frame& frame = record.model->model().frame;
    Json report;
    report["terratet"] = version;
    if (record.build != nullptr) {
        report["input"] = input_json(*record.build, record.model->model());
    }
    report["frame"] = {{"crs", frame.crs_name.empty() ? "local" : frame.crs_name},
                       {"unit", frame.unit},
                       {"origin", {frame.origin.x, frame.origin.y, frame.origin.z}},
                       {"z_scale", frame.z_scale}};
    if (record.build != nullptr) {
        const BuildRecord& build = *record.build;
        Json defaults = Json::object();
        for (const auto& [option, value] : build.defaults) {
            defaults[option] = value;
        }
        Json options = Json::object();
        for (const auto& [key, value] : build.estimator.options) {
            options[key] = value;
        }
        report["defaults"] = defaults;
        report["preprocess"] = preprocess_json(build.report, record.model->model());
        report["faults"] = faults_json(build.report.barriers);
        report["initial"] = initial_json(build.report.initial);
        report["refine"] = refine_json(build.report.refine);
        report["final"] = final_json(record);
        report["regions"] = regions_json(record);
        report["fidelity"] = fidelity_json(record);
        report["estimator"] = {{"name", build.estimator.name},
                               {"options", options},
                               {"fitted", record.model->model().estimator},
                               {"fallbacks", build.report.fallbacks},
                               {"chosen", choices_json(record.model->model())},
                               {"uncertainty", uncertainty_json(record.model->model())}};
    }
    report["outputs"] = Json::array();
    for (const auto& output : record.written.outputs) {
        report["outputs"].push_back({{"path", output.path}, {"bytes", output.bytes}});
        if (output.clipped) {
            report["outputs"].back()["clipped"] = clipped_json(*output.clipped);
        }
    }
    if (record.written.collapse) {
        report["collapse"] = collapse_json(*record.written.collapse, frame);
    }
    report["seconds"] = seconds_json(record);
    report["peak_memory_bytes"] = peak_memory_bytes();
    return json_text(report);
}

void write_report(const RunRecord& record, const RunArguments& run) {
    if (run.report.empty()) {
        return;
    }
    const std::string text = report_text(record);
    if (run.report == "-") {
        print(text);
        return;
    }
    OutputFile file(run.report, run.overwrite);
    file.write(text);
    file.commit();
}

}  // namespace terratet::tools
