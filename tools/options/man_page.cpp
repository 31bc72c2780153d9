// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/man_page.hpp"

#include <fmt/format.h>

#include "tools/options/help.hpp"
#include "tools/version.hpp"

namespace terratet::tools {
namespace {

/// Backslashes and hyphens have a meaning in roff, as have dots and quotes that begin a line.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else if (c == '\n') {
            out += "\n\\&";
        } else {
            out += c;
        }
    }
    return out.empty() || (out[0] != '.' && out[0] != '\'') ? out : "\\&" + out;
}

std::string begun(const std::string& name, const std::string& summary) {
    return fmt::format(".TH \"{0}\" 1 \"\" \"terratet {1}\"\n.SH NAME\n{2} \\- {3}\n", escaped(name), version,
                       escaped(name), escaped(summary));
}

std::string exit_status() {
    return fmt::format(".SH EXIT STATUS\n.nf\n{}.fi\n", escaped(help_on("exit-codes")));
}

}  // namespace

std::string man_page(const CommandEntry& entry) {
    std::string out = begun("terratet-" + entry.name, entry.summary);
    out += fmt::format(".SH SYNOPSIS\n.B terratet {}\n{}\n.SH DESCRIPTION\n{}\n", escaped(entry.name),
                       escaped(entry.usage), escaped(entry.description));
    const auto command = entry.make();
    const Syntax syntax = command->syntax();
    out += syntax.groups.empty() ? "" : ".SH OPTIONS\n";
    for (const auto& group : syntax.groups) {
        out += fmt::format(".SS {}\n", escaped(group.title));
        for (const auto& option : group.options) {
            std::string names;
            for (const auto& name : option.names) {
                names += (names.empty() ? "" : ", ") + fmt::format("\\fB{}\\fR", escaped(dashed(name)));
            }
            out += fmt::format(".TP\n{} {}\n{}\n", names, escaped(option.value), escaped(help_text(option)));
        }
    }
    out += exit_status() + ".SH EXAMPLES\n.nf\n";
    for (const auto& example : entry.examples) {
        out += escaped(example) + "\n";
    }
    return out + ".fi\n.SH SEE ALSO\n.BR terratet (1)\n";
}

std::string man_page() {
    std::string out = begun("terratet", "boreholes and faults to adaptive 3D tessellations");
    out +=
        ".SH SYNOPSIS\n.B terratet\nCOMMAND …\n.SH DESCRIPTION\nFrom borehole logs and faults to an adaptive "
        "Delaunay tessellation of the ground.\n.SH COMMANDS\n";
    for (const auto& entry : commands()) {
        out += fmt::format(".TP\n.BR terratet\\-{} (1)\n{}\n", escaped(entry.name), escaped(entry.summary));
    }
    return out + exit_status();
}

}  // namespace terratet::tools
