// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "interp/live_model.hpp"
#include "io/model_store.hpp"
#include "small_disk.hpp"
#include "tess/error.hpp"
#include "tess/site_edits.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// As readers do.
void snap(Surface& surface, const Frame& frame) {
    for (Vec3& p : surface.vertices) {
        p = frame.snapped(p);
    }
}

/// Two holes at least, and faults if the seed's world has them.
LiveModel small_live_model(std::uint64_t seed) {
    testing::World world = testing::random_world(seed);
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    world.options.estimator = "nearest";
    for (Surface& surface : world.site.surfaces) {
        snap(surface, world.site.frame);
    }
    return LiveModel(world.site, world.options);
}

ModelPlan next_plan(const Model& model, std::uint64_t kind) {
    ModelPlan plan = plan_of(model);
    const std::string hole = model.boreholes.front().id;
    switch (kind % 5) {
        case 0:
            move_borehole(plan.site, hole, {7, -3, 1});
            break;
        case 1:
            plan.site.surfaces.push_back(testing::planar_fault("new", {150, 150, -100}, 20, 60, 60, 50, 25));
            snap(plan.site.surfaces.back(), model.frame);
            break;
        case 2: {
            std::vector<bool> marked(model.samples.size());
            for (std::size_t i = 0; i < marked.size(); i += 3) {
                marked[i] = true;
            }
            remove_samples(plan.site, marked);
            break;
        }
        case 3:
            plan.criteria.overrides.push_back(
                {ResolutionOverride::Where::box, {{50, 50, -150}, {120, 120, -50}}, {}, 15, 45});
            break;
        default: {
            Site added;
            added.frame = model.frame;
            added.properties = {parse_property("K:log10")};
            added.samples.values.resize(1);
            added.boreholes.push_back({"A new one", {200, 40, 0}, {{200, 40, 0}}, {0}});
            for (int i = 0; i < 10; ++i) {
                added.samples.positions.push_back({200, 40, -10.0 * i});
                added.samples.borehole.push_back(0);
                added.samples.depth.push_back(10 * i);
                added.samples.length.push_back(0);
                added.samples.values[0].push_back(1e-7);
            }
            added.samples.set_censoring(0, 3, Censoring::below);  // a column that was not there
            add_site(plan.site, added);
        }
    }
    return plan;
}

std::string digest_in(const std::string& path) {
    return model_digest(load_model(path));
}

/// A stored model with one edit that is ready to be stored.
struct Prepared {
    Model before;
    Model after;
    StoredState state;
    std::string digests[2];

    Prepared(const std::string& path, std::uint64_t kind) {
        LiveModel live = small_live_model(0);
        save_model(path, live.model(), {0, "", "build", "{}"}, true);
        before = load_model(path, {}, &state);
        LiveModel next{Model(before)};
        next.edit(next_plan(before, kind));
        after = next.model();
        digests[0] = model_digest(before);
        digests[1] = model_digest(after);
    }
};

}  // namespace

TEST_CASE("X2, X3: edits reload as they were made, undo restores each state before, and redo each state after") {
    for (std::uint64_t seed : {0, 1, 3}) {
        INFO("seed " << seed);
        const testing::TemporaryFolder folder;
        const std::string path = folder / "m.gpkg";
        save_model(path, small_live_model(seed).model(), {0, "", "build", "{}"});
        StoredState state;
        std::vector<std::string> digests;
        LiveModel live(load_model(path, {}, &state));
        digests.push_back(model_digest(live.model()));
        for (std::uint64_t kind = 0; kind < 5; ++kind) {
            const auto before = live.snapshot();
            live.edit(next_plan(before->model(), kind));
            state = store_edit(path, before->model(), state, live.model(), {0, "", "edit", "{}"});
            digests.push_back(model_digest(live.model()));
            REQUIRE(digests.back() != digests[digests.size() - 2]);
            StoredState loaded;
            const Model again = load_model(path, {}, &loaded);
            CHECK(model_digest(again) == digests.back());
            CHECK(again.vertices == live.model().vertices);
            CHECK(loaded.numbers.vertices == state.numbers.vertices);
            CHECK(loaded.numbers.samples == state.numbers.samples);
            CHECK(loaded.numbers.sheets == state.numbers.sheets);
            CHECK(loaded.digest == state.digest);
            CHECK(loaded.last_edit == state.last_edit);
        }
        for (std::size_t i = digests.size() - 1; i > 0; --i) {
            CHECK(undo_edits(path).size() == 1);
            CHECK(digest_in(path) == digests[i - 1]);
        }
        CHECK_THROWS_WITH(undo_edits(path), Contains("nothing to undo"));
        redo_edits(path, 3);
        CHECK(digest_in(path) == digests[3]);
        redo_edits(path, 2);
        CHECK(digest_in(path) == digests[5]);
        CHECK_THROWS_AS(redo_edits(path), UsageError);
        undo_edits(path, 5);
        CHECK(digest_in(path) == digests[0]);
        const auto history = load_history(path);
        CHECK(history.size() == 1 + 5 + 5 + 5 + 5);
        CHECK(std::ranges::count(history, true, &HistoryEntry::undone) == 5);
    }
}

TEST_CASE("After an undo, another edit takes the place of what could be brought back") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    const Prepared p(path, 0);
    store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"});
    undo_edits(path);
    StoredState state;
    LiveModel live(load_model(path, {}, &state));
    const auto before = live.snapshot();
    live.edit(next_plan(before->model(), 3));
    store_edit(path, before->model(), state, live.model(), {0, "", "edit", "{}"});
    CHECK_THROWS_AS(redo_edits(path), UsageError);
    CHECK(digest_in(path) == model_digest(live.model()));
    undo_edits(path);
    CHECK(digest_in(path) == p.digests[0]);
}

TEST_CASE("Who edits a state that is no longer the newest is refused, and nothing is stored") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    const Prepared p(path, 0);
    store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"});
    CHECK_THROWS_WITH(store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"}),
                      Contains("somebody else has edited"));
    CHECK(digest_in(path) == p.digests[1]);
    CHECK(load_history(path).size() == 2);
}

TEST_CASE("An undo refuses rows that another program has changed") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "m.gpkg";
    const Prepared p(path, 0);
    store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"});
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database, "UPDATE samples SET depth = depth + 1 WHERE fid = (SELECT max(fid) FROM samples)",
                         nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
    CHECK_THROWS_WITH(undo_edits(path), Contains("another program has changed it"));
}

namespace {

int kill_count() {
    const char* const asked = std::getenv("TERRATET_KILLS");
    return asked != nullptr ? std::atoi(asked) : 40;
}

/// Runs the work in a process of its own.
pid_t start(const std::function<void()>& work) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        try {
            work();
        } catch (...) {
        }
        _exit(0);
    }
    return child;
}

void wait_for(pid_t child) {
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
}

void kill_during(double seconds, const std::function<void()>& work) {
    const pid_t child = start(work);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(child, SIGKILL);
    wait_for(child);
}

/// Left alone.
double seconds_of(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    wait_for(start(work));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What no writer should do: the vertices of another model into this one, without a journal, with hardly a cache.
void write_without_journal(const std::string& path, const std::string& other) {
    sqlite3* database = nullptr;
    sqlite3_open(path.c_str(), &database);
    const std::string text =
        "PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA cache_size=4; ATTACH '" + other +
        "' AS o; BEGIN; DELETE FROM main.vertices; INSERT INTO main.vertices SELECT * FROM o.vertices; DELETE FROM "
        "main.terratet_meta; INSERT INTO main.terratet_meta SELECT * FROM o.terratet_meta; DELETE FROM main.surfaces; "
        "INSERT INTO main.surfaces SELECT * FROM o.surfaces; COMMIT;";
    sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr);
    sqlite3_close(database);
}

}  // namespace

TEST_CASE("An edit killed at any moment leaves the state before or after it, never one between") {
    const testing::TemporaryFolder folder;
    const std::string fresh = folder / "fresh.gpkg";
    const Prepared p(fresh, 1);
    const std::string path = folder / "m.gpkg";
    const auto store = [&] { store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"}); };
    fs::copy_file(fresh, path);
    const double seconds = seconds_of(store);
    testing::Random random(3);
    int before = 0;
    int after = 0;
    for (int i = 0; i < kill_count(); ++i) {
        fs::copy_file(fresh, path, fs::copy_options::overwrite_existing);
        fs::remove(path + "-journal");
        kill_during(random(0, 1.3 * seconds), store);
        const std::string digest = digest_in(path);
        before += digest == p.digests[0] ? 1 : 0;
        after += digest == p.digests[1] ? 1 : 0;
        CHECK((digest == p.digests[0] || digest == p.digests[1]));
    }
    WARN(before << " times before, " << after << " after");
}

TEST_CASE("Without a journal a killed edit leaves states between, which the test above would see") {
    const testing::TemporaryFolder folder;
    const std::string fresh = folder / "fresh.gpkg";
    const Prepared p(fresh, 1);
    const std::string edited = folder / "edited.gpkg";
    fs::copy_file(fresh, edited);
    store_edit(edited, p.before, p.state, p.after, {0, "", "edit", "{}"});
    const std::string path = folder / "m.gpkg";
    fs::copy_file(fresh, path);
    const double seconds = seconds_of([&] { write_without_journal(path, edited); });
    testing::Random random(3);
    int between = 0;
    for (int i = 0; i < 300 && between < 3; ++i) {
        fs::copy_file(fresh, path, fs::copy_options::overwrite_existing);
        kill_during(random(0, 1.3 * seconds), [&] { write_without_journal(path, edited); });
        try {
            const std::string digest = digest_in(path);
            between += digest != p.digests[0] && digest != p.digests[1] ? 1 : 0;
        } catch (const Error&) {
            ++between;
        }
    }
    CHECK(between == 3);
}

TEST_CASE("An edit killed at a byte of the file leaves the state before it") {
    const testing::TemporaryFolder folder;
    const std::string fresh = folder / "fresh.gpkg";
    const Prepared p(fresh, 1);
    const std::string path = folder / "m.gpkg";
    const std::uint64_t size = fs::file_size(fresh);
    int killed = 0;
    for (int i = 0; i < 16; ++i) {
        fs::copy_file(fresh, path, fs::copy_options::overwrite_existing);
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            const rlimit no_core{0, 0};
            const rlimit limit{size / 64 * static_cast<std::uint64_t>(i) + 512, size * 10};
            setrlimit(RLIMIT_CORE, &no_core);
            setrlimit(RLIMIT_FSIZE, &limit);
            std::signal(SIGXFSZ, SIG_DFL);
            try {
                store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"});
            } catch (...) {
                _exit(1);
            }
            _exit(0);
        }
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        killed += WIFSIGNALED(status) ? 1 : 0;
        const std::string digest = digest_in(path);
        CHECK(digest == p.digests[WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 1 : 0]);
    }
    CHECK(killed > 4);
}

TEST_CASE("An edit on a full disk says so and leaves the model as it was, at 50 sizes of the disk") {
    const testing::TemporaryFolder folder;
    const std::string fresh = folder / "fresh.gpkg";
    const Prepared p(fresh, 1);
    const auto size = static_cast<std::size_t>(fs::file_size(fresh));
    int refused = 0;
    for (std::size_t i = 0; i < 50; ++i) {
        const testing::SmallDisk disk(size + (i + 1) * 16384);
        if (!disk.mounted()) {
            WARN("SKIPPED: no right to mount");
            return;
        }
        const std::string path = disk.path() + "/m.gpkg";
        fs::copy_file(fresh, path);
        bool stored = true;
        try {
            store_edit(path, p.before, p.state, p.after, {0, "", "edit", "{}"});
        } catch (const Error& error) {
            stored = false;
            ++refused;
            CHECK_THAT(error.what(), Contains("m.gpkg"));
        }
        CHECK(digest_in(path) == p.digests[stored ? 1 : 0]);
    }
    CHECK(refused > 5);
}
