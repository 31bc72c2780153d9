// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a library throws while a file is read becomes an error that names the file.

#include <exception>
#include <new>
#include <string>

#include "tess/error.hpp"

namespace terratet {

/// What `read` returns. Our own errors and a lack of memory pass as they are.
template <class Read>
auto naming_file(const std::string& file, const Read& read) {
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file + ": a library failed to read it (" + error.what() + "); is the file damaged?");
    }
}

}  // namespace terratet
