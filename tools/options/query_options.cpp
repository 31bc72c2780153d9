// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/query_options.hpp"

#include "tools/options/command_line.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {

std::vector<OptionGroup> query_options(QueryArguments& a) {
    return {
        {"Where",
         {
             {{"at"}, "X,Y,Z", "a place in true coordinates, instead of a table; repeatable", &a.at},
             {{"k", "count"}, "K", "nearest: how many; 1 by default", &a.count},
             {{"d", "distance"},
              "LENGTH",
              "within: how far, in the model's unit or 20m, 65ft",
              length_value(a.distance, true)},
             {{"box"}, "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX", "box: the vertices in it", &a.box, 6},
             {{"borehole"}, "ID", "neighbours: those of a borehole's own vertices", &a.borehole},
             {{"plane"}, "X,Y,Z,NX,NY,NZ", "section: a plane through a point, with its normal", &a.plane},
             {{"step"}, "LENGTH", "line: between its rows; by default half of --lmin", length_value(a.step)},
             {{"above"}, "P=V", "region: the volume in which property P is at least V, too", &a.above},
             {{"s_srs", "source-crs"}, "CRS", "of the points, if they carry none; the model's by default", &a.crs},
             {{"columns"}, "MEANING=COLUMN", "a column not found by its name: x, y, z", &a.columns},
             {{"side"}, "+|-", "of a fault that a place lies exactly on; + by default", &a.side},
         }},
        {"Values",
         {
             {{"time"}, "T", "at that time alone, of a model built with --time-column", &a.time},
             {{"estimator"}, "SPEC", "instead of the model's own", &a.estimator},
             {{"probabilities"}, "", "of a category also each class's probability", &a.probabilities},
             {{"no-sd"}, "", "leave standard deviations and half-widths out: empty, and faster", &a.no_deviation},
         }},
    };
}

QueryArguments parse_query(const std::vector<std::string>& words) {
    QueryArguments arguments;
    const Syntax syntax{"query", query_options(arguments), {"VERB", 1, 2, &arguments.words}};
    parse_arguments(syntax, words);
    return arguments;
}

}  // namespace terratet::tools
