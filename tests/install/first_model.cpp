// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_source.hpp"
#include "io/export.hpp"
#include "io/read_site.hpp"
#include "tess/build.hpp"

using namespace terratet;

// first_model SAMPLES.csv OUTPUT.vtu: the program of the README.
int main(int, char** argv) {
    SiteInputs inputs{.samples = {parse_source(argv[1])}, .source_crs = "EPSG:3067"};
    Diagnostics diagnostics;
    ReadCounts counts;
    BuildReport report;
    const auto natural = [](const Model& m, const FaultProximity& faults) { return make_model_source(m, faults, {}); };
    const Model model = build(read_site(inputs, diagnostics, counts), {}, natural, report);
    const TetMesh mesh = tessellate(model).mesh();
    export_model({model, mesh, describe_cells(model, mesh)}, argv[2], {});
}
