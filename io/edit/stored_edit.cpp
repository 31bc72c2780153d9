// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows keep their numbers as long as what they hold stays: an edit writes the rows that differ, and no others. The
// order of rows is not that of the model's lists any more; terratet_meta's row_order says what it is.
#include <algorithm>
#include <bit>
#include <map>

#include "io/edit/stored_rows.hpp"
#include "io/base/current_time.hpp"
#include "io/model/model_guard.hpp"
#include "io/model/model_rows.hpp"
#include "io/model/row_order.hpp"
#include "io/model_store.hpp"
#include "io/source.hpp"
#include "tess/edit/matched_rows.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::int64_t no_row = -1;  ///< yet

bool same_number(double a, double b) {
    return std::bit_cast<std::uint64_t>(a + 0.0) == std::bit_cast<std::uint64_t>(b + 0.0);
}

bool same_column_values(const std::vector<std::vector<double>>& a, std::size_t i,
                        const std::vector<std::vector<double>>& b, std::size_t j) {
    for (std::size_t p = 0; p < std::min(a.size(), b.size()); ++p) {
        if (!same_number(a[p][i], b[p][j])) {
            return false;
        }
    }
    return a.size() == b.size();
}

/// The numbers that rows of the next state have, as far as their elements were there before; the others get new ones.
/// Equal elements of the two lists are found by `same(i, j)`, O(n m) for the few of them.
template <typename Same>
std::vector<std::int64_t> carried(std::size_t before, std::size_t after, const std::vector<std::int64_t>& numbers,
                                  const Same& same) {
    std::vector<std::int64_t> result(after, no_row);
    std::vector<bool> used(before);
    for (std::size_t j = 0; j < after; ++j) {
        for (std::size_t i = 0; i < before && result[j] == no_row; ++i) {
            if (!used[i] && same(i, j)) {
                used[i] = true;
                result[j] = numbers[i];
            }
        }
    }
    return result;
}

/// Writes the difference of two states.
class EditWriter {
  public:
    EditWriter(SqliteDatabase& database, std::int64_t edit, const Model& before, const RowNumbers& old,
               const Model& after)
        : database_(database), log_(database, edit), before_(before), old_(old), after_(after) {}

    RowNumbers write() {
        StoredTable boreholes(database_, schema::boreholes);
        StoredTable samples(database_, schema::samples);
        StoredTable surfaces(database_, schema::surfaces);
        StoredTable vertices(database_, schema::vertices);
        const auto new_boreholes = number_boreholes(boreholes);
        const auto new_samples = number_samples(samples);
        const auto new_surfaces = number_surfaces(surfaces);
        const auto new_vertices = number_vertices(vertices);
        const ModelRows rows(after_, numbers_);

        remove_missing(boreholes, old_.boreholes, numbers_.boreholes);
        remove_missing(samples, old_.samples, numbers_.samples);
        remove_missing(surfaces, old_.surfaces, numbers_.surfaces);
        remove_missing(surfaces, old_.sheets, numbers_.sheets, true);
        remove_missing(vertices, old_.vertices, numbers_.vertices);
        write_some(
            boreholes, new_boreholes, numbers_.boreholes, [](RowWriter& to) { return schema::BoreholeColumns(to); },
            [&](RowWriter& to, const auto& columns, std::size_t i) { rows.borehole(to, columns, i); });
        write_some(
            samples, new_samples, numbers_.samples, [&](RowWriter& to) { return rows.sample_columns(to); },
            [&](RowWriter& to, const auto& columns, std::size_t i) { rows.sample(to, columns, i); });
        write_some(
            surfaces, new_surfaces, numbers_.surfaces, [](RowWriter& to) { return schema::SurfaceColumns(to); },
            [&](RowWriter& to, const auto& columns, std::size_t i) { rows.surface(to, columns, i); });
        write_barriers(surfaces, rows);
        write_some(
            vertices, new_vertices, numbers_.vertices, [&](RowWriter& to) { return rows.vertex_columns(to); },
            [&](RowWriter& to, const auto& columns, std::size_t i) { rows.vertex(to, columns, i); });
        write_meta(rows.meta());
        return std::move(numbers_);
    }

  private:
    using Which = std::vector<std::size_t>;

    /// Gives numbers to those without; they and the ones that `differs` says are returned.
    template <typename Differs>
    Which numbered(StoredTable& table, std::vector<std::int64_t>& numbers, const Differs& differs,
                   std::int64_t step = 1) {
        Which to_write;
        std::int64_t last = std::max(table.last_row(), last_given_[table.name()]);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] == no_row) {
                numbers[i] = last + 1;
                last += step;
                to_write.push_back(i);
            } else if (differs(i)) {
                to_write.push_back(i);
            }
        }
        last_given_[table.name()] = last;
        return to_write;
    }

    Which number_boreholes(StoredTable& table) {
        std::map<std::string, std::size_t> at;
        for (std::size_t i = 0; i < before_.boreholes.size(); ++i) {
            at[before_.boreholes[i].id] = i;
        }
        std::vector<std::size_t> from;
        for (const Borehole& borehole : after_.boreholes) {
            const auto found = at.find(borehole.id);
            from.push_back(found == at.end() ? before_.boreholes.size() : found->second);
            numbers_.boreholes.push_back(found == at.end() ? no_row : old_.boreholes[found->second]);
        }
        return numbered(table, numbers_.boreholes, [&](std::size_t j) {
            const Borehole& a = before_.boreholes[from[j]];
            const Borehole& b = after_.boreholes[j];
            return a.collar != b.collar || a.path != b.path || a.path_depth != b.path_depth;
        });
    }

    Which number_samples(StoredTable& table) {
        const auto match = matched_samples(before_.samples, after_.samples);
        numbers_.samples.assign(after_.samples.size(), no_row);
        std::vector<std::size_t> from(after_.samples.size(), 0);
        for (std::size_t i = 0; i < match.size(); ++i) {
            if (match[i] >= 0) {
                numbers_.samples[static_cast<std::size_t>(match[i])] = old_.samples[i];
                from[static_cast<std::size_t>(match[i])] = i;
            }
        }
        const auto hole = [](const Samples& samples, std::size_t i, const std::vector<std::int64_t>& rows) {
            return samples.borehole[i] < 0 ? no_row : rows[static_cast<std::size_t>(samples.borehole[i])];
        };
        return numbered(table, numbers_.samples, [&](std::size_t j) {
            const Samples& a = before_.samples;
            const Samples& b = after_.samples;
            const std::size_t i = from[j];
            bool same = hole(a, i, old_.boreholes) == hole(b, j, numbers_.boreholes) &&
                        same_number(a.depth[i], b.depth[j]) && same_number(a.length[i], b.length[j]) &&
                        same_column_values(a.values, i, b.values, j) && before_.properties == after_.properties;
            for (std::size_t p = 0; same && p < b.values.size(); ++p) {
                same = a.censoring(p, i) == b.censoring(p, j);
            }
            return !same;
        });
    }

    Which number_surfaces(StoredTable& table) {
        numbers_.surfaces =
            carried(before_.surfaces.size(), after_.surfaces.size(), old_.surfaces,
                    [&](std::size_t i, std::size_t j) { return before_.surfaces[i] == after_.surfaces[j]; });
        numbers_.sheets =
            carried(before_.barriers.size(), after_.barriers.size(), old_.sheets,
                    [&](std::size_t i, std::size_t j) { return before_.barriers[i] == after_.barriers[j]; });
        const auto none = [](std::size_t) { return false; };
        Which surfaces = numbered(table, numbers_.surfaces, none);
        new_barriers_ = numbered(table, numbers_.sheets, none, 2);
        return surfaces;
    }

    Which number_vertices(StoredTable& table) {
        std::vector<std::size_t> from(after_.vertices.size(), before_.vertices.size());
        numbers_.vertices.assign(after_.vertices.size(), no_row);
        std::size_t i = 0;
        for (std::size_t j = 0; j < after_.vertices.size(); ++j) {
            while (i < before_.vertices.size() && before_.vertices[i].id < after_.vertices[j].id) {
                ++i;
            }
            if (i < before_.vertices.size() && before_.vertices[i].id == after_.vertices[j].id) {
                numbers_.vertices[j] = old_.vertices[i];
                from[j] = i;
            }
        }
        // Rows are read in the order of ids. After a build anew ids say nothing of what was there before.
        std::vector<std::int64_t> kept = numbers_.vertices;
        std::erase(kept, no_row);
        const auto first_new = std::ranges::find(numbers_.vertices, no_row) - numbers_.vertices.begin();
        if (static_cast<std::size_t>(first_new) != kept.size()) {
            std::ranges::fill(numbers_.vertices, no_row);
        }
        const auto owner = [](const Vertex& v, const RowNumbers& numbers) {
            const auto at = static_cast<std::size_t>(v.owner);
            return v.role == Role::sample ? numbers.samples[at] : v.role == Role::seed ? numbers.sheets[at] : no_row;
        };
        return numbered(table, numbers_.vertices, [&, from](std::size_t j) {
            const Vertex& a = before_.vertices[from[j]];
            const Vertex& b = after_.vertices[j];
            const VertexValues& x = before_.vertex_values;
            const VertexValues& y = after_.vertex_values;
            return a.position != b.position || a.role != b.role || a.side != b.side ||
                   owner(a, old_) != owner(b, numbers_) || !same_number(x.extrapolation[from[j]], y.extrapolation[j]) ||
                   !same_column_values(x.values, from[j], y.values, j) || before_.properties != after_.properties;
        });
    }

    void remove_missing(StoredTable& table, const std::vector<std::int64_t>& old_rows,
                        const std::vector<std::int64_t>& new_rows, bool pairs = false) {
        std::vector<std::int64_t> kept = new_rows;
        std::ranges::sort(kept);
        for (const std::int64_t row : old_rows) {
            if (!std::ranges::binary_search(kept, row)) {
                log_.remove(table, row);
                if (pairs) {
                    log_.remove(table, row + 1);
                }
            }
        }
    }

    template <typename Columns, typename Row>
    void write_some(StoredTable& table, const Which& which, const std::vector<std::int64_t>& numbers,
                    const Columns& columns_of, const Row& row) {
        JsonRowWriter writer(database_, table, log_);
        const auto columns = columns_of(writer);
        for (const std::size_t i : which) {
            writer.at(numbers[i]);
            row(writer, columns, i);
        }
    }

    void write_barriers(StoredTable& table, const ModelRows& rows) {
        JsonRowWriter writer(database_, table, log_);
        const schema::SurfaceColumns columns(writer);
        for (const std::size_t i : new_barriers_) {
            for (const bool margin : {false, true}) {
                writer.at(numbers_.sheets[i] + (margin ? 1 : 0));
                rows.barrier_part(writer, columns, i, margin);
            }
        }
    }

    void write_meta(Meta meta) {
        meta["row_order"] = row_order_text(numbers_);
        StoredTable table(database_, schema::meta);
        std::map<std::string, std::int64_t> rows;
        const SqliteStatement keys = database_.prepare("SELECT fid, key FROM " + quoted_name(schema::meta));
        std::int64_t last = 0;
        while (database_.step(keys)) {
            rows[keys.text(1)] = keys.integer(0);
            last = std::max(last, keys.integer(0));
        }
        for (const auto& [key, value] : meta) {
            const auto found = rows.find(key);
            log_.put(table, found == rows.end() ? ++last : found->second, JsonRow{{"key", key}, {"value", value}});
        }
    }

    SqliteDatabase& database_;
    ChangeLog log_;
    const Model& before_;
    const RowNumbers& old_;
    const Model& after_;
    RowNumbers numbers_;
    Which new_barriers_;
    std::map<std::string, std::int64_t> last_given_;
};

/// The layers' extents grow with what they hold; nothing else of GeoPackage's own tables depends on the rows.
void extend_contents(SqliteDatabase& database, const Model& model) {
    Box3 box;
    for (const Vertex& vertex : model.vertices) {
        box.extend(model.frame.to_world(vertex.position));
    }
    for (const Vec3& p : model.samples.positions) {
        box.extend(model.frame.to_world(p));
    }
    SqliteStatement grow = database.prepare(
        "UPDATE gpkg_contents SET min_x = min(min_x, ?1), min_y = min(min_y, ?2), max_x = max(max_x, ?3), "
        "max_y = max(max_y, ?4), last_change = ?5 WHERE lower(table_name) IN ('samples', 'boreholes', 'surfaces', "
        "'vertices')");
    const double bounds[] = {box.lo.x, box.lo.y, box.hi.x, box.hi.y};
    for (int i = 0; i < 4; ++i) {
        sqlite3_bind_double(grow.get(), i + 1, bounds[i]);
    }
    grow.bind(5, current_time_text("%Y-%m-%dT%H:%M:%S.000Z"));
    database.step(grow);
}

}  // namespace

StoredState store_edit(const std::string& path, const Model& before, const StoredState& state, const Model& after,
                       JournalEntry entry) {
    if (is_connection(path)) {
        throw UsageError(path + ": models in PostGIS cannot be edited yet; edit a GeoPackage");
    }
    require_storable(after);
    for (const std::string* text : {&entry.command, &entry.arguments}) {
        require_storable(*text, "the journal entry");
    }
    require_plain_model(path);
    SqliteDatabase database(path);
    SqliteTransaction transaction(database);
    require_state(database, state);
    entry.edit = state.last_edit + 1;
    StoredState next;
    next.numbers = EditWriter(database, entry.edit, before, state.numbers, after).write();
    next.digest = stored_digest(database);
    next.last_edit = entry.edit;
    extend_contents(database, after);
    add_to_journal(database, entry);
    transaction.commit();
    return next;
}

}  // namespace terratet
