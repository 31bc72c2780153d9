// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "interp/estimator_plan.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/printable.hpp"
#include "tools/options/text.hpp"
#include "tools/report/rejection_kinds.hpp"
#include "tools/report/report.hpp"

namespace terratet::tools {
namespace {

std::string counted(std::uint64_t number, const std::string& thing) {
    return grouped(number) + " " + thing + (number == 1 ? "" : "s");
}

std::string line(const char* what, const std::string& text) {
    return fmt::format("{:10}{}\n", what, wrapped(printable(with_options(text)), 10, 10, 100));
}

/// What of a clipped mesh is worse than it should be, and why.
std::string clipped_text(const ClippedShapes& shapes) {
    std::string text = fmt::format("cut at the extent: {}, dihedral angles from {:.1f}°, 1 % below {:.1f}°",
                                   counted(shapes.cells, "cell"), shapes.dihedral_min_deg, shapes.dihedral_p1_deg);
    if (shapes.below_10_deg + shapes.short_edges == 0) {
        return text;
    }
    text += fmt::format("; {} below 1°, {} below 10°, {} with an edge below --lmin/10:", grouped(shapes.below_1_deg),
                        grouped(shapes.below_10_deg), grouped(shapes.short_edges));
    const char* separator = " ";
    for (const auto& [count, where] : {std::pair{shapes.at_sample, "at samples"},
                                       {shapes.at_fault, "at faults, ground or walls"},
                                       {shapes.as_tessellated, "as in the model"},
                                       {shapes.other, "elsewhere"}}) {
        if (count > 0) {
            text += fmt::format("{}{} {}", separator, grouped(count), where);
            separator = ", ";
        }
    }
    return text;
}

std::string input_lines(const BuildRecord& build) {
    std::string out =
        line("Read", fmt::format("{}, {}, {}", counted(build.counts.boreholes, "borehole"),
                                 counted(build.counts.samples, "sample"), counted(build.counts.faults, "fault")));
    constexpr std::size_t shown = 5;
    const auto& rejected = build.diagnostics.rejected;
    const std::vector<RejectionKind> kinds = rejection_kinds(rejected);
    if (!rejected.empty()) {
        out +=
            line("Rejected", fmt::format("{} for {}{}", counted(rejected.size(), "record"),
                                         counted(kinds.size(), "reason"), kinds.size() > shown ? ", the first:" : ":"));
    }
    for (std::size_t i = 0; i < std::min(shown, kinds.size()); ++i) {
        const auto& [record, count] = kinds[i];
        const std::string text = record.line > 0 ? fmt::format("{}:{}: {}", record.file, record.line, record.reason)
                                                 : fmt::format("{}: {}", record.file, record.reason);
        out += line("", text + (count > 1 ? fmt::format("; and {} more likewise", grouped(count - 1)) : ""));
    }
    for (const auto& note : build.diagnostics.notes) {
        out += line("Note", note);
    }
    return out;
}

std::string volume_text(double volume, const std::string& unit) {
    return volume >= 1e6 ? fmt::format("{:.3g} M {}³", volume / 1e6, unit) : fmt::format("{:.3g} {}³", volume, unit);
}

/// A block that no sample can be seen from.
std::string empty_block_text(const EmptyBlock& block, const std::string& unit) {
    std::string properties;
    for (const auto& name : block.properties) {
        properties += (properties.empty() ? "" : ", ") + name;
    }
    const bool named = block.name != fmt::format("region {}", block.region);
    return fmt::format("Block {}{} ({}) holds no sample{}: no values there", block.region,
                       named ? ", " + block.name : "", volume_text(block.volume, unit),
                       block.of_all ? "" : " of " + properties);
}

/// "Fidelity  K: R2 0.97, rms 0.1 of sd 0.6, largest 0.4 decades at 1,292 samples; 3 beyond the tolerance 0.2: …"; of
/// classes "lith: the class of 1,290 of 1,292 samples is met".
std::string fidelity_text(const Property& property, const Fidelity& fit) {
    if (property.kind == Kind::categorical) {  // each error is 0 or 1
        const auto missed = static_cast<std::size_t>(std::llround(fit.rms * fit.rms * static_cast<double>(fit.count)));
        return fmt::format("{}: the class of {} of {} is met", property.name, grouped(fit.count - missed),
                           counted(fit.count, "sample"));
    }
    std::string text =
        fmt::format("{}: R2 {:.3g}, rms {:.3g} of sd {:.3g}, largest {:.3g}{} at {}", property.name, fit.r2, fit.rms,
                    fit.sd, fit.max, property.scale == Scale::log10 ? " decades" : "", counted(fit.count, "sample"));
    if (fit.tolerance > 0) {
        text += fmt::format("; {} beyond the tolerance {:.3g}", grouped(fit.beyond_tolerance), fit.tolerance);
        const char* separator = ": ";
        for (const auto& [reason, count] : fit.reasons) {
            text += fmt::format("{}{} {}", separator, grouped(count), to_string(reason));
            separator = ", ";
        }
    }
    return text;
}

/// "natural, ranges 1 : 1 : 0.1, the third across a plane that dips 30° to 115°".
std::string anisotropy_text(const EstimatorSpec& spec) {
    const Anisotropy a = anisotropy_of(spec);
    if (a.isotropic()) {
        return spec.name + ", distances alike in all directions";
    }
    const double azimuth = a.azimuth_deg < 0 ? a.azimuth_deg + 360 : a.azimuth_deg;
    const std::string plane =
        a.roll_deg != 0  ? fmt::format("azimuth {:.3g}°, dip {:.3g}°, roll {:.3g}°", azimuth, a.dip_deg, a.roll_deg)
        : a.dip_deg == 0 ? "the level plane"
                         : fmt::format("a plane that dips {:.3g}° to {:.3g}°", a.dip_deg, azimuth);
    return spec.name + (spec.options.contains("smooth") ? ":smooth" : "") +
           (a.ratio2 == 1 ? fmt::format(", across {} at {:.2g} of the range along it", plane, a.ratio3)
                          : fmt::format(", ranges 1 : {:.2g} : {:.2g}, {}", a.ratio2, a.ratio3, plane));
}

/// How it was chosen.
std::string choice_text(const EstimatorSpec& spec, const EstimatorChoice& choice) {
    const std::string what = anisotropy_text(spec);
    if (choice.folds == 0) {
        return what + " (too few samples or boreholes to choose)";
    }
    if (choice.rms == 0 && choice.better_folds == 0) {
        return what + ": no other is better at left-out boreholes";
    }
    if (choice.better_folds == 0) {
        return what + fmt::format(": nothing tried is clearly better at left-out boreholes (rms {:.3g})", choice.rms);
    }
    return what + fmt::format(": rms {:.3g} at left-out boreholes instead of {:.3g}, better in {} of {} groups",
                              choice.rms, choice.rms_plain, choice.better_folds, choice.folds);
}

std::string build_lines(const BuildRecord& build, const Model& model) {
    const BuildReport& report = build.report;
    const char* unit = model.frame.unit == "metre" ? "m" : model.frame.unit.c_str();
    std::string out;
    if (!build.defaults.empty()) {
        std::string chosen;
        for (const auto& [option, value] : build.defaults) {
            chosen += fmt::format("{}--{} {}", chosen.empty() ? "" : "  ", option, value);
        }
        out += line("Defaults", chosen);
    }
    out += line("Kept", fmt::format("{} of {}: {} too near another, {} near faults, {} outside, {} coincident",
                                    grouped(report.density.kept.size()), counted(build.counts.samples, "sample"),
                                    grouped(report.density.deleted), grouped(report.density.near_faults.size()),
                                    grouped(report.outside_extent), grouped(report.coincident)));
    for (const auto& fault : report.barriers) {
        out += line("Fault", fault.used ? fmt::format("{}: {}{}", fault.name, counted(fault.seeds, "seed"),
                                                      fault.reason.empty() ? "" : "; " + fault.reason)
                                        : fmt::format("{}: not used: {}", fault.name, fault.reason));
    }
    out += line("Initial",
                fmt::format("{} vertices, {} tetrahedra; {:.1f} % skinny, {:.1f} % flat, {:.1f} % bad",
                            grouped(report.initial.vertices), grouped(report.initial.tetrahedra),
                            report.initial.skinny_percent, report.initial.flat_percent, report.initial.bad_percent));
    std::string left;
    for (const auto& [reason, cells] : report.refine.skipped) {
        left += fmt::format("{}{} {}", left.empty() ? "; left as they are: " : ", ", grouped(cells), to_string(reason));
    }
    out += line("Refined", fmt::format("{} vertices inserted (at most {:.3g} can be), {} moved, {} removed{}",
                                       grouped(report.refine.inserted), report.refine.bound,
                                       grouped(report.refine.moved), grouped(report.refine.removed), left));
    const CellStatistics& cells = report.final;
    out +=
        line("Final", fmt::format("{} vertices, {} tetrahedra; {:.1f} % skinny, {:.1f} % flat, {:.1f} % bad; dihedral "
                                  "angles from {:.1f}° (1 %: {:.1f}°); edges {:.4g} to {:.4g} {}; {}; {} across faults",
                                  grouped(cells.vertices), grouped(cells.tetrahedra), cells.skinny_percent,
                                  cells.flat_percent, cells.bad_percent, cells.dihedral_min_deg, cells.dihedral_p1_deg,
                                  cells.edge_min, cells.edge_max, unit, counted(cells.regions, "region"),
                                  counted(report.fault_crossing_edges, "edge")));
    for (const EmptyBlock& block : report.empty_blocks) {
        out += line("Note", empty_block_text(block, unit));
    }
    const EstimatorPlan plan = parse_estimator_plan(model.estimator);
    for (const auto& [property, choice] : plan.choices) {
        out += line("Estimator", property + ": " + choice_text(plan.of(property), choice));
    }
    for (std::size_t p = 0; p < report.fidelity.size(); ++p) {
        const auto& property = model.properties[p];
        const auto& fit = report.fidelity[p];
        out += line("Fidelity", fidelity_text(property, fit));
    }
    return out;
}

}  // namespace

std::string summary_text(const RunRecord& record) {
    std::string out;
    if (record.build != nullptr) {
        out += input_lines(*record.build);
    }
    const Frame& frame = record.model->model().frame;
    out += line("Frame", fmt::format("{}, unit {}", frame.crs_name.empty() ? "local" : frame.crs_name, frame.unit));
    if (record.build != nullptr) {
        out += build_lines(*record.build, record.model->model());
    }
    if (record.written.collapse) {
        const CollapseReport& collapse = *record.written.collapse;
        const std::size_t left = collapse.apart.size() + collapse.aside.size();
        out += line(
            "Collapsed",
            fmt::format("{}; {} on the faults are split; each of {} has its twin{}{}",
                        counted(collapse.dropped_cells, "gap cell"), counted(collapse.split_places, "place"),
                        counted(collapse.conformity.mirrored_facets, "facet"),
                        left == 0 ? "" : fmt::format("; {} left open, see the report", counted(left, "place")),
                        collapse.conformity.leaking == 0 ? ""
                                                         : fmt::format("; {} between regions not split",
                                                                       counted(collapse.conformity.leaking, "facet"))));
    }
    for (const auto& output : record.written.outputs) {
        out += line("Wrote", fmt::format("{} ({})", output.path, byte_size(output.bytes)));
        if (output.clipped) {
            out += line("", clipped_text(*output.clipped));
        }
        if (!output.remark.empty()) {
            out += line("", output.remark);
        }
    }
    return out + fmt::format("{:10}{:.2f} s", "Time", record.total_seconds);
}

}  // namespace terratet::tools
