// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/edit_options.hpp"

#include "tools/options/command_line.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {

const std::vector<std::string>& edit_verbs() {
    static const std::vector<std::string> verbs{
        "add-fault",   "remove-fault",   "replace-fault", "add-boreholes",  "remove-borehole", "move-borehole",
        "add-samples", "remove-samples", "set",           "set-resolution", "refine"};
    return verbs;
}

std::vector<OptionGroup> edit_options(EditArguments& a) {
    std::vector<OptionGroup> groups{
        {"What the verbs take",
         {
             {{"by"}, "DX,DY[,DZ]", "move-borehole: how far", &a.by},
             {{"to"}, "X,Y,Z", "move-borehole: where its collar goes", &a.to},
             {{"box"}, "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX", "refine: where", &a.box, 6},
             {{"lmin"}, "LENGTH", "refine: half of what is in force there by default", length_value(a.l_min)},
             {{"lmax"}, "LENGTH", "refine: half of what is in force there by default", length_value(a.l_max)},
         }},
    };
    for (OptionGroup& group : site_options(a.site)) {
        groups.push_back(std::move(group));
    }
    return groups;
}

EditArguments parse_edit(const std::vector<std::string>& words) {
    EditArguments arguments;
    Syntax syntax{"edit", edit_options(arguments), {"VERB", 1, 3, &arguments.words}};
    parse_arguments(syntax, words);
    return arguments;
}

}  // namespace terratet::tools
