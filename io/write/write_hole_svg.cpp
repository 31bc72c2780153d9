// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/write_hole_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/base/output_file.hpp"
#include "io/style/markup.hpp"

namespace terratet {

namespace {

constexpr double top = 70;
constexpr double height = 560;
constexpr double left = 70;
constexpr double column_width = 60;
constexpr double column_gap = 24;
constexpr std::size_t most_rows = 40;
constexpr std::size_t most_intervals = 5000;

/// Of a path the name alone.
std::string short_name(const std::string& file) {
    const std::size_t slash = file.rfind('/');
    return slash == std::string::npos ? file : file.substr(slash + 1);
}

double round_step(double span) {
    const double power = std::pow(10, std::floor(std::log10(span / 8)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (span / (step * power) <= 10) {
            return step * power;
        }
    }
    return 10 * power;
}

class Drawing {
  public:
    Drawing(const HoleQuality& quality, const HoleRecord& hole) : quality_(quality), hole_(hole) {
        deepest_ = hole.length_m;
        for (const auto& [file, intervals] : hole.logs) {
            for (const LoggedInterval& interval : intervals) {
                deepest_ = std::max(deepest_, interval.to);
            }
        }
        for (const SurveyStation& station : hole.stations) {
            deepest_ = std::max(deepest_, std::min(station.depth, hole.length_m > 0 ? hole.length_m : station.depth));
        }
        deepest_ = deepest_ > 0 ? deepest_ : 1;
    }

    std::string text() {
        axis();
        double x = left;
        for (const auto& [file, intervals] : hole_.logs) {
            log(x, file, intervals);
            x += column_width + column_gap;
        }
        track(x, "dip", -90, 90, [](const SurveyStation& s) { return 90 - s.inclination_deg; });
        track(x + 110, "azimuth", 0, 360,
              [](const SurveyStation& s) { return std::fmod(std::fmod(s.azimuth_deg, 360) + 360, 360); });
        x += 220;
        const double bottom = words();
        const double width = std::max(x + 20, 760.0);
        return fmt::format(
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
                   "{0:.0f} "
                   "{1:.0f}\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" "
                   "fill=\"white\"/>\n<text x=\"{2}\" y=\"24\" font-size=\"16\">{3}: {4} findings</text>\n",
                   width, bottom, left, markup_text(hole_.id), hole_.findings) +
               body_ + "</svg>\n";
    }

  private:
    [[nodiscard]] double y(double depth) const { return top + height * std::clamp(depth / deepest_, 0.0, 1.0); }

    void line(double x1, double y1, double x2, double y2, const char* color) {
        body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1,
                             x2, y2, color);
    }

    void box(double x, double from, double to, const char* style) {
        body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" {}/>\n", x, y(from),
                             column_width, std::max(y(to) - y(from), 0.6), style);
    }

    void label(double x, double at, const std::string& text, const char* anchor = "start") {
        body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, at, anchor,
                             markup_text(text));
    }

    void axis() {
        const double step = round_step(deepest_);
        for (double depth = 0; depth <= deepest_ * (1 + 1e-9); depth += step) {
            line(left - 14, y(depth), left - 8, y(depth), "black");
            label(left - 18, y(depth) + 4, fmt::format("{:g}", depth), "end");
        }
        line(left - 8, top, left - 8, top + height, "black");
        label(left - 18, top - 14, "m", "end");
    }

    void log(double x, const std::string& file, const std::vector<LoggedInterval>& intervals) {
        label(x, top - 10, short_name(file).substr(0, 14));
        box(x, 0, deepest_, "fill=\"none\" stroke=\"#bbb\"");
        const std::size_t stride = intervals.size() / most_intervals + 1;
        for (std::size_t i = 0; i < intervals.size(); i += stride) {
            box(x, intervals[i].from, intervals[i].to, "fill=\"#9ecae1\" stroke=\"#6baed6\" stroke-width=\"0.4\"");
        }
        for (const HoleFinding& finding : quality_.findings) {
            if (finding.hole != hole_.id || finding.file != file || std::isnan(finding.from)) {
                continue;
            }
            const char* style =
                finding.defect == HoleDefect::gap       ? "class=\"gap\" fill=\"#d62728\" fill-opacity=\"0.55\""
                : finding.defect == HoleDefect::overlap ? "class=\"overlap\" fill=\"#ff7f0e\" fill-opacity=\"0.8\""
                : finding.defect == HoleDefect::beyond_length ? "class=\"beyond\" fill=\"#9467bd\" fill-opacity=\"0.5\""
                                                              : "class=\"other\" fill=\"#8c564b\" fill-opacity=\"0.7\"";
            box(x, finding.from, finding.to, style);
        }
    }

    template <typename Value>
    void track(double x, const char* name, double lo, double hi, const Value& value) {
        label(x, top - 10, fmt::format("{} {:g}° … {:g}°", name, lo, hi));
        body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{}\" width=\"90\" height=\"{}\" fill=\"none\" stroke=\"#bbb\"/>\n",
                             x, top, height);
        std::string points;
        for (const SurveyStation& station : hole_.stations) {
            const double px = x + 90 * (value(station) - lo) / (hi - lo);
            points += fmt::format("{:.1f},{:.2f} ", px, y(station.depth));
            body_ +=
                fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.2f}\" r=\"2\" fill=\"#2ca02c\"/>\n", px, y(station.depth));
        }
        body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#2ca02c\"/>\n", points);
        for (const HoleFinding& finding : quality_.findings) {
            if (finding.hole == hole_.id && finding.defect == HoleDefect::kink) {
                body_ += fmt::format(
                    "<rect class=\"kink\" x=\"{:.1f}\" y=\"{:.2f}\" width=\"90\" height=\"{:.2f}\" fill=\"#d62728\" "
                    "fill-opacity=\"0.35\"/>\n",
                    x, y(finding.from), std::max(y(finding.to) - y(finding.from), 1.0));
            }
        }
    }

    /// The findings in words; returns where the picture ends.
    double words() {
        double at = top + height + 30;
        std::size_t shown = 0;
        for (const HoleFinding& finding : quality_.findings) {
            if (finding.hole != hole_.id || shown++ >= most_rows) {
                continue;
            }
            label(left, at,
                  fmt::format(
                      "{}: {}{}", to_string(finding.defect), finding.text,
                      finding.line > 0 ? fmt::format(" ({}, line {})", short_name(finding.file), finding.line) : ""));
            at += 15;
        }
        if (shown > most_rows) {
            label(left, at, fmt::format("and {} more", shown - most_rows));
            at += 15;
        }
        return at + 10;
    }

    const HoleQuality& quality_;
    const HoleRecord& hole_;
    double deepest_ = 0;
    std::string body_;
};

}  // namespace

std::string hole_svg(const HoleQuality& quality, const HoleRecord& hole) {
    return Drawing(quality, hole).text();
}

void write_hole_svg(const HoleQuality& quality, const HoleRecord& hole, const std::string& path, bool overwrite) {
    OutputFile file(path, overwrite);
    file.write(hole_svg(quality, hole));
    file.commit();
}

}  // namespace terratet
