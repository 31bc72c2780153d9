// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "small_disk.hpp"
#include "support.hpp"
#include "tess/error.hpp"

using namespace terratet;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

}  // namespace

TEST_CASE("An output appears at commit, whole, and nothing else is left in its folder") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "out.vtu";
    {
        OutputFile file(path, false);
        file.write("hello ");
        file.write(std::string_view("\0world", 6));
        CHECK_FALSE(fs::exists(path));
        CHECK(fs::path(file.temporary_path()).parent_path() == folder.path());
        CHECK(fs::path(file.temporary_path()).extension() == ".vtu");
        CHECK(file.commit() == 12);
        CHECK(content(path) == std::string("hello \0world", 12));
    }
    CHECK(entries(folder.path()) == 1);
    struct stat status {};
    REQUIRE(stat(path.c_str(), &status) == 0);
    const mode_t mask = umask(0);
    umask(mask);
    CHECK((status.st_mode & 0777) == (0666 & ~mask));
}

TEST_CASE("An output that is not committed leaves nothing, and what was there before stays") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "out.glb";
    {
        OutputFile file(path, false);
        file.write("half");
    }
    CHECK(entries(folder.path()) == 0);
    put(path, "old");
    {
        OutputFile file(path, true);
        file.write("half");
    }
    CHECK(content(path) == "old");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("An existing output is refused without overwrite, and replaced with it, keeping its permissions") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "out.csv";
    put(path, "old");
    chmod(path.c_str(), 0640);
    CHECK_THROWS_WITH(OutputFile(path, false), Contains("out.csv exists") && Contains("`overwrite`"));
    CHECK_THROWS_WITH(require_writable(path, false), Contains("out.csv exists") && Contains("`overwrite`"));
    CHECK_NOTHROW(require_writable(path, true));
    CHECK(content(path) == "old");
    OutputFile file(path, true);
    file.write("new");
    CHECK(file.commit() == 3);
    CHECK(content(path) == "new");
    struct stat status {};
    REQUIRE(stat(path.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("A file that appears while an output is being written is not replaced unasked") {
    const testing::TemporaryFolder folder;
    const std::string path = folder / "out.csv";
    {
        OutputFile file(path, false);
        file.write("ours");
        put(path, "theirs");
        CHECK_THROWS_WITH(file.commit(), Contains("exists now"));
    }
    CHECK(content(path) == "theirs");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("A symbolic link stays and its target is replaced") {
    const testing::TemporaryFolder folder, elsewhere;
    put(elsewhere / "real.csv", "old");
    fs::create_symlink(elsewhere / "real.csv", folder / "link.csv");
    OutputFile file(folder / "link.csv", true);
    file.write("new");
    file.commit();
    CHECK(fs::is_symlink(folder / "link.csv"));
    CHECK(content(elsewhere / "real.csv") == "new");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("A library may write the temporary file itself, even replace it") {
    const testing::TemporaryFolder folder;
    OutputFile file(folder / "out.vdb", false);
    file.close();
    fs::remove(file.temporary_path());
    put(file.temporary_path(), "by a library");
    CHECK(file.commit() == 12);
    CHECK(content(folder / "out.vdb") == "by a library");
}

TEST_CASE("Places that cannot be written are refused with their reason") {
    const testing::TemporaryFolder folder;
    for (const bool overwrite : {false, true}) {
        CHECK_THROWS_WITH(OutputFile(folder / "none/out.vtu", overwrite), Contains("no folder") && Contains("none"));
        CHECK_THROWS_WITH(require_writable(folder / "none/out.vtu", overwrite), Contains("no folder"));
        CHECK_THROWS_WITH(OutputFile(folder.path().string(), overwrite), Contains("it is a folder"));
        CHECK_THROWS_WITH(OutputFile("/dev/null", overwrite), Contains("not a regular file"));
        CHECK_THROWS_WITH(OutputFile(folder / (std::string(300, 'x') + ".vtu"), overwrite).commit(),
                          Contains("too long"));
    }
    CHECK(entries(folder.path()) == 0);
}

TEST_CASE("A folder that may not be written to is named before any work") {
    if (geteuid() != 0) {
        WARN("SKIPPED: not root");
        return;
    }
    const testing::TemporaryFolder folder;
    REQUIRE(chmod(folder.path().c_str(), 0755) == 0);
    REQUIRE(seteuid(65534) == 0);
    std::string message;
    try {
        const OutputFile file(folder / "out.vtu", false);
    } catch (const Error& error) {
        message = error.what();
    }
    REQUIRE(seteuid(0) == 0);
    CHECK_THAT(message, Contains("Permission denied") && Contains("may write"));
    CHECK(entries(folder.path()) == 0);
}

TEST_CASE("A full disk is reported as such and leaves nothing") {
    const testing::SmallDisk disk(1 << 20);
    if (!disk.mounted()) {
        WARN("SKIPPED: no right to mount");
        return;
    }
    const std::string block(1 << 16, 'x');
    const auto fill = [&](std::size_t blocks) {
        OutputFile file(disk.path() + "/out.vtu", false);
        for (std::size_t i = 0; i < blocks; ++i) {
            file.write(block);
        }
        file.commit();
    };
    CHECK_THROWS_WITH(fill(64), Contains("out.vtu") && Contains("No space left") && Contains("free some space"));
    CHECK_THROWS_WITH(fill(17), Contains("No space left"));  // still in the buffer: seen at commit
    CHECK(entries(disk.path()) == 0);
    fill(8);
    CHECK(entries(disk.path()) == 1);
}
