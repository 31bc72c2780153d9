// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/site/input_files.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>

#include "io/base/gdal_scope.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

constexpr std::size_t most_files = 100'000;

bool is_pattern(const std::string& path) {
    return path.find_first_of("*?") != std::string::npos && !is_connection(path) && !path.starts_with("/vsicurl/");
}

/// * and ? in the last part of a path, without recursion: from the last star on, each text is tried once a letter.
bool matches(const std::string& name, const std::string& pattern) {
    std::size_t n = 0, p = 0, star = std::string::npos, after = 0;
    while (n < name.size()) {
        if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++n;
            ++p;
        } else if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            after = n;
        } else if (star != std::string::npos) {
            p = star + 1;
            n = ++after;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string::npos;
}

bool is_folder(const std::string& path) {
    if (is_connection(path) || EQUAL(CPLGetExtension(path.c_str()), "gdb") ||
        path.find("/vsistdin/") != std::string::npos) {
        return false;
    }
    const GdalScope quiet(path);
    VSIStatBufL status;
    return VSIStatL(path.c_str(), &status) == 0 && VSI_ISDIR(status.st_mode) != 0;
}

std::vector<std::string> names_in(const std::string& folder) {
    const GdalScope quiet(folder);
    std::vector<std::string> names;
    char** const entries = VSIReadDir(folder.c_str());
    for (char** entry = entries; entry != nullptr && *entry != nullptr && names.size() < most_files; ++entry) {
        if (**entry != '.') {
            names.emplace_back(*entry);
        }
    }
    CSLDestroy(entries);
    std::ranges::sort(names);
    return names;
}

}  // namespace

std::vector<Source> files_of(const Source& source) {
    const bool pattern = is_pattern(source.path);
    if (!pattern && !is_folder(source.path)) {
        return {source};
    }
    const std::string folder = pattern ? std::string(CPLGetPath(source.path.c_str())) : source.path;
    const std::string last = pattern ? CPLGetFilename(source.path.c_str()) : "*";
    std::vector<Source> files;
    for (const std::string& name : names_in(folder.empty() ? "." : folder)) {
        Source file = source;
        file.path = folder.empty() ? name : CPLFormFilename(folder.c_str(), name.c_str(), nullptr);
        if (matches(name, last) && !is_folder(file.path)) {
            files.push_back(std::move(file));
        }
    }
    if (files.empty()) {
        throw InputError(source.path + (pattern ? ": no file has such a name" : ": the folder has no file in it"));
    }
    return files;
}

}  // namespace terratet
