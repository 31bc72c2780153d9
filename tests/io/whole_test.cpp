// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every writer where there is not room enough: on disks of fifty sizes, and under fifty limits on the size of a file.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "grid_model.hpp"
#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/model_store.hpp"
#include "io/write/write_svg.hpp"
#include "random_model.hpp"
#include "small_disk.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;
using terratet::testing::GridModel;
using terratet::testing::SmallDisk;
using terratet::testing::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

constexpr int sizes = 50;

std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Writer {
    std::string name;  ///< of the file
    std::function<void(const std::string& path)> write;
};

/// All that put files on disk, each over an old file too.
std::vector<Writer> writers() {
    static const GridModel grid;
    static const Model stored = [] {
        std::uint64_t seed = 1;
        while (testing::random_model(seed).vertices.size() < 40) {
            ++seed;
        }
        return testing::random_model(seed);
    }();
    std::vector<Writer> all;
    for (const char* name : {"a.vtu", "plain.vtu", "a.glb", "a.gltf", "a.html", "a.png", "a.vdb", "a.tif", "a.nc",
                             "a.blocks", "a.cog", "a.msh", "a.csv"}) {
        all.push_back({name, [name](const std::string& path) {
                           ExportOptions options;
                           options.overwrite = true;
                           if (std::string(name).starts_with("plain")) {
                               options.compress = false;
                           }
                           options.voxel_size = {20, 20, 20};
                           options.picture_size = {400, 300};
                           export_model({grid.model, grid.mesh, grid.cells}, path, options);
                       }});
    }
    all.push_back({"a.gpkg", [](const std::string& path) {
                       save_model(path, stored, {1, "2026-01-02T03:04:05Z", "build", "{}"}, true);
                   }});
    all.push_back({"a.svg", [](const std::string& path) {
                       Chart chart{"a", "x", "y", {}, false, false};
                       chart.series.push_back({"dots", ChartSeries::Style::dots, {}});
                       for (int i = 0; i < 2000; ++i) {
                           chart.series[0].points.emplace_back(i, i % 7);
                       }
                       write_svg({chart, chart, chart}, path, true);
                   }});
    all.push_back({"report.json", [](const std::string& path) {
                       OutputFile file(path, true);
                       for (int i = 0; i < 3000; ++i) {
                           file.write(R"({"file": "log.csv", "line": 12, "reason": "not a number"},)");
                       }
                       file.commit();
                   }});
    return all;
}

/// No file of this process grows beyond `bytes` until the end of the scope; the signal for it is ignored.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::uint64_t bytes) : before_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, before_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*before_handler_)(int);
};

/// Writes over an old file; either the new one is there, whole, or an error says why and the old one is. `room` is what
/// hems the writer in, made for it alone: the test's own messages may go to a file.
template <class Room>
void check_whole(const Writer& writer, const std::string& folder, const std::string& whole, int& refused,
                 const Room& room) {
    const std::string path = folder + "/" + writer.name;
    const std::string old = "what was here before";
    std::ofstream(path) << old;
    std::string message;
    try {
        [[maybe_unused]] const auto limit = room();
        writer.write(path);
    } catch (const Error& error) {
        message = error.what();
    }
    const std::string now = content(path);
    CHECK(std::distance(fs::directory_iterator(folder), {}) == 1);
    if (message.empty()) {
        CHECK((writer.name.ends_with(".gpkg") ? now.size() >= whole.size() / 2 : now == whole));
    } else {
        ++refused;
        CHECK((now == old));
        CHECK_THAT(message, Contains("cannot write") && Contains(writer.name) && Contains(";"));
    }
    fs::remove(path);
}

std::string written_whole(const Writer& writer) {
    const TemporaryFolder folder;
    writer.write(folder / writer.name);
    return content(folder / writer.name);
}

}  // namespace

TEST_CASE("On a disk that is too small every writer says so and leaves the old file") {
    for (const Writer& writer : writers()) {
        INFO(writer.name);
        const std::string whole = written_whole(writer);
        REQUIRE(whole.size() > 20'000);
        int refused = 0;
        for (int i = 0; i < sizes; ++i) {
            // From a page to somewhat more than it takes beside the old file; SQLite has a journal besides.
            const std::size_t room = writer.name.ends_with(".gpkg") ? 3 * whole.size() : whole.size() * 13 / 10;
            const std::size_t bytes = 4096 + (room + 8192) * static_cast<std::size_t>(i) / (sizes - 1);
            const SmallDisk disk(bytes);
            if (!disk.mounted()) {
                WARN("SKIPPED: no right to mount");
                return;
            }
            INFO(bytes << " bytes");
            check_whole(writer, disk.path(), whole, refused, [] { return 0; });
        }
        CHECK(refused > 10);
        CHECK((refused < sizes || writer.name.ends_with(".cog")));  // is made from another file beside it
    }
}

TEST_CASE("Where a file may not grow so far every writer says so and leaves the old one") {
    for (const Writer& writer : writers()) {
        INFO(writer.name);
        const std::string whole = written_whole(writer);
        int refused = 0;
        for (int i = 0; i < sizes; ++i) {
            const std::uint64_t bytes = 21 + (whole.size() * 11 / 10) * static_cast<std::uint64_t>(i) / (sizes - 1);
            const TemporaryFolder folder;
            INFO(bytes << " bytes");
            check_whole(writer, folder.path(), whole, refused, [bytes] { return FileSizeLimit(bytes); });
        }
        CHECK(refused > 20);
        CHECK((refused < sizes || writer.name.ends_with(".cog")));  // is made from another file beside it
    }
}
