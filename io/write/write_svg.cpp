// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/write_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/base/output_file.hpp"
#include "io/style/markup.hpp"

namespace terratet {
namespace {

constexpr double panel_width = 380;
constexpr double panel_height = 330;
constexpr double left = 62;
constexpr double right = 14;
constexpr double top = 30;
constexpr double bottom = 46;
constexpr std::size_t dots_max = 3000;
constexpr std::size_t columns = 3;
// Told apart with any colour vision (Okabe and Ito).
constexpr std::array colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

struct Range {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();

    void add(double v) {
        lo = std::min(lo, v);
        hi = std::max(hi, v);
    }
    /// Never empty, with a little room.
    void settle(bool from_zero) {
        if (!(lo <= hi)) {
            *this = {0, 1};
        }
        if (from_zero) {
            add(0);
        }
        const double room = hi > lo ? 0.04 * (hi - lo) : std::max(std::abs(lo), 1.0) / 2;
        lo -= from_zero && lo == 0 ? 0 : room;
        hi += room;
    }
};

/// 1, 2 or 5 times a power of ten, for four to eight ticks.
double tick_step(const Range& range) {
    const double rough = (range.hi - range.lo) / 5;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (rough <= digit * power) {
            return digit * power;
        }
    }
    return 10 * power;
}

class Panel {
  public:
    Panel(const Chart& chart, double x, double y) : chart_(chart), x0_(x), y0_(y) {
        for (const auto& series : chart.series) {
            for (const auto& [px, py] : series.points) {
                if (std::isfinite(px) && std::isfinite(py)) {
                    x_.add(px);
                    y_.add(py);
                }
            }
        }
        if (chart.square) {
            x_.add(y_.lo);
            x_.add(y_.hi);
            y_ = x_;
        }
        x_.settle(chart.from_zero);
        y_.settle(chart.from_zero);
    }

    [[nodiscard]] std::string text() const {
        std::string out = axes();
        if (chart_.square) {
            out += polyline({{x_.lo, x_.lo}, {x_.hi, x_.hi}}, "#999", "4 3");
        }
        std::size_t legend_row = 0;
        for (std::size_t s = 0; s < chart_.series.size(); ++s) {
            const auto& series = chart_.series[s];
            const char* color = colors[s % colors.size()];
            out += drawn(series, color);
            if (!series.label.empty()) {
                const double y = y0_ + top + 12 + 14 * static_cast<double>(legend_row++);
                out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"10\" height=\"4\" fill=\"{}\"/>",
                                   x0_ + left + 8, y - 5, color);
                out += label(x0_ + left + 22, y, "start", series.label);
            }
        }
        return out;
    }

  private:
    [[nodiscard]] double px(double v) const {
        return x0_ + left + (v - x_.lo) / (x_.hi - x_.lo) * (panel_width - left - right);
    }
    [[nodiscard]] double py(double v) const {
        return y0_ + panel_height - bottom - (v - y_.lo) / (y_.hi - y_.lo) * (panel_height - top - bottom);
    }

    static std::string label(double x, double y, const char* anchor, const std::string& text, const char* extra = "") {
        return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, extra,
                           markup_text(text));
    }

    [[nodiscard]] std::string axes() const {
        const double x_end = x0_ + panel_width - right;
        const double y_end = y0_ + panel_height - bottom;
        std::string out = fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n",
            x0_ + left, y0_ + top, panel_width - left - right, panel_height - top - bottom);
        const double x_step = tick_step(x_);
        for (double k = std::ceil(x_.lo / x_step); k * x_step <= x_.hi; ++k) {
            out += fmt::format("<path d=\"M{0:.1f} {1:.1f}v4\" stroke=\"#444\"/>", px(k * x_step), y_end);
            out += label(px(k * x_step), y_end + 16, "middle", fmt::format("{:.6g}", k * x_step + 0.0));
        }
        const double y_step = tick_step(y_);
        for (double k = std::ceil(y_.lo / y_step); k * y_step <= y_.hi; ++k) {
            out += fmt::format("<path d=\"M{0:.1f} {1:.1f}h-4\" stroke=\"#444\"/>", x0_ + left, py(k * y_step));
            out += label(x0_ + left - 7, py(k * y_step) + 4, "end", fmt::format("{:.6g}", k * y_step + 0.0));
        }
        out += label(0.5 * (x0_ + left + x_end), y0_ + top - 10, "middle", chart_.title, " font-weight=\"bold\"");
        out += label(0.5 * (x0_ + left + x_end), y_end + 34, "middle", chart_.x_label);
        const double middle = 0.5 * (y0_ + top + y_end);
        out += label(x0_ + 14, middle, "middle", chart_.y_label,
                     fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", x0_ + 14, middle).c_str());
        return out;
    }

    [[nodiscard]] std::string polyline(const std::vector<std::pair<double, double>>& points, const char* color,
                                       const char* dashes) const {
        std::string path;
        for (const auto& [x, y] : points) {
            if (std::isfinite(x) && std::isfinite(y)) {
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px(x), py(y));
            }
        }
        return path.empty() ? ""
                            : fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-dasharray=\"{}\"/>\n",
                                          path, color, dashes);
    }

    [[nodiscard]] std::string drawn(const ChartSeries& series, const char* color) const {
        using Style = ChartSeries::Style;
        if (series.style == Style::line || series.style == Style::dashes) {
            return polyline(series.points, color, series.style == Style::line ? "none" : "5 3");
        }
        const bool dots = series.style == Style::dots;
        const std::size_t step = dots ? (series.points.size() + dots_max - 1) / dots_max : 1;
        std::string path;
        for (std::size_t i = 0; i < series.points.size(); i += std::max<std::size_t>(step, 1)) {
            const auto& [x, y] = series.points[i];
            if (std::isfinite(x) && std::isfinite(y)) {
                path += fmt::format("M{:.1f} {:.1f}h0", px(x), py(y));
            }
        }
        return path.empty() ? ""
                            : fmt::format(
                                  "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" "
                                  "stroke-opacity=\"{}\"/>\n",
                                  path, color, dots ? 2.4 : 6.0, dots ? 0.35 : 0.9);
    }

    const Chart& chart_;
    double x0_;
    double y0_;
    Range x_;
    Range y_;
};

}  // namespace

std::string svg_text(const std::vector<Chart>& charts) {
    const std::size_t across = std::min(columns, std::max<std::size_t>(charts.size(), 1));
    const std::size_t down = (charts.size() + across - 1) / across;
    const double width = panel_width * static_cast<double>(across);
    const double height = panel_height * static_cast<double>(down);
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height);
    for (std::size_t i = 0; i < charts.size(); ++i) {
        out += Panel(charts[i], panel_width * static_cast<double>(i % across),
                     panel_height * static_cast<double>(i / across))
                   .text();
    }
    return out + "</svg>\n";
}

void write_svg(const std::vector<Chart>& charts, const std::string& path, bool overwrite) {
    OutputFile file(path, overwrite);
    file.write(svg_text(charts));
    file.commit();
}

}  // namespace terratet
