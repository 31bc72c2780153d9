// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model file changed as the bytes say: cells of any type, rows, parts of terratet_meta and its keys, the schema,
// pages and single bytes of the file. Refused with an InputError, or a model whose indices and numbers are in range.
// The file is in memory and has pages of 512 bytes; SQLite, which no sanitizer has seen, takes its memory past
// AddressSanitizer.
#include <cpl_vsi.h>
#include <fuzzer/FuzzedDataProvider.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/model_store.hpp"
#include "io/random_model.hpp"
#include "tess/error.hpp"

using namespace terratet;

extern "C" {
void* __libc_malloc(std::size_t);          // NOLINT: glibc's own, which no sanitizer replaces
void* __libc_realloc(void*, std::size_t);  // NOLINT
void __libc_free(void*);                   // NOLINT
}

namespace {

void require(bool holds) {
    if (!holds) {
        std::abort();
    }
}

constexpr std::size_t page = 512;

/// Memory with its size in front, straight from the C library.
namespace plain {
constexpr std::size_t head = 16;

void* sized(void* block, int size) {
    if (block == nullptr) {
        return nullptr;
    }
    std::memcpy(block, &size, sizeof size);
    return static_cast<char*>(block) + head;
}
void* start(void* given) {
    return static_cast<char*>(given) - head;
}
void* allocate(int size) {
    return sized(__libc_malloc(head + static_cast<std::size_t>(size)), size);
}
void release(void* given) {
    if (given != nullptr) {
        __libc_free(start(given));
    }
}
void* resize(void* given, int size) {
    return sized(__libc_realloc(start(given), head + static_cast<std::size_t>(size)), size);
}
int size_of(void* given) {
    int size = 0;
    if (given != nullptr) {
        std::memcpy(&size, start(given), sizeof size);
    }
    return size;
}
int rounded(int size) {
    return (size + 7) & ~7;
}
int begin(void*) {
    return SQLITE_OK;
}
void end(void*) {}

sqlite3_mem_methods methods = {allocate, release, resize, size_of, rounded, begin, end, nullptr};
}  // namespace plain

/// A few rows of everything, in small pages, so that there are inner pages and overflow chains to damage.
std::string sound_model() {
    std::uint64_t seed = 1;
    Model model;
    do {
        model = testing::random_model(seed++);
    } while (model.boreholes.size() < 2 || model.samples.size() < 6 || model.samples.size() > 16 ||
             model.barriers.empty() || model.vertices.size() < 12 || model.vertices.size() > 24 ||
             model.surfaces.empty() || model.properties.size() < 2 || model.properties.size() > 4 ||
             !model.samples.any_censored());
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    save_model(path, model, {1, "2026-01-02T03:04:05Z", "build", "{}"});
    sqlite3* database = nullptr;
    sqlite3_open(path.c_str(), &database);
    sqlite3_exec(database, "PRAGMA page_size = 512; VACUUM", nullptr, nullptr, nullptr);
    sqlite3_close(database);
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

const char* const tables[] = {
    "samples", "boreholes", "surfaces", "vertices", "terratet_meta", "gpkg_contents", "gpkg_geometry_columns"};

const char* const meta_keys[] = {"format_version", "frame",  "properties", "criteria", "density", "fault_options",
                                 "regions",        "domain", "estimator",  "counts",   "digest",  "other"};

const char* const schema_changes[] = {
    "ALTER TABLE samples ADD COLUMN g AS (1)",
    "CREATE TRIGGER t AFTER INSERT ON vertices BEGIN SELECT 1; END",
    "CREATE INDEX i ON vertices (side)",
    "CREATE INDEX i ON vertices (abs(side))",
    "DROP TABLE vertices",
    "DROP TABLE terratet_journal",
    "ALTER TABLE vertices DROP COLUMN side",
    "ALTER TABLE samples RENAME COLUMN depth TO deep",
    "CREATE VIEW v AS SELECT * FROM samples",
    "DELETE FROM gpkg_contents",
    "DELETE FROM terratet_meta WHERE key = 'digest'",
    "DELETE FROM vertices",
    "UPDATE gpkg_geometry_columns SET geometry_type_name = 'POINT', z = 0",
    "UPDATE gpkg_contents SET data_type = 'tiles'",
    "UPDATE gpkg_spatial_ref_sys SET definition = 'GEOGCS['",
    "INSERT INTO vertices SELECT fid + 1000, geom, id + 1000000, role, owner, side, extrapolation FROM vertices",
};

const double odd_numbers[] = {0.0,      -0.0,      1.0,    -1.0,         2.0,
                              1e300,    -1e300,    1e-300, 1e9,          1.0000001e9,
                              HUGE_VAL, -HUGE_VAL, 0.5,    4294967296.0, 9007199254740993.0,
                              1e19};

/// A database in memory, as the bytes change it.
class Changes {
  public:
    explicit Changes(const std::string& bytes) {
        sqlite3_open(":memory:", &database_);
        auto* const copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
        std::copy(bytes.begin(), bytes.end(), copy);
        const auto size = static_cast<sqlite3_int64>(bytes.size());
        sqlite3_deserialize(database_, "main", copy, size, size,
                            SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
    }
    ~Changes() { sqlite3_close(database_); }
    Changes(const Changes&) = delete;
    Changes& operator=(const Changes&) = delete;

    void make_one(FuzzedDataProvider& data) {
        switch (data.ConsumeIntegralInRange(0, 9)) {
            case 0:
                run(data.PickValueInArray(schema_changes));
                break;
            case 1:
                change_row(data);
                break;
            case 2:
                run(std::string("UPDATE terratet_meta SET key = '") + data.PickValueInArray(meta_keys) +
                    "' WHERE key = '" + data.PickValueInArray(meta_keys) + "'");
                break;
            case 3:
            case 4:
                change_meta(data);
                break;
            default:
                change_cell(data);
        }
    }

    [[nodiscard]] std::string bytes() {
        sqlite3_int64 size = 0;
        unsigned char* const all = sqlite3_serialize(database_, "main", &size, 0);
        std::string result(reinterpret_cast<const char*>(all), all ? static_cast<std::size_t>(size) : 0);
        sqlite3_free(all);
        return result;
    }

  private:
    void run(const std::string& sql) { sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr); }

    static std::string row(FuzzedDataProvider& data) { return std::to_string(data.ConsumeIntegralInRange(1, 25)); }

    /// Deleted, or numbered otherwise.
    void change_row(FuzzedDataProvider& data) {
        const std::string table = data.PickValueInArray(tables);
        if (data.ConsumeBool()) {
            run("DELETE FROM " + table + " WHERE rowid = " + row(data));
        } else {
            const std::string number = row(data);
            run("UPDATE OR REPLACE " + table + " SET rowid = " + number + " WHERE rowid = " + row(data));
        }
    }

    std::string column(const std::string& table, FuzzedDataProvider& data) {
        sqlite3_stmt* columns = nullptr;
        sqlite3_prepare_v2(database_, ("SELECT * FROM " + table + " LIMIT 1").c_str(), -1, &columns, nullptr);
        const int count = sqlite3_column_count(columns);
        std::string name = count == 0 ? "fid" : sqlite3_column_name(columns, data.ConsumeIntegralInRange(0, count - 1));
        sqlite3_finalize(columns);
        return name;
    }

    /// Set to anything, or to what another row or column holds.
    void change_cell(FuzzedDataProvider& data) {
        const std::string table = data.PickValueInArray(tables);
        const std::string column = this->column(table, data);
        if (data.ConsumeIntegralInRange(0, 3) == 0) {
            const std::string other = this->column(table, data);
            const std::string number = row(data);
            run("UPDATE " + table + " SET \"" + column + "\" = (SELECT \"" + other + "\" FROM " + table +
                " WHERE rowid = " + number + ") WHERE rowid = " + row(data));
            return;
        }
        sqlite3_stmt* update = nullptr;
        const std::string where = " WHERE rowid = " + row(data);
        if (sqlite3_prepare_v2(database_, ("UPDATE " + table + " SET \"" + column + "\" = ?" + where).c_str(), -1,
                               &update, nullptr) == SQLITE_OK) {
            bind(update, data);
            sqlite3_step(update);
        }
        sqlite3_finalize(update);
    }

    static void bind(sqlite3_stmt* update, FuzzedDataProvider& data) {
        switch (data.ConsumeIntegralInRange(0, 5)) {
            case 0:
                sqlite3_bind_int64(update, 1, data.ConsumeIntegralInRange<std::int64_t>(-2, 100));
                break;
            case 1:
                sqlite3_bind_int64(update, 1, data.ConsumeIntegral<std::int64_t>());
                break;
            case 2:
                sqlite3_bind_double(update, 1, data.PickValueInArray(odd_numbers));
                break;
            case 3: {
                const std::string text = data.ConsumeRandomLengthString(40);
                sqlite3_bind_text(update, 1, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
                break;
            }
            case 4: {
                const std::string blob = data.ConsumeRandomLengthString(120);
                sqlite3_bind_blob(update, 1, blob.data(), static_cast<int>(blob.size()), SQLITE_TRANSIENT);
                break;
            }
            default:
                sqlite3_bind_null(update, 1);
        }
    }

    /// A part of one value is replaced: by an odd number where a number stood, or by any bytes.
    void change_meta(FuzzedDataProvider& data) {
        sqlite3_stmt* select = nullptr;
        sqlite3_prepare_v2(database_, "SELECT value FROM terratet_meta WHERE rowid = ?", -1, &select, nullptr);
        const int row = data.ConsumeIntegralInRange(1, 11);
        sqlite3_bind_int(select, 1, row);
        std::string value;
        if (select && sqlite3_step(select) == SQLITE_ROW && sqlite3_column_text(select, 0)) {
            value = reinterpret_cast<const char*>(sqlite3_column_text(select, 0));
        }
        sqlite3_finalize(select);
        const std::size_t at = data.ConsumeIntegralInRange<std::size_t>(0, value.size());
        if (data.ConsumeBool()) {
            const std::size_t begin = std::min(value.find_first_of("-0123456789", at), value.size());
            const std::size_t end = std::min(value.find_first_not_of("-+.e0123456789", begin), value.size());
            static const char* const numbers[] = {"0",       "-1",   "1e300", "1e-300", "\"inf\"",
                                                  "\"nan\"", "null", "[]",    "1e19",   "18446744073709551615",
                                                  "0.5",     "1.5e9"};
            value.replace(begin, end - begin, data.PickValueInArray(numbers));
        } else {
            value.replace(at, data.ConsumeIntegralInRange(0, 12), data.ConsumeRandomLengthString(24));
        }
        sqlite3_stmt* update = nullptr;
        sqlite3_prepare_v2(database_, "UPDATE terratet_meta SET value = ? WHERE rowid = ?", -1, &update, nullptr);
        sqlite3_bind_text(update, 1, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
        sqlite3_bind_int(update, 2, row);
        sqlite3_step(update);
        sqlite3_finalize(update);
    }

    sqlite3* database_ = nullptr;
};

void check_values(const std::vector<Property>& properties, const std::vector<std::vector<double>>& values,
                  std::size_t rows) {
    require(values.size() == properties.size());
    for (std::size_t p = 0; p < values.size(); ++p) {
        require(values[p].size() == rows);
        for (const double value : values[p]) {
            require(!std::isinf(value));
            require(properties[p].kind == Kind::continuous || std::isnan(value) ||
                    (value >= 0 && value < static_cast<double>(properties[p].classes.size())));
        }
    }
}

void check_model(const Model& model) {
    require(model.criteria.l_min > 0 && model.criteria.l_max >= model.criteria.l_min);
    require(!model.domain.extent.empty() && is_acceptable(model.domain.hull.lo) && is_acceptable(model.domain.hull.hi));
    require(model.frame.z_scale > 0 && model.frame.metres_per_unit > 0 && is_acceptable(model.frame.origin));
    check_values(model.properties, model.samples.values, model.samples.size());
    check_values(model.properties, model.vertex_values.values, model.vertices.size());
    require(model.criteria.variation.empty() || model.criteria.variation.size() == model.properties.size());
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        require(is_acceptable(model.samples.positions[i]));
        require(model.samples.borehole[i] >= -1 &&
                model.samples.borehole[i] < static_cast<std::int32_t>(model.boreholes.size()));
        require(!(model.samples.length[i] < 0) && !std::isinf(model.samples.depth[i]));
    }
    for (const Vertex& v : model.vertices) {
        const std::size_t owners = v.role == Role::sample ? model.samples.size()
                                   : v.role == Role::seed ? model.barriers.size()
                                                          : 0;
        require(is_acceptable(v.position));
        require(owners == 0 ? v.owner == -1 : v.owner >= 0 && static_cast<std::size_t>(v.owner) < owners);
    }
    std::vector<const Surface*> surfaces;
    for (const Surface& surface : model.surfaces) {
        surfaces.push_back(&surface);
    }
    for (const Barrier& fault : model.barriers) {
        require(fault.spacing > 0 && fault.width >= 0 && fault.protection_radius >= 0);
        surfaces.insert(surfaces.end(), {&fault.sheet, &fault.margin});
    }
    for (const Surface* surface : surfaces) {
        for (const Triangle& t : surface->triangles) {
            require(t[0] < surface->vertices.size() && t[1] < surface->vertices.size() &&
                    t[2] < surface->vertices.size());
        }
    }
    require(model_digest(model).size() == 64);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    sqlite3_config(SQLITE_CONFIG_SINGLETHREAD);
    sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);
    sqlite3_config(SQLITE_CONFIG_MALLOC, &plain::methods);
    return 0;
}

namespace {

/// Bytes, whole pages over others, and the end cut off.
void change_file(std::string& file, FuzzedDataProvider& data) {
    const auto at = [&](std::size_t end) { return data.ConsumeIntegralInRange<std::size_t>(0, end); };
    for (int left = data.ConsumeIntegralInRange(0, 20) - 12; left > 0 && file.size() >= 2 * page; --left) {
        switch (data.ConsumeIntegralInRange(0, 9)) {
            case 0: {
                const std::size_t pages = file.size() / page;
                const std::size_t from = at(pages - 1), to = at(pages - 1);
                std::memmove(&file[to * page], &file[from * page], page);
                break;
            }
            case 1:
                file.resize(file.size() - at(file.size() / page) * page);
                break;
            case 2:  // of the file's header, or of a page's
                file[data.ConsumeBool() ? at(99) : at(file.size() / page - 1) * page + at(11)] =
                    data.ConsumeIntegral<char>();
                break;
            default:
                file[at(file.size() - 1)] = data.ConsumeIntegral<char>();
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const std::string sound = sound_model();
    FuzzedDataProvider data(bytes, size);
    const bool accept_edited = data.ConsumeIntegralInRange(0, 15) > 0;
    const bool journal = data.ConsumeIntegralInRange(0, 15) == 0;
    std::string file;
    {
        Changes changes(sound);
        for (int left = data.ConsumeIntegralInRange(0, 6); left > 0; --left) {
            changes.make_one(data);
        }
        file = changes.bytes();
    }
    change_file(file, data);
    const char* const path = "/vsimem/fuzz.gpkg";
    VSIFCloseL(VSIFileFromMemBuffer(path, reinterpret_cast<GByte*>(file.data()), file.size(), FALSE));
    try {
        check_model(load_model(path, {.accept_edited = accept_edited}));
        if (journal && is_model(path)) {
            load_journal(path);
        }
    } catch (const InputError&) {
    }
    VSIUnlink(path);
    return 0;
}
