// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/live_model.hpp"
#include "io/export.hpp"
#include "io/model_store.hpp"

// without_fault MODEL.gpkg FAULT OUTPUT: a stored model without one of its faults.
int main(int, char** argv) {
    using namespace terratet;
    LiveModel model(load_model(argv[1]));
    model.remove_surface(argv[2]);
    export_model(model, argv[3]);
}
