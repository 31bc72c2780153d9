// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RMS wells in ASCII (.rmswell, .w): version, a word, "NAME x y [rkb]", the number of logs, a line each log, rows of
// x y z and the logs' values. z is positive downwards; -999 is no value. Logs of class DISC carry their codes' names.
#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/base/lower_case.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/logs/well_file.hpp"
#include "io/read/logs/well_words.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

struct RmsLog {
    std::string name;
    bool discrete = false;
    std::map<std::string, std::string> codes;
};

class RmsReader {
  public:
    explicit RmsReader(const Source& source) : file_(source.describe()), path_(source.path), reader_(path_) {}

    WellFile read() {
        header();
        table_.add_column("MD", "");
        for (const RmsLog& log : logs_) {
            table_.add_column(log.name, "");
        }
        std::string_view line;
        while (reader_.next(line)) {
            row(trimmed(line));
        }
        return finish();
    }

  private:
    std::string_view next(const char* what) {
        std::string_view line;
        if (!reader_.next(line)) {
            throw InputError(fmt::format("{}: an RMS well that ends before {}", file_, what));
        }
        return trimmed(line);
    }

    void header() {
        next("its version");
        next("its description");
        std::string_view words = next("its name and place");
        hole_ = to_utf8(next_word(words));
        const auto count = whole_number<int>(next("the number of its logs"));
        if (!count || *count < 0 || *count > 10'000) {
            throw InputError(fmt::format("{}, line 4: no number of logs", file_));
        }
        for (int i = 0; i < *count; ++i) {
            std::string_view text = next("all of its logs are named");
            RmsLog log;
            log.name = to_utf8(next_word(text));
            log.discrete = lower_case(next_word(text)) == "disc";
            while (log.discrete) {
                const std::string code(next_word(text));
                if (code.empty()) {
                    break;
                }
                log.codes[code] = to_utf8(next_word(text));
            }
            md_ = md_ < 0 && is_depth(log.name) ? i : md_;
            logs_.push_back(std::move(log));
        }
    }

    static bool is_depth(const std::string& name) {
        const std::string key = bare(name);
        return key == "MD" || key == "MDEPTH" || key == "MEASUREDDEPTH" || key == "DEPT" || key == "DEPTH";
    }

    void row(std::string_view text) {
        std::vector<std::string_view> words;
        for (std::string_view word = next_word(text); !word.empty() && words.size() < logs_.size() + 4;
             word = next_word(text)) {
            words.push_back(word);
        }
        if (words.empty()) {
            return;
        }
        const auto number = [&](std::size_t at) {
            const auto value = at < words.size() ? whole_number<double>(words[at]) : std::nullopt;
            return value && std::isfinite(*value) ? value : std::nullopt;
        };
        const auto x = number(0);
        const auto y = number(1);
        const auto z = number(2);
        const auto md = md_ < 0 ? std::optional(0.0) : number(3 + static_cast<std::size_t>(md_));
        if (!x || !y || !z || !md || words.size() != logs_.size() + 3) {
            if (result_.rejected.size() < 1000) {
                result_.rejected.emplace_back(
                    reader_.number(),
                    fmt::format("{} numbers where 3 and {} logs are expected", words.size(), logs_.size()));
            }
            return;
        }
        const Vec3 point{*x, *y, -*z};
        double depth = *md;
        if (md_ < 0) {
            depth = path_points_.empty() ? 0 : depths_.back() + length(point - path_points_.back());
        }
        if (!depths_.empty() && !(depth > depths_.back())) {
            if (result_.rejected.size() < 1000) {
                result_.rejected.emplace_back(reader_.number(),
                                              fmt::format("depth {} is not below the one before", depth));
            }
            return;
        }
        if (depths_.empty() && depth < 0) {
            return;
        }
        depths_.push_back(depth);
        path_points_.push_back(point);
        std::vector<std::string> cells{fmt::format("{}", depth)};
        for (std::size_t i = 0; i < logs_.size(); ++i) {
            cells.push_back(cell(logs_[i], words[i + 3]));
        }
        table_.add_row(cells, reader_.number(), reader_.bytes());
    }

    static std::string cell(const RmsLog& log, std::string_view word) {
        const auto value = whole_number<double>(word);
        if (value && std::abs(*value + 999) < 0.5) {
            return {};
        }
        const auto named = log.codes.find(std::string(word));
        return named != log.codes.end() ? named->second : log_cell(word);
    }

    WellFile finish() {
        Table table = table_.finish();
        result_.format = "RMS well";
        if (table.rows() == 0) {
            throw InputError(file_ + ": is an RMS well and has no row of data");
        }
        result_.facts.emplace_back("well", hole_);
        const Vec3 first = path_points_.front();
        result_.collars = collar_table(file_);
        add_collar(result_.collars, hole_, fmt::format("{}", first.x), fmt::format("{}", first.y),
                   fmt::format("{}", first.z), "", 3);
        if (md_ < 0) {
            result_.notes.emplace_back("no log of measured depths: they are counted along its points from the first");
        }
        table.stated.meanings = {{Meaning::depth, 0}};
        if (md_ >= 0) {
            table.stated.asides.push_back(md_ + 1);
        }
        table.stated.hole_names = {hole_};
        table.stated.one_of_several = true;
        result_.logs.push_back(std::move(table));
        result_.paths.push_back({hole_, std::move(depths_), std::move(path_points_)});
        return std::move(result_);
    }

    std::string file_;
    std::string path_;
    LineReader reader_;
    std::string hole_;
    std::vector<RmsLog> logs_;
    int md_ = -1;
    std::vector<double> depths_;
    std::vector<Vec3> path_points_;
    LogTable table_{file_};
    WellFile result_;
};

}  // namespace

WellFile read_rms_well(const Source& source) {
    return RmsReader(source).read();
}

}  // namespace terratet
