// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// A model over time for ParaView: NAME.pvd names a VTU for each step, which lie in a folder NAME beside it.

#include <charconv>
#include <chrono>

#include "io/base/csv_text.hpp"
#include "io/base/output_file.hpp"
#include "io/base/parse_number.hpp"
#include "io/base/time_steps.hpp"
#include "io/export.hpp"
#include "io/style/markup.hpp"
#include "io/write/companions.hpp"

namespace terratet {
namespace {

/// ParaView's clock: numbers as they are, dates in days, other steps by their number.
double clock_of(const std::string& label, std::size_t step) {
    if (const auto number = parse_number(label)) {
        return *number;
    }
    return days_since_1970(label).value_or(static_cast<double>(step));
}

}  // namespace

OutputRecord write_pvd(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    Companions companions(path);
    std::vector<std::string> steps = time_steps(view.model.properties);
    if (steps.empty()) {
        steps.emplace_back();  // what does not change has one
    }
    OutputRecord record{path, 0, {}};
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n";
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Model at_step = model_at(view.model, steps[i]);
        const std::string part = companions.path_of("step_" + std::to_string(i), ".vtu");
        const OutputRecord of_step = write_vtu({at_step, view.mesh, view.cells, nullptr}, part, options);
        record.bytes += of_step.bytes;
        record.clipped = of_step.clipped;
        std::string clock;
        append_csv_number(clock, clock_of(steps[i], i));
        const auto name = companions.folder().filename() / std::filesystem::path(part).filename();
        text += "<DataSet timestep=\"" + clock + "\" name=\"" + markup_text(steps[i]) + "\" file=\"" +
                markup_text(name.string()) + "\"/>\n";
    }
    file.write(text + "</Collection>\n</VTKFile>\n");
    record.bytes += file.commit();
    return record;
}

}  // namespace terratet
