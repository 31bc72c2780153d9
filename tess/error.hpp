// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The exceptions of the project: four kinds, for "cannot proceed" only. Dirty records are values (diagnostics.hpp);
/// misuse of an interface is an assert. The command line maps each kind to an exit code and nothing below it does.
///
/// A message names the file, the line or record, what was found, and what to do about it.

#include <stdexcept>

namespace terratet {

/// Root of the project's exceptions. Thrown as such for what fails while running: a write that fails, a bound that is
/// exceeded. Exit code 1.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The request contradicts itself or an option has no valid value. Exit code 2.
struct UsageError : Error {
    using Error::Error;
};

/// The input cannot be used: missing, unreadable, without CRS, without a usable record. Exit code 3.
struct InputError : Error {
    using Error::Error;
};

/// The caller's progress callback asked to stop. Nothing was written. Exit code 1.
struct Cancelled : Error {
    Cancelled() : Error("cancelled") {}
};

}  // namespace terratet
