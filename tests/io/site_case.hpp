// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Sites from tables that tests write, and what was said while reading them.

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "io/read_site.hpp"
#include "support.hpp"
#include "tess/error.hpp"

namespace terratet::testing {

inline std::string written(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

/// A site with what was said while reading it.
struct Read {
    Site site;
    Diagnostics diagnostics;
    ReadCounts counts;

    [[nodiscard]] bool noted(const std::string& text) const {
        return std::ranges::any_of(diagnostics.notes,
                                   [&](const std::string& note) { return note.find(text) != std::string::npos; });
    }
    /// Lines of rejections with this in their reason.
    [[nodiscard]] std::vector<std::int64_t> rejected(const std::string& text = "") const {
        std::vector<std::int64_t> lines;
        for (const Rejected& rejection : diagnostics.rejected) {
            if (rejection.reason.find(text) != std::string::npos) {
                lines.push_back(rejection.line);
            }
        }
        return lines;
    }
    [[nodiscard]] Vec3 world(std::size_t sample) const { return site.frame.to_world(site.samples.positions[sample]); }
};

inline Read read(const SiteInputs& inputs) {
    Read result;
    result.site = read_site(inputs, result.diagnostics, result.counts);
    return result;
}

inline std::string error_of(const SiteInputs& inputs) {
    try {
        read(inputs);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

/// Collars, surveys and logs given as text, in a local frame unless told otherwise.
class Case {
  public:
    SiteInputs inputs;

    Case() { inputs.source_crs = "local"; }
    Case& collars(const std::string& text) { return add(inputs.boreholes, "collars", text); }
    Case& survey(const std::string& text) { return add(inputs.surveys, "survey", text); }
    Case& log(const std::string& text) { return add(inputs.logs, "log", text); }
    Case& samples(const std::string& text) { return add(inputs.samples, "samples", text); }
    Case& faults(const std::string& text) { return add(inputs.faults, "faults", text); }

  private:
    Case& add(std::vector<Source>& sources, const std::string& name, const std::string& text) {
        sources.push_back({written(folder_ / (name + std::to_string(sources.size()) + ".csv"), text)});
        return *this;
    }
    TemporaryFolder folder_;
};

inline bool near(const Vec3& a, const Vec3& b, double tolerance) {
    return distance(a, b) <= tolerance;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

inline bool same(const Site& a, const Site& b) {
    const auto same_hole = [](const Borehole& p, const Borehole& q) {
        return p.id == q.id && p.collar == q.collar && p.path == q.path && p.path_depth == q.path_depth;
    };
    return a.frame == b.frame && a.properties == b.properties &&
           std::ranges::equal(a.boreholes, b.boreholes, same_hole) && a.samples.positions == b.samples.positions &&
           a.samples.borehole == b.samples.borehole && same_bits(a.samples.depth, b.samples.depth) &&
           same_bits(a.samples.length, b.samples.length) &&
           std::ranges::equal(a.samples.values, b.samples.values, same_bits) &&
           a.samples.censored == b.samples.censored && a.surfaces == b.surfaces;
}

/// The same text with its rows, but not its header, in another order.
inline std::string shuffled(const std::string& text, Random& random) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    for (std::size_t i = lines.size() - 1; i > 1; --i) {
        std::swap(lines[i], lines[1 + random.below(i)]);
    }
    std::string result;
    for (const std::string& line : lines) {
        result += line + "\n";
    }
    return result;
}

inline std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline constexpr const char* two_collars = "BHID,X,Y,Z\nA,100,200,50\nB,300,400,60\n";

}  // namespace terratet::testing
