// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What LeakSanitizer lets pass in every program of a sanitized build: GDAL keeps its table of drivers, fontconfig its
/// fonts for the life of the process, by design, and HDF5 some bytes of a file that it could not write. Leaks of our
/// own stay errors.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the sanitizer asks for these names.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_options();

const char* __lsan_default_suppressions() {
    return "leak:libgdal\nleak:libfontconfig\nleak:libhdf5\n";
}

const char* __lsan_default_options() {
    return "print_suppressions=0";
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
