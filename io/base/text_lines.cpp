// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/text_lines.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <cstring>

#include "io/base/gdal_scope.hpp"
#include "io/base/utf16.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::size_t chunk = 1 << 16;
constexpr std::size_t longest_line = 1 << 20;

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

void LineReader::Closer::operator()(void* file) const {
    VSIFCloseL(static_cast<VSILFILE*>(file));
}

LineReader::LineReader(std::string path) : path_(std::move(path)) {
    const GdalScope quiet(path_);
    VSIStatBufL status;
    if (VSIStatExL(path_.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0 &&
        VSI_ISDIR(status.st_mode)) {
        throw InputError(path_ + ": it is a folder; name a file");
    }
    file_.reset(VSIFOpenL(path_.c_str(), "rb"));
    if (!file_) {
        throw InputError(path_ + ": cannot be opened" + (quiet.failed() ? ": " + quiet.failure() : "") +
                         "; does it exist?");
    }
}

LineReader::~LineReader() = default;

/// Reads more behind what is left. False when there is no more.
bool LineReader::fill() {
    if (at_end_) {
        return false;
    }
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
    if (end_ > longest_line) {
        throw InputError(path_ + ", line " + std::to_string(number_ + 1) +
                         ": longer than 1 MiB; this is not a text file of the expected kind");
    }
    buffer_.resize(std::max(buffer_.size(), end_ + 2 * chunk));  // UTF-16 grows by half at most
    const GdalScope quiet(path_);
    std::size_t got = VSIFReadL(buffer_.data() + end_, 1, chunk, static_cast<VSILFILE*>(file_.get()));
    bytes_ += got;
    if (got < chunk) {
        if (quiet.failed() || !VSIFEofL(static_cast<VSILFILE*>(file_.get()))) {
            throw InputError(path_ + ": reading failed after line " + std::to_string(number_) +
                             (quiet.failed() ? ": " + quiet.failure() : ""));
        }
        at_end_ = true;
    }
    if (encoding_ == Encoding::unknown) {
        const std::string_view head(buffer_.data() + end_, std::min<std::size_t>(got, 4));
        const bool wide = head.size() == 4;
        encoding_ =
            head.starts_with("\xFF\xFE") || (wide && head[0] != 0 && head[1] == 0 && head[2] != 0 && head[3] == 0)
                ? Encoding::utf16_le
            : head.starts_with("\xFE\xFF") || (wide && head[0] == 0 && head[1] != 0 && head[2] == 0 && head[3] != 0)
                ? Encoding::utf16_be
                : Encoding::bytes;
        begin_ = encoding_ == Encoding::bytes && head.starts_with("\xEF\xBB\xBF") ? end_ + 3 : begin_;
    }
    got = encoding_ == Encoding::bytes ? got : decode_utf16(end_, got);
    const std::size_t before = end_;
    end_ += got;
    end_lines_at_lone_cr(before);
    return !at_end_ || got > 0;
}

/// Replaces `count` bytes of UTF-16 from `begin` on by UTF-8, and returns how many bytes that is.
std::size_t LineReader::decode_utf16(std::size_t begin, std::size_t count) {
    const auto* const raw = reinterpret_cast<const unsigned char*>(buffer_.data() + begin);
    units_.insert(units_.end(), raw, raw + count);
    const std::string text = utf16_text(units_, encoding_ == Encoding::utf16_le);
    std::copy(text.begin(), text.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin));
    return text.size();
}

/// A CR that no LF follows ends a line too: it becomes one. `begin` is where the bytes read last begin; a CR before it
/// was left open.
void LineReader::end_lines_at_lone_cr(std::size_t begin) {
    std::size_t at = begin > begin_ && begin < end_ && buffer_[begin - 1] == '\r' ? begin - 1 : begin;
    while (at < end_) {
        const auto* const found = static_cast<const char*>(std::memchr(buffer_.data() + at, '\r', end_ - at));
        if (!found) {
            return;
        }
        at = static_cast<std::size_t>(found - buffer_.data());
        if (at + 1 < end_ && buffer_[at + 1] != '\n') {
            buffer_[at] = '\n';
        }
        ++at;
    }
}

bool LineReader::next(std::string_view& line) {
    std::size_t searched = begin_;
    for (;;) {
        const auto* const found =
            end_ > searched ? static_cast<const char*>(std::memchr(buffer_.data() + searched, '\n', end_ - searched))
                            : nullptr;
        const std::size_t unread = end_ - begin_;
        const std::size_t open = unread > 0 && buffer_[end_ - 1] == '\r' ? 1 : 0;  // perhaps the end of a line
        if (found || (!fill() && begin_ < end_)) {
            const char* const first = buffer_.data() + begin_;
            const char* const last = found ? found : buffer_.data() + end_;
            line = std::string_view(first, static_cast<std::size_t>(last - first));
            begin_ = static_cast<std::size_t>(last - buffer_.data()) + (found ? 1 : 0);
            terminated_ = found != nullptr;
            if (!line.empty() && line.back() == '\r') {
                line.remove_suffix(1);
            }
            ++number_;
            return true;
        }
        if (begin_ == end_ && at_end_) {
            return false;
        }
        searched = std::max(begin_, begin_ + unread - open);
    }
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

std::string_view next_word(std::string_view& text) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    if (!text.empty() && text.front() == '"') {
        if (const std::size_t close = text.find('"', 1); close != std::string_view::npos) {
            const std::string_view word = text.substr(1, close - 1);
            text.remove_prefix(close + 1);
            return word;
        }
    }
    const auto* const end = std::find_if(text.begin(), text.end(), is_blank);
    const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(word.size());
    return word;
}

std::string excerpt(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string result(text.substr(0, longest));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text.size() > longest ? result + "..." : result;
}

std::string to_utf8(std::string_view text) {
    std::string result(text);
    std::erase(result, '\0');
    if (CPLIsUTF8(result.c_str(), static_cast<int>(result.size()))) {
        return result;
    }
    const GdalScope quiet;  // it warns of bytes that Windows-1252 does not know
    char* const recoded = CPLRecode(result.c_str(), "CP1252", CPL_ENC_UTF8);
    result = recoded;
    CPLFree(recoded);
    return result;
}

}  // namespace terratet
