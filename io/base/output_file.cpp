// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <random>
#include <set>
#include <system_error>
#include <utility>

#include "tess/error.hpp"

namespace terratet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = 1 << 20;

/// The outputs of this program, for abandon_outputs().
struct Outputs {
    std::mutex mutex;
    std::set<std::string> temporaries;
    std::vector<std::string> committed;
};

Outputs& outputs() {
    static Outputs all;
    return all;
}

std::string advice(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "; free some space or choose another folder";
        case EACCES:
        case EPERM:
        case EROFS:
            return "; choose a folder that you may write to";
        case EFBIG:
            return "; the file system or a limit of the shell (ulimit -f) allows no larger file";
        default:
            return {};
    }
}

fs::path folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

/// Where a path leads: the target of a symbolic link, existing or not, else the path itself.
std::string resolved(const std::string& path) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) {
        return path;
    }
    const fs::path target = fs::weakly_canonical(path, error);
    return error ? path : target.string();
}

void require_folder(const std::string& path, const std::string& target) {
    const fs::path folder = folder_of(target);
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        throw Error("cannot write " + path + ": there is no folder " + folder.string() + "; create it first");
    }
}

void require_replaceable(const std::string& path, const std::string& target, bool overwrite) {
    struct stat status {};
    if (stat(target.c_str(), &status) != 0) {
        return;
    }
    if (S_ISDIR(status.st_mode)) {
        throw Error("cannot write " + path + ": it is a folder; name a file");
    }
    if (!S_ISREG(status.st_mode)) {
        throw Error("cannot write " + path +
                    ": it is not a regular file; outputs are written beside their place and renamed");
    }
    if (!overwrite) {
        throw Error(path + " exists; give `overwrite` to replace it");
    }
}

/// A name that nobody else uses: creation is exclusive, so a collision is seen and another name taken.
std::string random_name(const fs::path& target) {
    static constexpr char digits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
    std::random_device random;
    std::string name = ".terratet-";
    for (int i = 0; i < 12; ++i) {
        name += digits[random() % 36];
    }
    const std::string extension = target.extension().string();
    return extension.size() <= 16 ? name + extension : name;
}

/// Permissions as any new file gets them from the umask; those of the file that will be replaced when there is one.
int create_exclusively(const std::string& target, std::string& temporary) {
    for (int attempt = 0; attempt < 16; ++attempt) {
        temporary = (folder_of(target) / random_name(target)).string();
        const int descriptor = open(temporary.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EEXIST) {
            continue;
        }
        struct stat status {};
        if (descriptor >= 0 && stat(target.c_str(), &status) == 0) {
            // Not ours to change on some file systems; the umask's permissions do then.
            [[maybe_unused]] const int ignored = fchmod(descriptor, status.st_mode & 07777);
        }
        return descriptor;
    }
    return -1;
}

/// On the disk, not only in its cache. Some file systems have no fsync for folders: EINVAL is no loss there.
void sync_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) {
        return;
    }
    [[maybe_unused]] const int ignored = fsync(descriptor);
    ::close(descriptor);
}

/// \return errno, 0 when done.
int move_into_place(const std::string& from, const std::string& to, bool overwrite) {
    if (!overwrite) {
        if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
            return 0;
        }
        if (errno != EINVAL && errno != ENOSYS) {  // file systems that cannot tell: plain rename
            return errno;
        }
    }
    return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace

OutputFile::OutputFile(std::string path, bool overwrite)
    : path_(std::move(path)), target_(resolved(path_)), overwrite_(overwrite) {
    require_folder(path_, target_);
    require_replaceable(path_, target_, overwrite_);
    const std::lock_guard lock(outputs().mutex);
    const int descriptor = create_exclusively(target_, temporary_);
    if (descriptor < 0) {
        fail_writing(path_, errno);
    }
    file_ = fdopen(descriptor, "wb");
    if (!file_) {
        const int error = errno;
        ::close(descriptor);
        unlink(temporary_.c_str());
        fail_writing(path_, error);
    }
    outputs().temporaries.insert(temporary_);
    std::setvbuf(file_, nullptr, _IOFBF, buffer_size);
}

OutputFile::~OutputFile() {
    if (file_) {
        std::fclose(file_);
    }
    const std::lock_guard lock(outputs().mutex);
    outputs().temporaries.erase(temporary_);
    if (!committed_) {
        unlink(temporary_.c_str());
    }
}

void OutputFile::write(std::span<const std::byte> bytes) {
    assert(file_ && "write after close");
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
        fail_writing(path_, errno);
    }
}

void OutputFile::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void OutputFile::close() {
    if (file_ && std::fclose(std::exchange(file_, nullptr)) != 0) {
        fail_writing(path_, errno);
    }
}

std::uint64_t OutputFile::commit() {
    assert(!committed_ && "committed twice");
    close();
    // Opened again, since a library may have replaced the file behind our descriptor.
    const int descriptor = open(temporary_.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) {
        fail_writing(path_, errno);
    }
    struct stat status {};
    const bool synced = fsync(descriptor) == 0 && fstat(descriptor, &status) == 0;
    const int error = errno;
    ::close(descriptor);
    if (!synced) {
        fail_writing(path_, error);
    }
    const std::lock_guard lock(outputs().mutex);
    if (const int refused = move_into_place(temporary_, target_, overwrite_)) {
        if (refused == EEXIST) {
            throw Error(path_ + " exists now, though it did not before; give `overwrite` to replace it");
        }
        fail_writing(path_, refused);
    }
    committed_ = true;
    outputs().committed.push_back(path_);
    sync_folder(folder_of(target_));
    return static_cast<std::uint64_t>(status.st_size);
}

OutputFolder::OutputFolder(std::string path, bool overwrite) : path_(std::move(path)), overwrite_(overwrite) {
    require_folder(path_, path_);
    if (fs::exists(path_) && !overwrite_) {
        throw Error(path_ + " exists; give `overwrite` to replace it");
    }
    const std::lock_guard lock(outputs().mutex);
    temporary_ = (folder_of(path_) / random_name("")).string();
    if (mkdir(temporary_.c_str(), 0777) != 0) {
        fail_writing(path_, errno);
    }
    outputs().temporaries.insert(temporary_);
}

OutputFolder::~OutputFolder() {
    const std::lock_guard lock(outputs().mutex);
    outputs().temporaries.erase(temporary_);
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
}

void OutputFolder::write(const std::string& name, std::span<const std::string_view> parts) const {
    const fs::path path = fs::path(temporary_) / name;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    std::FILE* file = error ? nullptr : std::fopen(path.c_str(), "wbe");
    if (file == nullptr) {
        fail_writing(path_, error ? error.value() : errno);
    }
    int failed = 0;
    for (const std::string_view part : parts) {
        if (failed == 0 && std::fwrite(part.data(), 1, part.size(), file) != part.size()) {
            failed = errno;
        }
    }
    if (std::fclose(file) != 0 && failed == 0) {
        failed = errno;
    }
    if (failed != 0) {
        fail_writing(path_, failed);
    }
}

void OutputFolder::commit() {
    assert(!committed_ && "committed twice");
    const int descriptor = open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && syncfs(descriptor) == 0;
    const int error = errno;
    if (descriptor >= 0) {
        ::close(descriptor);
    }
    if (!synced) {
        fail_writing(path_, error);
    }
    const std::lock_guard lock(outputs().mutex);
    const std::string old = temporary_ + "-old";
    if (overwrite_ && fs::exists(path_) && std::rename(path_.c_str(), old.c_str()) != 0) {
        fail_writing(path_, errno);
    }
    if (const int refused = move_into_place(temporary_, path_, false)) {
        std::rename(old.c_str(), path_.c_str());
        fail_writing(path_, refused);
    }
    committed_ = true;
    std::error_code ignored;
    fs::remove_all(old, ignored);
    sync_folder(folder_of(path_));
}

std::vector<std::string> abandon_outputs() {
    outputs().mutex.lock();  // for good
    for (const std::string& temporary : outputs().temporaries) {
        for (const char* companion : {"", "-journal", "-wal", "-shm"}) {  // of a GeoPackage
            unlink((temporary + companion).c_str());
        }
        std::error_code ignored;
        if (fs::is_directory(temporary, ignored)) {
            fs::remove_all(temporary, ignored);
        }
    }
    return outputs().committed;
}

void fail_writing(const std::string& path, int error) {
    throw Error("cannot write " + path + ": " + std::generic_category().message(error) + advice(error));
}

void require_writable(const std::string& path, bool overwrite) {
    const std::string target = resolved(path);
    require_folder(path, target);
    require_replaceable(path, target, overwrite);
    if (access(folder_of(target).c_str(), W_OK) != 0) {
        fail_writing(path, errno);
    }
}

}  // namespace terratet
