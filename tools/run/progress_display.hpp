// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Shows progress on standard error and passes an interrupt on.

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "tess/progress.hpp"
#include "tools/options/run_options.hpp"

namespace terratet::tools {

class ProgressDisplay {
  public:
    enum class Style {
        none,
        bar,    ///< one line that is drawn anew, from the first second on
        lines,  ///< {"stage":"refine","fraction":0.25}, at every hundredth
    };

    ProgressDisplay(Style style, std::FILE* stream);
    ~ProgressDisplay();  ///< clears the bar
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// Says to stop once interrupted() holds. The display must outlive the callback.
    [[nodiscard]] Progress callback();

  private:
    void draw_bar(std::string_view stage, double fraction);
    void write_line(std::string_view stage, double fraction);

    Style style_;
    std::FILE* stream_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point drawn_;
    std::string stage_;
    int hundredths_ = -1;
    bool bar_stands_ = false;
};

/// auto: a bar when standard error is a terminal and `quiet` is not asked for.
ProgressDisplay::Style progress_style(ProgressStyle asked, bool quiet);

}  // namespace terratet::tools
