// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/well_format.hpp"
#include "io/base/file_bytes.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "io/base/gdal_scope.hpp"
#include "io/base/lower_case.hpp"
#include "io/base/text_lines.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

/// What looks like a log and is none that is read here: said with what to do.
void refuse_strangers(const std::string& path, const std::string& head) {
    const auto refuse = [&](const std::string& what) { throw InputError(path + ": " + what); };
    const std::string extension = lower_case(CPLGetExtension(path.c_str()));
    if (head.starts_with("LASF") || (extension == "laz" && head.starts_with("LASF"))) {
        refuse(
            "is a LiDAR point cloud (LAS of the ASPRS), not a well log (LAS of the CWLS); a well log begins with "
            "~Version");
    }
    if (head.size() > 84 && (head.substr(4, 4) == "V1.0" || head.substr(4, 4) == "V2.0") &&
        head.substr(9, 6) == "RECORD") {
        refuse("is a DLIS file, which is not read; export its curves as LAS");
    }
    if (extension == "lis" || extension == "dlis") {
        refuse("is a " + extension + " file of binary records, which is not read; export its curves as LAS");
    }
    if (head.find("brocom") != std::string::npos || head.find("broservices") != std::string::npos ||
        head.find("bhrgtcommon") != std::string::npos || head.find("dsbhr") != std::string::npos) {
        refuse("is BRO-XML, which is not read; download the sounding or boring as GEF");
    }
    if (head.starts_with("# Petrel well tops")) {
        refuse("holds Petrel's well tops; export them as a table (CSV with the columns Well, MD, Surface)");
    }
    if (head.starts_with("# Type:") && head.find("# Version:") != std::string::npos) {
        refuse("is EarthVision's scattered data; save it as CSV with a header line of its fields");
    }
    if (head.starts_with("X ") && head.find("X ", 2) != std::string::npos && extension == "dat" &&
        std::isdigit(static_cast<unsigned char>(head[2])) != 0) {
        refuse("is Canstrat's lithology by punched cards, which is not read; export it as LAS 3 or CSV");
    }
    if (extension == "omf" || head.substr(0, 4) == "\x84\x83\x82\x81") {
        refuse("is an OMF file, which is not read; export its collars, surveys and assays as CSV");
    }
    if (extension == "geoh5" || extension == "gdb5") {
        refuse("is a geoh5 file, which is not read; export its drillholes as CSV");
    }
}

bool is_stream(const std::string& path) {
    return path.find("/vsistdin/") != std::string::npos;
}

/// RMS: a version, a word, a name with its place, and a whole number on the fourth line.
bool is_rms(const std::array<std::string, 4>& lines) {
    const auto version = whole_number<double>(lines[0]);
    std::string_view words = lines[2];
    const std::string_view name = next_word(words);
    const bool place = whole_number<double>(next_word(words)) && whole_number<double>(next_word(words));
    const auto count = whole_number<int>(lines[3]);
    return version && *version >= 1 && *version < 3 && !name.empty() && !whole_number<double>(name) && place && count &&
           *count >= 0;
}

WellFormat format_of_lines(const std::string& path) {
    LineReader reader(path);
    std::string_view line;
    std::array<std::string, 4> head;
    std::size_t filled = 0;
    for (int seen = 0; seen < 2000 && reader.next(line); ++seen) {
        const std::string_view text = trimmed(line);
        if (filled < head.size()) {
            head[filled++] = std::string(text);
        }
        const bool first_words = filled == 1;
        if (text.starts_with('~') && text.size() > 1 && std::isalpha(static_cast<unsigned char>(text[1])) != 0) {
            return WellFormat::las;
        }
        if (first_words && (text.starts_with("\"GROUP\"") || text.starts_with("GROUP,") || text.starts_with("\"**") ||
                            text.starts_with("**PROJ"))) {
            return WellFormat::ags;
        }
        if (text.starts_with("#GEFID")) {
            return WellFormat::gef;
        }
        if (first_words && text.starts_with("GOCAD")) {
            std::string_view words = text;
            next_word(words);
            return next_word(words) == "Well" ? WellFormat::gocad : WellFormat::none;
        }
        if (filled == head.size() && is_rms(head)) {
            return WellFormat::rms;
        }
        if (!text.empty() && text.front() != '#') {
            if (filled == head.size()) {
                return WellFormat::none;
            }
        } else if (filled > 0 && text.empty() && filled < head.size()) {
            --filled;  // a blank line is none of the four
        }
    }
    return WellFormat::none;
}

}  // namespace

WellFormat well_format(const std::string& path) {
    if (is_connection(path) || is_stream(path)) {
        return WellFormat::none;
    }
    const std::string head = file_bytes(path, 0, 2048);
    if (head.empty()) {
        return WellFormat::none;
    }
    refuse_strangers(path, head);
    const bool wide =
        head.find('\0') == 1 || head.find('\0') == 0 || head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF");
    if (head.find('\0') != std::string::npos && !wide) {
        return WellFormat::none;
    }
    try {
        return format_of_lines(path);
    } catch (const InputError&) {
        return WellFormat::none;
    }
}

}  // namespace terratet
