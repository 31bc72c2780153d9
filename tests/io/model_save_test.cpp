// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "small_disk.hpp"
#include "stored_models.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::testing;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

/// A save that the system kills at the first byte beyond a limit: the same at every run, as no clock decides. Did it?
bool killed_beyond(std::uint64_t bytes, const std::string& path, const Model& model) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const rlimit no_core{0, 0};
        const rlimit limit{bytes, bytes};
        setrlimit(RLIMIT_CORE, &no_core);
        setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, SIG_DFL);
        try {
            save_model(path, model, entry, true);
        } catch (...) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ;
    REQUIRE((killed || (WIFEXITED(status) && WEXITSTATUS(status) == 0)));
    return killed;
}

TEST_CASE("A killed save leaves the old model or none, and what it leaves loads") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    const Model old_model = plain_model();
    const Model new_model = large_model(5000);
    save_model(path, new_model, entry, true);
    const std::uint64_t size = fs::file_size(path);
    constexpr int kills = 24;
    for (int i = 0; i <= kills; ++i) {
        const bool existing = i % 2 == 1;
        INFO(i << (existing ? ", over an old model" : ""));
        fs::remove(path);
        if (existing) {
            save_model(path, old_model, entry, true);
        }
        // Spread over the file, the last one byte from its end; then a save that lives.
        const std::uint64_t limit = i == kills ? size : (size - 1) * static_cast<std::uint64_t>(i) / (kills - 1);
        const bool killed = killed_beyond(limit, path, new_model);
        CHECK(killed == (i < kills));
        REQUIRE(fs::exists(path) == (existing || !killed));
        if (fs::exists(path)) {
            CHECK(model_digest(load_model(path)) == model_digest(killed ? old_model : new_model));
        }
    }
}

TEST_CASE("A save killed at any time leaves the old model, the new one or none") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    const Model old_model = plain_model();
    const Model new_model = large_model(5000);
    const auto start = std::chrono::steady_clock::now();
    save_model(path, new_model, entry, true);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string digests[] = {model_digest(old_model), model_digest(new_model)};
    testing::Random random(9);
    for (int i = 0; i < 24; ++i) {
        const bool existing = i % 2 == 1;
        fs::remove(path);
        if (existing) {
            save_model(path, old_model, entry, true);
        }
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            try {
                save_model(path, new_model, entry, true);
            } catch (...) {
            }
            _exit(0);
        }
        std::this_thread::sleep_for(std::chrono::duration<double>(random(0, 1.2 * seconds)));
        kill(child, SIGKILL);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        REQUIRE((fs::exists(path) || !existing));
        if (fs::exists(path)) {
            const std::string digest = model_digest(load_model(path));
            CHECK((digest == digests[1] || (existing && digest == digests[0])));
        }
    }
}

TEST_CASE("A save on a full disk says so and leaves nothing, or the old model") {
    const testing::SmallDisk disk(2 << 20);
    if (!disk.mounted()) {
        WARN("SKIPPED: no right to mount");
        return;
    }
    const std::string path = disk.path() + "/m.gpkg";
    const Model small = plain_model(), large = large_model(50000);
    CHECK_THROWS_WITH(save_model(path, large, entry), Contains("m.gpkg") && Contains("full"));
    CHECK(entries(disk.path()) == 0);
    save_model(path, small, entry);
    CHECK_THROWS_WITH(save_model(path, large, entry, true), Contains("full"));
    CHECK(entries(disk.path()) == 1);
    CHECK(model_digest(load_model(path)) == model_digest(small));
}
