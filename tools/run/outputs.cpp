// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/outputs.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "interp/ranks/ranks.hpp"
#include "io/base/output_file.hpp"
#include "io/base/scratch_folder.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"
#include "tools/options/text.hpp"
#include "tools/run/process.hpp"
#include "tools/version.hpp"

namespace terratet::tools {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    return a == b || fs::equivalent(a, b, error) ||
           fs::weakly_canonical(fs::absolute(a), error) ==
               fs::weakly_canonical(fs::absolute(b), error);  // neither need exist
}

/// Calls `write`, and says of what goes wrong in a library which output it was for.
template <class Write>
void write_named(const std::string& path, const Write& write) {
    try {
        write();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format("cannot write {}: {}", path, out_of_memory));
    } catch (const std::exception& error) {
        throw Error(
            fmt::format("cannot write {}: a library failed ({}); please report it, with the command and its "
                        "inputs",
                        path, error.what()));
    }
}

/// Rethrows the current exception with the outputs that stand already.
[[noreturn]] void rethrow_naming(const std::vector<OutputRecord>& written) {
    if (written.empty()) {
        throw;
    }
    std::string names;
    for (const auto& record : written) {
        names += (names.empty() ? "" : ", ") + record.path;
    }
    try {
        throw;
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}; written before it: {}", error.what(), names));
    } catch (const Cancelled&) {
        throw Error(fmt::format("interrupted; written before it: {}", names));
    } catch (const Error& error) {
        throw Error(fmt::format("{}; written before it: {}", error.what(), names));
    }
}

std::time_t now() {
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch != nullptr) {
        const std::string text = epoch;
        std::time_t seconds = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
        if (error != std::errc() || end != text.data() + text.size() || text.empty()) {
            throw UsageError(fmt::format("SOURCE_DATE_EPOCH: '{}' is not a number of seconds", text));
        }
        return seconds;
    }
    return std::time(nullptr);
}

constexpr const char* standard_output = "-";

/// By way of a file, so that nothing goes out unless all of it is there.
OutputRecord export_to_standard_output(const ModelSnapshot& model, const ExportOptions& options) {
    const ScratchFolder scratch;
    std::string extension = options.format;
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    OutputRecord record = export_model(model, (scratch.path() / ("output." + extension)).string(), options);
    std::ifstream file(record.path, std::ios::binary);
    std::vector<char> block(1 << 20);
    while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0) {
        write_to_standard_output({block.data(), static_cast<std::size_t>(file.gcount())});
    }
    record.path = standard_output;
    return record;
}

/// Version and command for whoever opens an output: from what is in the model, so that equal models give equal bytes.
std::string made_by(const Model& model) {
    std::string text = fmt::format("Terratet {}: terratet build --lmin {:.6g} --lmax {:.6g}", version,
                                   model.criteria.l_min, model.criteria.l_max);
    constexpr std::size_t most = 3;  // a line, not a page
    for (const Property& property : std::span(model.properties).first(std::min(most, model.properties.size()))) {
        text += fmt::format(" --property {}{}{}", property.name, property.scale == Scale::log10 ? ":log10" : "",
                            property.kind == Kind::categorical ? ":categorical" : "");
    }
    const std::string method = model.estimator.substr(0, model.estimator.find_first_of(":\n "));
    return method.empty() ? text : fmt::format("{} --estimator {}", text, method);
}

const std::string& format_of(const OutputRequest& output, const ExportArguments& arguments) {
    return output.format.empty() ? arguments.writers.format : output.format;
}

/// Standard output is written on its own.
bool is_voxels(const OutputRequest& output, const ExportArguments& arguments) {
    return output.path != standard_output && is_voxel_format(output_format(output.path, format_of(output, arguments)));
}

/// What makes a folder full of files may make the folder that they are in too.
void make_tileset_folder(const std::string& path, const std::string& format) {
    const bool tiles = format == "VOXELTILES" || format == "TILES";
    if (tiles && path == standard_output) {
        throw UsageError("-: a tileset is a folder of files, which standard output cannot take");
    }
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (tiles && !folder.empty() && !fs::exists(folder, ignored)) {
        fs::create_directory(folder, ignored);  // require_writable says what went wrong
    }
}

/// Two formats may put further files into one folder, NAME of NAME.ext, where their names differ; tilesets want theirs
/// for themselves, and PFLOTRAN's two grids name their lists alike.
void require_folders_of_their_own(const std::vector<std::pair<std::string, std::string>>& path_and_format) {
    static const std::set<std::string> tiles{"TILES", "VOXELTILES"};
    static const std::set<std::string> lists{"UGE", "UGI"};
    static const std::set<std::string> others{"OGS", "PVD", "VTM"};
    for (std::size_t i = 0; i < path_and_format.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const auto& [one, kind] = path_and_format[i];
            const auto& [other, other_kind] = path_and_format[j];
            const auto has_folder = [](const std::string& format) {
                return tiles.contains(format) || lists.contains(format) || others.contains(format);
            };
            const bool clash = (tiles.contains(kind) && has_folder(other_kind)) ||
                               (tiles.contains(other_kind) && has_folder(kind)) ||
                               (lists.contains(kind) && lists.contains(other_kind));
            if (clash && fs::path(one).replace_extension() == fs::path(other).replace_extension()) {
                throw UsageError(
                    fmt::format("{} and {}: both put files into the folder {}; give one of them another name", other,
                                one, fs::path(one).replace_extension().string()));
            }
        }
    }
}

}  // namespace

bool any_voxels(const std::vector<std::string>& outputs, const ExportArguments& arguments) {
    return std::ranges::any_of(outputs, [&](const std::string& text) {
        return !names_model(text) && is_voxels(parse_output(text, arguments), arguments);
    });
}

bool names_model(const std::string& path) {
    return path.ends_with(".gpkg") || path.starts_with("PG:");
}

void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                   const ExportArguments& arguments, const RunArguments& run) {
    std::vector<std::string> paths;
    std::vector<std::pair<std::string, std::string>> formats;
    for (const auto& text : outputs) {
        if (names_model(text)) {
            paths.push_back(text);
        } else {
            const OutputRequest output = parse_output(text, arguments);
            paths.push_back(output.path);
            formats.emplace_back(output.path, output_format(output.path, format_of(output, arguments)));
        }
    }
    require_folders_of_their_own(formats);
    for (const auto& [path, format] : formats) {
        make_tileset_folder(path, format);
    }
    if (run.report == standard_output && std::ranges::find(paths, standard_output) != paths.end()) {
        throw UsageError("-: standard output cannot take an output and the report");
    }
    RunArguments of_places = run;
    of_places.overwrite |= arguments.dry_run;  // nothing will be replaced
    check_places(paths, inputs, of_places);
}

void check_places(std::vector<std::string> paths, const std::vector<std::string>& inputs, const RunArguments& run) {
    if (!run.report.empty() && run.report != standard_output) {
        paths.push_back(run.report);
    }
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const auto& path = paths[i];
        for (std::size_t j = 0; j < i; ++j) {
            if (path == paths[j] || same_file(path, paths[j])) {
                throw UsageError(fmt::format("{}: given twice as an output", path));
            }
        }
        if (path == standard_output) {
            continue;
        }
        const auto is_input = [&](const std::string& input) { return same_file(path, parse_source(input).path); };
        if (std::any_of(inputs.begin(), inputs.end(), is_input) ||
            (!run.config.empty() && same_file(path, run.config))) {
            throw UsageError(fmt::format("{}: is an input; an output cannot replace it", path));
        }
        if (!path.starts_with("PG:")) {
            require_writable(path, run.overwrite);
        }
    }
}

std::vector<std::string> plan_lines(const ModelSnapshot& model, const std::vector<std::string>& texts,
                                    const ExportArguments& arguments) {
    std::vector<OutputRequest> outputs;
    for (const auto& text : texts) {
        if (!names_model(text)) {
            outputs.push_back(parse_output(text, arguments));
        }
    }
    std::vector<std::string> lines;
    const ExportOptions options = writer_options(arguments, model.model());
    const ModelView view{model.model(), model.mesh(), model.cells()};
    for (const VoxelPlan& plan : plan_voxels(view, outputs, options)) {
        const auto [nx, ny, nz] = plan.voxels;
        lines.push_back(fmt::format("{}: {} × {} × {} voxels of {} × {} × {}, {} in all, at most {}", plan.path, nx, ny,
                                    nz, short_number(plan.voxel_size.x), short_number(plan.voxel_size.y),
                                    short_number(plan.voxel_size.z), grouped(static_cast<std::uint64_t>(nx * ny * nz)),
                                    byte_size(plan.bytes)));
    }
    return lines;
}

bool say_plan(const ModelSnapshot& model, const std::vector<std::string>& texts, const ExportArguments& arguments) {
    for (const std::string& line : plan_lines(model, texts, arguments)) {
        if (arguments.dry_run) {
            write_to_standard_output(line + "\n");
        } else {
            spdlog::info("{:10}{}", "Voxels", line);
        }
    }
    return arguments.dry_run;
}

Written write_outputs(const ModelSnapshot& model, const std::vector<std::string>& texts,
                      const ExportArguments& arguments, const RunArguments& run, const JournalEntry& entry,
                      const Progress& progress) {
    ExportOptions options = writer_options(arguments, model.model());
    options.overwrite = run.overwrite;
    options.progress = progress;
    options.ranks = run.ranks;
    options.made_by = made_by(model.model());
    Written written;
    std::vector<OutputRequest> voxels;  // share one pass, when the first of them is due
    for (const auto& text : texts) {
        if (!names_model(text) && is_voxels(parse_output(text, arguments), arguments)) {
            voxels.push_back(parse_output(text, arguments));
        }
    }
    if (run.ranks != nullptr && !run.ranks->is_root()) {
        if (!voxels.empty()) {
            export_model(model, voxels, options);
        }
        return written;
    }
    bool voxels_written = false;
    const auto write_output = [&](const std::string& text) {
        if (names_model(text)) {
            save_model(text, model.model(), entry,
                       {.overwrite = run.overwrite, .spatial_index = arguments.spatial_index});
            std::error_code no_file;
            const auto bytes = fs::file_size(text, no_file);
            written.outputs.push_back({text, no_file ? 0 : bytes});
            return;
        }
        const OutputRequest output = parse_output(text, arguments);
        ExportOptions of_output = options;
        of_output.format = format_of(output, arguments);
        if (output.path == standard_output) {
            written.outputs.push_back(export_to_standard_output(model, of_output));
        } else if (!is_voxels(output, arguments)) {
            written.outputs.push_back(export_model(model, output.path, of_output));
        } else if (!std::exchange(voxels_written, true)) {
            auto records = export_model(model, voxels, options);
            std::ranges::move(records, std::back_inserter(written.outputs));
        }
        const auto which = collapsing(model.model(), output_format(output.path, of_output.format), options);
        if (which && (which == Collapsing::all || !written.collapse)) {
            written.collapse = model.collapsed(*which).report;
        }
    };
    for (const auto& text : texts) {
        try {
            report_progress(progress, "write",
                            static_cast<double>(written.outputs.size()) / static_cast<double>(texts.size()));
            write_named(text, [&] { write_output(text); });
        } catch (...) {
            rethrow_naming(written.outputs);
        }
    }
    std::ranges::sort(written.outputs, {}, [&](const OutputRecord& record) {
        return std::ranges::find_if(texts, [&](const std::string& text) {
            return record.path == (names_model(text) ? text : parse_output(text).path);
        });
    });
    return written;
}

JournalEntry journal_entry(const std::string& command, const std::vector<Given>& given) {
    nlohmann::ordered_json arguments = nlohmann::ordered_json::object();
    for (const auto& option : given) {
        if (option.group != run_group) {
            arguments[option.name] = option.values;
        }
    }
    return {0, fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now())), command,
            arguments.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
}

}  // namespace terratet::tools
