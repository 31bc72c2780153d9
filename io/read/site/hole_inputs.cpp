// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/site/hole_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "io/base/parse_number.hpp"
#include "io/read/site/hole_layers.hpp"
#include "io/read/site/hole_names.hpp"
#include "io/read/site/input_files.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

/// A well file with where it was named.
struct Well {
    Source source;
    WellFile file;
    bool for_boreholes = false;
};

class Reader {
  public:
    Reader(const SiteInputs& inputs, Diagnostics& diagnostics) : inputs_(inputs), diagnostics_(diagnostics) {}

    HoleInputs read() {
        for (const Source& source : inputs_.boreholes) {
            for_each_file(source, [&](const Source& file, bool alone) { add_boreholes(file, alone); });
        }
        for (const Source& source : inputs_.surveys) {
            for_each_file(source,
                          [&](const Source& file, bool) { add_layers(file, LayerUse::survey, result_.surveys); });
        }
        for (const Source& source : inputs_.logs) {
            for_each_file(source, [&](const Source& file, bool alone) { add_logs(file, alone); });
        }
        join_wells();
        return std::move(result_);
    }

  private:
    template <typename Visit>
    void for_each_file(const Source& source, const Visit& visit) {
        const std::vector<Source> files = files_of(source);
        for (const Source& file : files) {
            visit(file, files.size() == 1 && file.path == source.path);
        }
    }

    Table read_noted(const Source& source) {
        Table table = read_table(source);
        std::ranges::for_each(table.notes, [&](const std::string& note) { diagnostics_.note(note); });
        return table;
    }

    void add_collars(const Source& source, Table table) {
        result_.collars.push_back(
            place(std::move(table), source, inputs_.source_crs, inputs_.columns, diagnostics_, place_options(inputs_)));
        names_.add(result_.collars.back().table, inputs_.columns);
    }

    void add_well(const Source& source, bool for_boreholes) {
        if (std::ranges::any_of(wells_, [&](const Well& well) { return well.source.path == source.path; })) {
            return;  // given for boreholes and again for logs
        }
        Well well{source, read_well_file(source), for_boreholes};
        for (const std::string& note : well.file.notes) {
            diagnostics_.note(source.describe() + ": " + note);
        }
        for (const auto& [line, reason] : well.file.rejected) {
            diagnostics_.reject(source.describe(), line, reason);
        }
        wells_.push_back(std::move(well));
    }

    /// \param alone  named itself, and not found in a folder, where other things may lie about
    void add_boreholes(const Source& source, bool alone) {
        if (is_well(source, alone)) {
            add_well(source, true);
            return;
        }
        if (!alone) {
            return;
        }
        const std::vector<HoleLayer> layers = hole_layers(source, inputs_.columns);
        if (layers.size() < 2) {
            add_collars(source, read_noted(source));
            return;
        }
        add_container(source, layers);
    }

    bool is_well(const Source& source, bool alone) {
        try {
            const bool well =
                source.layer.empty() && source.sql.empty() && well_format(source.path) != WellFormat::none;
            if (!well && !alone) {
                diagnostics_.note(source.path + ": is no well log that is known, and is passed over");
            }
            return well;
        } catch (const InputError& error) {
            if (alone) {
                throw;
            }
            diagnostics_.note(std::string(error.what()) + "; passed over");
            return false;
        }
    }

    static std::string list(const std::vector<HoleLayer>& layers) {
        std::string text;
        for (const HoleLayer& layer : layers) {
            text += (text.empty() ? "" : ", ") + layer.name + " (" + to_string(layer.use) + ")";
        }
        return text;
    }

    static Source with_layer(Source source, const std::string& layer) {
        source.layer = layer;
        return source;
    }

    void add_container(const Source& source, const std::vector<HoleLayer>& layers) {
        std::vector<std::string> collars = named(layers, LayerUse::collar);
        if (collars.size() > 1) {
            std::erase_if(collars, [&](const std::string& layer) { return repeats_ids(with_layer(source, layer)); });
        }
        if (collars.size() != 1) {
            throw InputError(fmt::format(
                "{}: {} of its layers can be the collars (a hole's id with a place); its layers: {}; name one with "
                "layer=",
                source.path, collars.empty() ? "none" : fmt::format("{}", fmt::join(collars, " as well as ")),
                list(layers)));
        }
        const std::vector<std::string> surveys =
            inputs_.surveys.empty() ? named(layers, LayerUse::survey) : std::vector<std::string>{};
        const bool logs_named =
            std::ranges::any_of(inputs_.logs, [&](const Source& log) { return log.path == source.path; });
        const std::vector<std::string> logs = logs_named ? std::vector<std::string>{} : named(layers, LayerUse::log);
        add_collars(with_layer(source, collars.front()), read_noted(with_layer(source, collars.front())));
        const auto add = [&](const std::vector<std::string>& from, std::vector<Table>& to, bool several) {
            for (const std::string& layer : from) {
                to.push_back(read_noted(with_layer(source, layer)));
                to.back().stated.one_of_several = several;
            }
        };
        add(surveys, result_.surveys, false);
        add(logs, result_.logs, true);
        const auto said = [](const std::vector<std::string>& names) {
            return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
        };
        diagnostics_.note(fmt::format("{}: collars from layer {}, surveys from {}, logs from {}; its layers: {}",
                                      source.path, collars.front(), said(surveys), said(logs), list(layers)));
    }

    static std::vector<std::string> named(const std::vector<HoleLayer>& layers, LayerUse use) {
        std::vector<std::string> names;
        for (const HoleLayer& layer : layers) {
            if (layer.use == use) {
                names.push_back(layer.name);
            }
        }
        return names;
    }

    /// A table of collars has each hole once.
    bool repeats_ids(const Source& source) {
        const Table table = read_table(source);
        const int id = find_optional_column(table, Meaning::id, inputs_.columns);
        std::set<std::string> seen;
        return id < 0 || !std::ranges::all_of(table.cells[static_cast<std::size_t>(id)],
                                              [&](std::string_view hole) { return seen.emplace(hole).second; });
    }

    /// All layers of a use, where a file has several layers and none is named.
    void add_layers(const Source& source, LayerUse use, std::vector<Table>& tables) {
        const std::vector<HoleLayer> layers = hole_layers(source, inputs_.columns);
        if (layers.size() < 2) {
            tables.push_back(read_noted(source));
            return;
        }
        const std::vector<std::string> chosen = named(layers, use);
        if (chosen.empty()) {
            throw InputError(fmt::format("{}: none of its layers is a {}; its layers: {}; name one with layer=",
                                         source.path, to_string(use), list(layers)));
        }
        for (const std::string& layer : chosen) {
            tables.push_back(read_noted(with_layer(source, layer)));
            tables.back().stated.one_of_several = use == LayerUse::log && chosen.size() > 1;
        }
        diagnostics_.note(fmt::format("{}: {} from layer {}; its layers: {}", source.path, to_string(use),
                                      fmt::join(chosen, ", "), list(layers)));
    }

    void add_logs(const Source& source, bool alone) {
        if (is_well(source, alone)) {
            add_well(source, false);
        } else if (alone) {
            add_layers(source, LayerUse::log, result_.logs);
        }
    }

    /// Puts well files' logs into the holes of the tables, or into their own.
    void join_wells() {
        for (Well& well : wells_) {
            WellFile& file = well.file;
            if (file.collars.rows() > 0) {
                add_own_collars(well);
            } else if (well.for_boreholes && result_.collars.empty() && file.format.starts_with("AGS")) {
                throw InputError(well.source.path +
                                 ": none of its holes has a place (no group LOCA or HOLE with coordinates); name a "
                                 "collar table with `boreholes`, and this file with `logs`");
            }
            for (auto* tables : {&file.surveys, &file.logs}) {
                for (Table& table : *tables) {
                    if (!table.stated.hole_names.empty()) {
                        table.stated.hole_names = {hole_of(well, table)};
                    }
                }
            }
            std::ranges::move(file.surveys, std::back_inserter(result_.surveys));
            std::ranges::move(file.logs, std::back_inserter(result_.logs));
        }
    }

    std::string hole_of(const Well& well, const Table& table) {
        std::string hole = names_.find(table.stated.hole_names, well.source.path, diagnostics_);
        if (hole.empty()) {
            throw InputError(
                fmt::format("{}: the hole of its log ({}) has no place in its header and is in no collar table; name "
                            "the table with "
                            "`boreholes`",
                            well.source.path, fmt::join(table.stated.hole_names, ", ")));
        }
        return hole;
    }

    /// The collars that no table has, under the name that the file gives them.
    void add_own_collars(Well& well) {
        Table& own = well.file.collars;
        const std::vector<std::string>* const aliases =
            !well.file.logs.empty() && !well.file.logs.front().stated.hole_names.empty() && own.rows() == 1
                ? &well.file.logs.front().stated.hole_names
                : nullptr;
        Table added = own;
        std::ranges::for_each(added.cells, [](auto& column) { column = {}; });
        added.lines.clear();
        for (std::size_t row = 0; row < own.rows(); ++row) {
            const std::string id(own.cells[0][row]);
            const bool known =
                !names_.find(aliases ? *aliases : std::vector{id}, well.source.path, diagnostics_).empty();
            if (known) {
                continue;
            }
            for (std::size_t column = 0; column < own.columns.size(); ++column) {
                added.cells[column].push_back(own.cells[column][row]);
            }
            added.lines.push_back(own.lines[row]);
        }
        if (added.rows() == 0 && well.file.paths.empty()) {
            return;
        }
        Source source = well.source;
        if (own.crs.geographic && !source.srs.empty() && !parse_crs(source.srs).geographic) {
            source.srs.clear();  // that is for files that say nothing; degrees are degrees
        }
        const Crs crs = resolved_crs(source, own.crs, inputs_.source_crs);
        for (HolePath& path : well.file.paths) {
            result_.paths.push_back(std::move(path));
            result_.path_crs.push_back(crs);
        }
        if (added.rows() == 0) {
            return;
        }
        if (well.file.metres_per_height > 0) {
            const double factor = well.file.metres_per_height / crs.metres_per_height;
            TextColumn heights;
            for (const std::string_view z : added.cells[3]) {
                heights.push_back(std::abs(factor - 1) > 1e-5 ? fmt::format("{}", *parse_number(z) * factor)
                                                              : std::string(z));
            }
            added.cells[3] = std::move(heights);
        }
        add_collars(source, std::move(added));
        if (aliases) {
            names_.add_aliases(*aliases, std::string(own.cells[0].front()));
        }
    }

    const SiteInputs& inputs_;
    Diagnostics& diagnostics_;
    HoleNames names_;
    std::vector<Well> wells_;
    HoleInputs result_;
};

}  // namespace

PlaceOptions place_options(const SiteInputs& inputs) {
    PlaceOptions options{inputs.z_positive, {}};
    std::ranges::transform(inputs.nulls, std::back_inserter(options.nulls), parse_null);
    return options;
}

HoleInputs read_hole_inputs(const SiteInputs& inputs, Diagnostics& diagnostics) {
    return Reader(inputs, diagnostics).read();
}

}  // namespace terratet
