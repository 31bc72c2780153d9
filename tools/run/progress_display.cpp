// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/progress_display.hpp"

#include <unistd.h>
#include <algorithm>

#include <fmt/format.h>

#include "tools/run/interrupt.hpp"

namespace terratet::tools {

using namespace std::chrono_literals;

ProgressDisplay::ProgressDisplay(Style style, std::FILE* stream)
    : style_(style), stream_(stream), begin_(std::chrono::steady_clock::now()), drawn_(begin_) {}

ProgressDisplay::~ProgressDisplay() {
    if (bar_stands_) {
        std::fputs("\r\x1b[K", stream_);
        std::fflush(stream_);
    }
}

Progress ProgressDisplay::callback() {
    return [this](std::string_view stage, double fraction) {
        if (style_ == Style::bar) {
            draw_bar(stage, fraction);
        } else if (style_ == Style::lines) {
            write_line(stage, fraction);
        }
        return !interrupted();
    };
}

void ProgressDisplay::draw_bar(std::string_view stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (now - begin_ < 1s || now - drawn_ < 100ms) {
        return;
    }
    constexpr int width = 40;
    const int filled = static_cast<int>(width * std::clamp(fraction, 0.0, 1.0));
    const std::string line =
        fmt::format("\r\x1b[K{:14} [{}{}] {:3.0f} %", stage, std::string(static_cast<std::size_t>(filled), '='),
                    std::string(static_cast<std::size_t>(width - filled), ' '), 100 * fraction);
    std::fputs(line.c_str(), stream_);
    std::fflush(stream_);
    drawn_ = now;
    bar_stands_ = true;
}

void ProgressDisplay::write_line(std::string_view stage, double fraction) {
    const int hundredths = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
    if (stage == stage_ && hundredths == hundredths_) {
        return;
    }
    stage_ = stage;
    hundredths_ = hundredths;
    std::fputs(fmt::format("{{\"stage\":\"{}\",\"fraction\":{:.2f}}}\n", stage, hundredths / 100.0).c_str(), stream_);
    std::fflush(stream_);
}

ProgressDisplay::Style progress_style(ProgressStyle asked, bool quiet) {
    using Style = ProgressDisplay::Style;
    if (asked == ProgressStyle::automatic) {
        return isatty(STDERR_FILENO) == 1 && !quiet ? Style::bar : Style::none;
    }
    return asked == ProgressStyle::json ? Style::lines : Style::none;
}

}  // namespace terratet::tools
