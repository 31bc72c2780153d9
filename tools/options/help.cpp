// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/help.hpp"

#include <array>

#include <fmt/format.h>

#include "interp/estimator/estimator_catalogue.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tools/options/text.hpp"

namespace terratet::tools {
namespace {

struct Topic {
    const char* name;
    const char* summary;
    const char* text;
};

constexpr const char* estimators_topic = "estimators";

constexpr std::array topics{
    Topic{"formats", "what is read and written",
          R"(Read
  tables      CSV, XLSX, GeoPackage, Shapefile, PostGIS …: anything GDAL opens.
              Columns are found by the usual names (HOLEID, EAST, FROM, …) or
              named with --columns. /vsizip/, /vsicurl/, /vsistdin/ work.
  faults      GOCAD TSurf (.ts); TIN, PolyhedralSurface or MultiPolygon Z
              layers; tables of points x, y, z, fault
  One input may carry its layer and CRS: 'wells.gpkg,layer=collar,srs=EPSG:3067'

Write
  .gpkg       the model: a GeoPackage that QGIS opens (build -o; also convert)
  .vtu        ParaView and other VTK readers: tetrahedra, true coordinates
  .glb .gltf  3D scenes for the web and for Blender: local coordinates, Y up
  .vdb        OpenVDB voxels, one grid a property: Houdini, Blender
  .csv        vertices with their values
docs/outputs.md says what each file contains.
)"},
    Topic{"exit-codes", "what a script can rely on",
          R"(0   done
1   failed while running: a disk full, a bound exceeded, interrupted; for
    check, a guarantee that does not hold
2   usage: an unknown option, options that contradict each other
3   the input data cannot be used
4   done, but criteria stay unmet and --strict was given

An error is one line on standard error that begins with 'terratet: '. Outputs
appear whole or not at all.
)"},
    Topic{"report", "the keys of --report FILE.json",
          R"(terratet        version
input           boreholes, samples, faults; rejected: [{file, line, reason}];
                notes
frame           crs, unit, origin [x, y, z], z_scale
defaults        what was chosen because it was not given
preprocess      samples_kept, samples_deleted, samples_near_faults, seeds,
                domain_vertices, coincident, outside_extent
faults          per input surface: name, used, reason, seeds, areas
initial         vertices, tetrahedra, skinny_percent, flat_percent, bad_percent
refine          inserted, moved, removed, bound, skipped {reason: cells}
final           vertices, tetrahedra, gap_tetrahedra, skinny_percent,
                flat_percent, bad_percent, dihedral_deg {min, p1, p5, median},
                edge_m {min, max}, fault_crossing_edges, delaunay, regions,
                below {dihedral, dihedral_given, vmin}
fidelity        per property: rms, max, count, against all samples
estimator       name, options, fitted, fallbacks
outputs         [{path, bytes}]
seconds         read, density, boundary, refine, estimate, write, total
peak_memory_bytes

skinny: R/l above --radius-edge; flat: not skinny and R/r above --aspect; bad:
breaks any criterion. Percentages are of the cells inside the extent, gaps left
out. docs/report.md explains each key.
)"},
};

/// From the table that parses them.
std::string estimators_help() {
    std::string out =
        "Values at new vertices, voxels and queries come from the samples as measured,\n"
        "dropped ones included, and never from across a fault.\n"
        "--estimator NAME[:option=value]…\n";
    for (const auto& method : estimator_catalogue()) {
        const bool first = method.name == estimator_catalogue().front().name;
        out += fmt::format("\n{:10}{}\n", method.name, wrapped(method.help + (first ? ". The default" : ""), 10, 10));
        for (const auto& option : method.options) {
            std::string text = option.help;
            if (!option.unit.empty()) {
                text += fmt::format(" [{}]", option.unit);
            }
            if (!option.default_value.empty()) {
                text += ". Default " + option.default_value;
            }
            out += fmt::format("  {:14}{}\n", option.name, wrapped(text, 16, 16));
        }
    }
    return out + R"(
Lengths are in the model's unit. A property named with :log10 is estimated as
its decimal logarithm, and deviations and variances are in decades; one with
:categorical gets the likeliest class. 'extrapolation' rises from 0 to 1 beyond
the samples' reach. Where faults hide every sample there is no value. Which one
suits the data: terratet validate. docs/estimators.md says more.
)";
}

std::string option_lines(const Option& option) {
    constexpr std::size_t column = 26;
    std::string names;
    for (const auto& name : option.names) {
        names += (names.empty() ? "" : ", ") + dashed(name);
    }
    std::string line = "  " + names + (option.value.empty() ? "" : " " + option.value);
    if (line.size() + 2 > column) {
        line += "\n" + std::string(column, ' ');
    } else {
        line.resize(column, ' ');
    }
    return line + wrapped(help_text(option), column, column) + "\n";
}

}  // namespace

std::string command_help(const CommandEntry& entry) {
    const auto command = entry.make();
    std::string out =
        fmt::format("Usage: terratet {} {}\n\n{}\n", entry.name, entry.usage, wrapped(entry.description, 0, 0));
    for (const auto& group : command->syntax().groups) {
        out += fmt::format("\n{}\n", wrapped(group.title + ":", 0, 0));
        for (const auto& option : group.options) {
            out += option_lines(option);
        }
    }
    out += "\nExamples:\n";
    for (const auto& example : entry.examples) {
        out += fmt::format("  {}\n", example);
    }
    return out;
}

std::string general_help() {
    std::string out =
        "Usage: terratet COMMAND …\n\n"
        "From borehole logs and faults to an adaptive Delaunay tessellation of the\nground.\n\nCommands:\n";
    for (const auto& entry : commands()) {
        out += fmt::format("  {:12}{}\n", entry.name, entry.summary);
    }
    out += "  help        on a command, or a topic:\n";
    out += fmt::format("    {:12}{}\n", estimators_topic, "how values reach new vertices, with every option");
    for (const auto& topic : topics) {
        out += fmt::format("    {:12}{}\n", topic.name, topic.summary);
    }
    return out +
           "\nOptions:\n  --version     print the version\n  --help        after a command: its options and examples\n"
           "  --json-usage  all commands and options as JSON\n"
           "\nOne dash will do, as in GDAL: -t_srs is --t_srs.\n";
}

std::string short_usage() {
    std::string names;
    for (const auto& entry : commands()) {
        names += (names.empty() ? "" : ", ") + entry.name;
    }
    return "Usage: terratet COMMAND …\n\nCommands: " + wrapped(names, 10, 10) +
           "\n\nFor example:\n  terratet convert --boreholes collar.csv --log log.csv -s_srs EPSG:3067 model.vtu\n"
           "\n'terratet help' says what they do, 'terratet COMMAND --help' how.\n";
}

std::vector<std::string> help_subjects() {
    std::vector<std::string> subjects{estimators_topic};
    for (const auto& topic : topics) {
        subjects.emplace_back(topic.name);
    }
    for (const auto& entry : commands()) {
        subjects.push_back(entry.name);
    }
    return subjects;
}

std::string help_on(const std::string& subject) {
    if (subject == estimators_topic) {
        return estimators_help();
    }
    for (const auto& topic : topics) {
        if (subject == topic.name) {
            return topic.text;
        }
    }
    for (const auto& entry : commands()) {
        if (subject == entry.name) {
            return command_help(entry);
        }
    }
    throw UsageError(fmt::format("there is no help on '{}'; there is on {}{}", subject, listed(help_subjects()),
                                 did_you_mean(subject, help_subjects())));
}

}  // namespace terratet::tools
