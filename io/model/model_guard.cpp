// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/model_guard.hpp"

#include <cpl_vsi.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "io/base/lower_case.hpp"
#include "io/model/model_schema.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::array layers{schema::samples, schema::boreholes, schema::surfaces, schema::vertices,
                            schema::meta,    schema::journal,   schema::changes};

bool is_layer(const std::string& name) {
    return std::any_of(layers.begin(), layers.end(), [&](const char* layer) { return lower_case(name) == layer; });
}

/// What a program that reads the model reads.
bool is_protected(const std::string& name) {
    return is_layer(name) || lower_case(name).starts_with("gpkg_");
}

/// Tables whose triggers run when a model is written.
bool is_written(const std::string& table) {
    static const std::set<std::string> own = {"gpkg_contents", "gpkg_geometry_columns", "gpkg_spatial_ref_sys",
                                              "gpkg_ogr_contents", "gpkg_extensions"};
    return is_layer(table) || own.contains(lower_case(table));
}

struct Statement {
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
    };
    std::unique_ptr<sqlite3_stmt, Finalize> handle;

    [[nodiscard]] std::string text(int column) const {
        const auto* const bytes = sqlite3_column_text(handle.get(), column);
        return bytes ? std::string(reinterpret_cast<const char*>(bytes)) : std::string();
    }
    [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(handle.get(), column); }
};

/// A database for reading alone: nothing of its schema is run.
class Database {
  public:
    explicit Database(const std::string& path) : file_(path) {
        sqlite3* handle = nullptr;
        const bool virtual_file = path.starts_with("/vsi");
        const int opened = sqlite3_open_v2(virtual_file ? ":memory:" : path.c_str(), &handle,
                                           virtual_file ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY, nullptr);
        handle_.reset(handle);
        if (opened != SQLITE_OK) {
            fail();
        }
        if (virtual_file) {
            load(path);
        }
        for (const auto& [option, value] : {std::pair(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0),
                                            {SQLITE_DBCONFIG_DEFENSIVE, 1},
                                            {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                            {SQLITE_DBCONFIG_ENABLE_VIEW, 0}}) {
            sqlite3_db_config(handle, option, value, nullptr);
        }
        step(prepare("PRAGMA cell_size_check = ON"));
    }

    Statement prepare(const std::string& sql) {
        sqlite3_stmt* statement = nullptr;
        if (sqlite3_prepare_v2(handle_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
            fail();
        }
        return {{statement, {}}};
    }

    /// False behind the last row.
    bool step(const Statement& statement) {
        const int result = sqlite3_step(statement.handle.get());
        if (result != SQLITE_ROW && result != SQLITE_DONE) {
            fail();
        }
        return result == SQLITE_ROW;
    }

    [[noreturn]] void fail() {
        throw InputError(file_ + ": is damaged, or no database that can be read: " + sqlite3_errmsg(handle_.get()));
    }

  private:
    /// GDAL's virtual files (/vsizip/ and the like) are read into memory; they have no journal beside them.
    void load(const std::string& path) {
        GByte* bytes = nullptr;
        vsi_l_offset size = 0;
        constexpr GIntBig most = GIntBig{1} << 32;
        if (VSIIngestFile(nullptr, path.c_str(), &bytes, &size, most) == 0) {
            throw InputError(path + ": cannot be read, or is larger than 4 GB");
        }
        content_.reset(bytes);
        constexpr std::size_t format_version = 18;  // and 19; 2 asks for a write-ahead log, which memory has not
        for (std::size_t i = format_version; i < format_version + 2 && i < size; ++i) {
            bytes[i] = bytes[i] == 2 ? GByte{1} : bytes[i];
        }
        const auto length = static_cast<sqlite3_int64>(size);
        if (sqlite3_deserialize(handle_.get(), "main", bytes, length, length, SQLITE_DESERIALIZE_READONLY) !=
            SQLITE_OK) {
            fail();
        }
    }

    struct Close {
        void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
    };
    struct Free {
        void operator()(GByte* bytes) const { VSIFree(bytes); }
    };
    std::string file_;
    std::unique_ptr<GByte, Free> content_;
    std::unique_ptr<sqlite3, Close> handle_;
};

/// A name within a statement.
std::string quoted(const std::string& name) {
    std::string result = "\"";
    for (const char c : name) {
        result += c == '"' ? "\"\"" : std::string(1, c);
    }
    return result + '"';
}

/// One word of a statement: `quote` is what it stood in, 0 for a bare word, and 1 for a sign.
struct Word {
    std::string text;
    char quote = 0;
};

/// Splits as SQLite does, comments left out. A statement that SQLite has parsed has no open quote.
std::vector<Word> words_of(const std::string& sql) {
    std::vector<Word> words;
    for (std::size_t i = 0; i < sql.size();) {
        const char c = sql[i];
        const auto is_letter = [](char l) {
            return std::isalnum(static_cast<unsigned char>(l)) != 0 || l == '_' || l == '$' || l == '.' ||
                   static_cast<unsigned char>(l) >= 0x80;
        };
        if (sql.compare(i, 2, "--") == 0) {
            i = std::min(sql.find('\n', i), sql.size());
        } else if (sql.compare(i, 2, "/*") == 0) {
            const std::size_t end = sql.find("*/", i + 2);
            i = end == std::string::npos ? sql.size() : end + 2;
        } else if (c == '"' || c == '\'' || c == '`' || c == '[') {
            const char close = c == '[' ? ']' : c;
            Word word{{}, c};
            for (++i; i < sql.size() && (sql[i] != close || (i + 1 < sql.size() && sql[i + 1] == close && c != '['));
                 ++i) {
                i += sql[i] == close ? 1 : 0;
                word.text += sql[i];
            }
            ++i;
            words.push_back(std::move(word));
        } else if (is_letter(c)) {
            Word word;
            for (; i < sql.size() && is_letter(sql[i]); ++i) {
                word.text += sql[i];
            }
            words.push_back(std::move(word));
        } else {
            if (std::isspace(static_cast<unsigned char>(c)) == 0) {
                words.push_back({std::string(1, c), 1});
            }
            ++i;
        }
    }
    return words;
}

/// Does a trigger only do what GeoPackage's own do: count a layer's rows, keep its R-tree? Told by its words, since
/// their texts differ between versions: they name nothing but the layer's R-tree and gpkg_ogr_contents, and know no
/// SELECT.
bool is_own_trigger(const std::string& name, const std::string& layer, const std::string& sql) {
    const std::string tree = "rtree_" + lower_case(layer) + "_geom";
    const std::string count_end = "_feature_count_" + lower_case(layer);
    const std::string named = lower_case(name);
    if (named != "trigger_insert" + count_end && named != "trigger_delete" + count_end &&
        !named.starts_with(tree + "_")) {
        return false;
    }
    static const std::set<std::string> known = {
        "create",   "trigger",  "after",   "insert",     "update",        "delete",
        "on",       "of",       "when",    "begin",      "end",           "or",
        "replace",  "into",     "values",  "from",       "where",         "set",
        "and",      "not",      "null",    "notnull",    "isnull",        "is",
        "st_minx",  "st_maxx",  "st_miny", "st_maxy",    "st_isempty",    "lower",
        "new.geom", "old.geom", "new.fid", "old.fid",    "new.",          "old.",
        "id",       "fid",      "geom",    "minx",       "maxx",          "miny",
        "maxy",     "0",        "1",       "table_name", "feature_count", "gpkg_ogr_contents",
        "for",      "each",     "row",     "new",        "old",           "in"};
    const auto words = words_of(sql);
    return std::all_of(words.begin(), words.end(), [&](const Word& word) {
        const std::string text = lower_case(word.text);
        return word.quote == 1 || known.contains(text) || text == tree || text == lower_case(layer) || text == named;
    });
}

/// The parts of a model's schema, each refused where it is not plain.
class Guard {
  public:
    explicit Guard(const std::string& path) : file_(path), database_(path) {}

    void check() {
        check_objects();
        for (const char* layer : layers) {
            if (found_.contains(layer)) {  // what is missing is told when it is read
                check_columns(layer);
                check_cells(layer);
            }
        }
    }

  private:
    struct Cell {
        std::string column;
        std::string test;  ///< SQL, true for what the column is not for
    };

    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(file_ + ": " + what + "; a model has nothing of the kind: get it from who built it");
    }

    void check_objects();
    void check_index(const std::string& name, const std::string& layer, const std::string& sql);
    void check_columns(const std::string& layer);
    void check_cells(const std::string& layer);

    std::string file_;
    Database database_;
    std::set<std::string> found_;
    std::vector<Cell> cells_;  ///< of the layer that was checked last
};

void Guard::check_objects() {
    const Statement objects = database_.prepare("SELECT type, name, tbl_name, rootpage, sql FROM sqlite_master");
    while (database_.step(objects)) {
        const std::string type = objects.text(0);
        const std::string name = objects.text(1);
        const std::string table = objects.text(2);
        const std::string sql = objects.text(4);
        if (type == "index" || type == "trigger") {
            if (type == "trigger" && is_written(table) && !is_own_trigger(name, table, sql)) {
                refuse("the trigger `" + name + "` on layer `" + table + "` is not GeoPackage's own");
            }
            if (type == "index" && is_protected(table) && !sql.empty()) {
                check_index(name, table, sql);
            }
        } else if (is_protected(name)) {
            if (type != "table" || objects.integer(3) <= 0) {
                refuse("layer `" + name + "` must be a table; it is a " + (type == "table" ? "virtual table" : type));
            }
            found_.insert(lower_case(name));
        }
    }
}

void Guard::check_index(const std::string& name, const std::string& layer, const std::string& sql) {
    const auto words = words_of(sql);
    bool plain = std::none_of(words.begin(), words.end(),
                              [](const Word& word) { return word.quote == 0 && lower_case(word.text) == "where"; });
    const Statement columns = database_.prepare("PRAGMA index_xinfo(" + quoted(name) + ")");
    while (database_.step(columns)) {
        plain = plain && columns.integer(1) >= -1;  // −1: the row's number; −2: an expression
    }
    if (!plain) {
        refuse("the index `" + name + "` on layer `" + layer + "` is over an expression, or over some rows only");
    }
}

/// What typeof() may say of a column's cells; empty for types that no column of a model has.
std::string cell_types(const std::string& declared) {
    static const std::set<std::string> geometries = {"point", "linestring", "multipolygon", "geometry", "blob"};
    const std::string type = lower_case(declared);
    if (type == "real" || type == "double" || type == "float") {
        return "('real', 'integer', 'null')";
    }
    if (type == "integer" || type == "int" || type == "mediumint") {
        return "('integer', 'null')";
    }
    return type.starts_with("text") ? "('text', 'null')" : geometries.contains(type) ? "('blob', 'null')" : "";
}

void Guard::check_columns(const std::string& layer) {
    cells_.clear();
    bool numbered = false;
    const Statement columns = database_.prepare("PRAGMA table_xinfo(" + quoted(layer) + ")");
    while (database_.step(columns)) {
        const std::string name = columns.text(1);
        const std::string declared = columns.text(2);
        if (columns.integer(6) != 0) {
            refuse("column `" + name + "` of layer `" + layer + "` is generated");
        }
        if (lower_case(name) == "fid") {
            numbered = columns.integer(5) == 1 && lower_case(declared) == "integer";
        } else if (const std::string types = cell_types(declared); !types.empty()) {
            cells_.push_back({name, "typeof(" + quoted(name) + ") NOT IN " + types});
        }
    }
    if (!numbered) {
        refuse("layer `" + layer + "` has no column `fid` that numbers its rows");
    }
}

void Guard::check_cells(const std::string& layer) {
    std::string sql = "SELECT fid, CASE";
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        sql += " WHEN " + cells_[i].test + " THEN " + std::to_string(i);
    }
    sql += " ELSE -1 END FROM " + quoted(layer) + " NOT INDEXED";
    if (cells_.empty()) {
        return;
    }
    const Statement rows = database_.prepare(sql);
    std::optional<std::int64_t> before;
    while (database_.step(rows)) {
        const std::int64_t row = rows.integer(0);
        // Pages that refer to one another can make a file of a few pages seem endless; their rows then repeat.
        if (before && row <= *before) {
            refuse("layer `" + layer + "`, row " + std::to_string(row) + " comes behind row " +
                   std::to_string(*before) + ": the file is damaged");
        }
        before = row;
        if (const std::int64_t bad = rows.integer(1); bad >= 0) {
            const std::string& column = cells_[static_cast<std::size_t>(bad)].column;
            refuse("layer `" + layer + "`, row " + std::to_string(row) + ", column `" + column +
                   "` holds something of another type than its column");
        }
    }
}

}  // namespace

bool holds_model(const std::string& path) {
    constexpr std::string_view magic = "SQLite format 3";
    std::array<char, magic.size()> head{};
    VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
    if (!file) {
        return false;
    }
    const bool whole = VSIFReadL(head.data(), 1, head.size(), file) == head.size();
    VSIFCloseL(file);
    if (!whole || std::string_view(head.data(), head.size()) != magic) {
        return false;
    }
    Database database(path);
    const Statement names = database.prepare("SELECT name FROM sqlite_master WHERE type IN ('table', 'view')");
    while (database.step(names)) {
        if (lower_case(names.text(0)) == schema::meta) {
            return true;
        }
    }
    return false;
}

void require_plain_model(const std::string& path) {
    Guard(path).check();
}

}  // namespace terratet
