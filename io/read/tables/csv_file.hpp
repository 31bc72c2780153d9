// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Tables in text, split into cells as the programs that write them mean it.

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/base/table.hpp"

namespace terratet {

struct CsvOptions {
    char separator = 0;            ///< 0: found from the first lines; ' ': runs of blanks and tabs
    std::optional<bool> header{};  ///< is the first record one? Not said: when no cell of it is a number, or it names
                                   ///< columns; the header may also stand below titles (header_rows.hpp)
};

/// Reads a table by RFC 4180, but a quotation mark within a cell that does not begin with one is a letter
/// (41°17'24"S). LF, CRLF or CR end lines; blank lines are none, and neither are lines with # before the header, of
/// which the last may be the header. A first line "sep=;" says the separator, records of empty cells are none. UTF-8
/// with or without byte-order mark, UTF-16 with one, else Windows-1252. Columns without header are field_1, field_2, ….
/// Cells beyond the header's are noted with their number and first line. One pass, a buffer of a record's length; about
/// 300 MB/s. Throws InputError: cannot be read, a cell of 1 MiB or more, a quotation mark that is not closed (with its
/// line).
Table read_csv_file(const std::string& path, const CsvOptions& options);

/// The same, some records at a time.
class CsvFile {
  public:
    CsvFile(const std::string& path, const CsvOptions& options);
    ~CsvFile();
    CsvFile(CsvFile&&) noexcept;

    /// Up to `most` further records, with the columns' names; none: at the end. The note comes with the last.
    Table next(std::size_t most = std::numeric_limits<std::size_t>::max());

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The separator that splits the lines at the beginning of a text most evenly: tab, semicolon, comma, bar, or blanks.
char separator_of(std::string_view head);

}  // namespace terratet
