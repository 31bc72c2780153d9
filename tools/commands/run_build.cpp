// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/run_build.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "tess/error.hpp"
#include "tools/report/report.hpp"
#include "tools/run/process.hpp"
#include "tools/run/progress_display.hpp"

namespace terratet::tools {
namespace {

/// Without any input, files that are there and stand where outputs do are most likely meant as inputs.
void require_inputs(const BuildArguments& a) {
    if (!input_paths(a.site).empty()) {
        return;
    }
    std::vector<std::string> present;
    std::ranges::copy_if(a.outputs, std::back_inserter(present),
                         [](const std::string& path) { return std::filesystem::is_regular_file(path); });
    throw UsageError("no input: give --boreholes with --log, or --samples" +
                     (present.empty() ? "" : fmt::format("; {} would be written", fmt::join(present, ", "))));
}

}  // namespace

int run_build(const std::string& command, const BuildArguments& a, const std::vector<Given>& given) {
    const Stopwatch total;
    require_inputs(a);
    check_before_reading(a.site, a.model, a.run);
    check_outputs(a.outputs, input_paths(a.site), a.exporting, a.run);

    const ThreadLimit threads(a.run.threads);
    BuildRecord build;
    RunRecord record;
    std::optional<LiveModel> live;
    {
        ProgressDisplay display(progress_style(a.run.progress, a.run.quiet), stderr);
        live.emplace(read_and_build(a.site, a.model, a.run, display.callback(), build));
        if (a.exporting.uncertainty) {
            live->add_uncertainty();
        }
    }
    if (say_plan(*live->snapshot(), a.outputs, a.exporting)) {
        return exit_done;
    }
    {
        ProgressDisplay display(progress_style(a.run.progress, a.run.quiet), stderr);
        const Progress progress = display.callback();
        record.model = live->snapshot();
        if (!a.run.report.empty()) {
            static_cast<void>(record.model->is_delaunay());  // before the tessellation goes
        }
        record.model->release_memory();
        if (!a.run.report.empty()) {
            static_cast<void>(
                record.model->collapsed(Collapsing::all, progress));  // its blocks' volumes; may take long
        }
        const Stopwatch writing;
        record.written =
            write_outputs(*record.model, a.outputs, a.exporting, a.run, journal_entry(command, given), progress);
        record.write_seconds = writing.seconds();
        if (!a.run.report.empty()) {
            static_cast<void>(
                record.model->collapsed(Collapsing::all));  // for volumes; it may take as long as all else
        }
    }
    record.build = &build;
    record.total_seconds = total.seconds();
    write_report(record, a.run);
    spdlog::info("{}", summary_text(record));
    const std::uint64_t unmet = unmet_cells(build.report.refine);
    if (a.run.strict && unmet > 0) {
        spdlog::warn("terratet: {} cells do not meet the criteria, and --strict is given", unmet);
        return exit_unmet;
    }
    return exit_done;
}

}  // namespace terratet::tools
