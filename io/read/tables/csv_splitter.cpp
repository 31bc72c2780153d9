// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/csv_splitter.hpp"

#include <cpl_vsi.h>

#include <algorithm>
#include <cstring>

#include "io/base/gdal_scope.hpp"
#include "io/base/utf16.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::size_t chunk = 1U << 18U;
constexpr std::size_t longest_cell = (1U << 20U) - 1;
constexpr std::size_t longest_record = 1U << 26U;

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

}  // namespace

void CsvSplitter::Closer::operator()(void* file) const {
    VSIFCloseL(static_cast<VSILFILE*>(file));
}

CsvSplitter::CsvSplitter(std::string path) : path_(std::move(path)) {
    const GdalScope quiet(path_);
    file_.reset(VSIFOpenL(path_.c_str(), "rb"));
    if (!file_) {
        throw InputError(path_ + ": cannot be opened" + (quiet.failed() ? ": " + quiet.failure() : ""));
    }
    fill();
    begin_ = head().starts_with("\xEF\xBB\xBF") ? 3 : 0;
    set_separator(separator_);
}

void CsvSplitter::set_separator(char separator) {
    separator_ = separator;
    std::ranges::fill(kind_, static_cast<unsigned char>(0));
    kind_[static_cast<unsigned char>(separator)] = 1;
    kind_[static_cast<unsigned char>(separator == ' ' ? '\t' : separator)] = 1;
    kind_[static_cast<unsigned char>('\n')] = kind_[static_cast<unsigned char>('\r')] = 2;
}

void CsvSplitter::refuse(const std::string& what) const {
    throw InputError(path_ + ", line " + std::to_string(record_line_) + ": " + what);
}

/// More behind what is left. False when there is no more.
bool CsvSplitter::fill() {
    if (at_end_) {
        return false;
    }
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    if (end_ > longest_record) {
        refuse("the record is longer than 64 MiB; is a quotation mark not closed?");
    }
    const std::size_t wanted = std::max(chunk, end_);  // doubles, so that a long record is not read again and again
    buffer_.resize(std::max(buffer_.size(), end_ + wanted));
    const GdalScope quiet(path_);
    const std::size_t got = VSIFReadL(buffer_.data() + end_, 1, wanted, static_cast<VSILFILE*>(file_.get()));
    end_ += decode(got);
    if (quiet.failed()) {
        throw InputError(path_ + ": reading failed after line " + std::to_string(line_) + ": " + quiet.failure());
    }
    at_end_ = got == 0;  // less than wanted says nothing in an archive
    return got > 0;
}

std::size_t CsvSplitter::decode(std::size_t count) {
    const std::string_view raw(buffer_.data() + end_, count);
    if (encoding_ == Encoding::unknown) {
        encoding_ = raw.starts_with("\xFF\xFE")   ? Encoding::utf16_le
                    : raw.starts_with("\xFE\xFF") ? Encoding::utf16_be
                                                  : Encoding::bytes;
    }
    if (encoding_ == Encoding::bytes) {
        return count;
    }
    units_.insert(units_.end(), raw.begin(), raw.end());
    const std::string text = utf16_text(units_, encoding_ == Encoding::utf16_le);
    buffer_.resize(std::max(buffer_.size(), end_ + text.size()));
    std::ranges::copy(text, buffer_.begin() + static_cast<std::ptrdiff_t>(end_));
    return text.size();
}

/// From behind the opening mark to the separator or line end; `complete` is false when the buffer ends before.
std::string_view CsvSplitter::quoted_cell(std::size_t& i, bool& complete) {
    const std::size_t first = i;
    bool doubled = false;
    for (;;) {
        const auto* const mark = static_cast<const char*>(std::memchr(buffer_.data() + i, '"', end_ - i));
        complete = mark != nullptr;
        if (!complete) {
            return {};
        }
        const std::size_t close = static_cast<std::size_t>(mark - buffer_.data());
        if (close + 1 < end_ && buffer_[close + 1] == '"') {
            doubled = true;
            i = close + 2;
            continue;
        }
        i = close + 1;
        while (i < end_ && is_blank(buffer_[i]) && !ends_cell(buffer_[i])) {
            ++i;
        }
        complete = i < end_ || at_end_;
        if (!complete) {
            return {};
        }
        if (i == end_ || ends_cell(buffer_[i])) {
            const std::string_view cell(buffer_.data() + first, close - first);
            line_ += std::ranges::count(cell, '\n');
            if (!doubled) {
                return cell;
            }
            std::string& text = unquoted_.emplace_back();
            for (std::size_t k = 0; k < cell.size(); ++k) {
                text += cell[k];
                k += cell[k] == '"' && k + 1 < cell.size() && cell[k + 1] == '"' ? 1 : 0;
            }
            return text;
        }
        i = close + 1;  // a mark within the cell that nobody doubled
    }
}

bool CsvSplitter::split(std::vector<std::string_view>& cells) {
    cells.clear();
    unquoted_.clear();
    const bool merging = separator_ == ' ';
    const std::int64_t line = line_;
    std::size_t i = begin_;
    const auto incomplete = [&] {
        line_ = line;
        return false;
    };
    for (;;) {
        while (i < end_ && is_blank(buffer_[i]) && (merging || buffer_[i] != separator_)) {
            ++i;
        }
        std::string_view cell;
        if (i < end_ && buffer_[i] == '"') {
            ++i;
            bool complete = true;
            cell = quoted_cell(i, complete);
            if (!complete) {
                if (at_end_) {
                    refuse("a quotation mark begins a cell that does not end");
                }
                return incomplete();
            }
        } else {
            const std::size_t first = i;
            while (i < end_ && kind_[static_cast<unsigned char>(buffer_[i])] == 0) {
                ++i;
            }
            cell = {buffer_.data() + first, i - first};
        }
        if (i == end_ && !at_end_) {
            return incomplete();
        }
        while (!cell.empty() && is_blank(cell.back())) {
            cell.remove_suffix(1);
        }
        if (cell.size() > longest_cell) {
            refuse("a cell of more than 1 MiB; this is no table in text");
        }
        const bool last = i == end_ || kind_[static_cast<unsigned char>(buffer_[i])] == 2;
        if (!(merging && last && cell.empty() && !cells.empty())) {
            cells.push_back(cell);
        }
        if (last) {
            break;
        }
        ++i;
    }
    if (i < end_ && buffer_[i] == '\r') {
        if (i + 1 == end_ && !at_end_) {
            return incomplete();  // is it a CRLF?
        }
        i += i + 1 < end_ && buffer_[i + 1] == '\n' ? 1 : 0;
    }
    line_ += i < end_ ? 1 : 0;
    begin_ = std::min(i + 1, end_);
    return true;
}

bool CsvSplitter::next(std::vector<std::string_view>& cells) {
    for (;;) {
        while (begin_ == end_) {
            if (!fill()) {
                return false;
            }
        }
        record_line_ = line_;
        while (!split(cells)) {
            fill();
        }
        if (cells.size() > 1 || !cells.front().empty()) {
            return true;
        }
    }
}

}  // namespace terratet
