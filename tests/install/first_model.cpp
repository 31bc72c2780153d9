// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "interp/live_model.hpp"
#include "io/export.hpp"
#include "io/read_site.hpp"

// first_model COLLAR.csv LOG.csv OUTPUT: what `terratet convert` does, a value, and who is next to a borehole.
int main(int, char** argv) {
    using namespace terratet;
    Diagnostics said;
    const LiveModel model(read_site({.boreholes = {{argv[1]}}, .logs = {{argv[2]}}, .source_crs = "EPSG:3067"}, said));
    export_model(model, argv[3]);
    const Vec3 place = model.model().frame.to_local({525520, 6792020, -25});
    std::cout << model.value_at(place)[0] << '\n' << model.neighbours_of("B12").size() << '\n';
}
