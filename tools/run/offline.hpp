// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The program and the network.

#include <string>
#include <vector>

namespace terratet {
class Ranks;
}

namespace terratet::tools {

/// Unless the command line itself names something on a network, the system is asked to refuse this process every
/// internet socket: whatever a file says, and whichever library would follow it, nobody is called. PROJ_NETWORK=ON in
/// the environment is the user's own wish, for grids. Before any thread is started. Takes out unneeded drivers of GDAL
/// in any case.
void stay_offline(const std::vector<std::string>& arguments, const Ranks& ranks);

}  // namespace terratet::tools
