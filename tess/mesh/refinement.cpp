// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refinement.hpp"

namespace terratet {

std::string to_string(Reason reason) {
    switch (reason) {
        case Reason::none:
            return "none";
        case Reason::smooth:
            return "smooth";
        case Reason::too_close:
            return "too_close";
        case Reason::near_face:
            return "near_face";
        case Reason::near_fault:
            return "near_fault";
        case Reason::no_center:
            return "no_center";
        case Reason::fault_gap:
            return "fault_gap";
    }
    return "unknown";
}

}  // namespace terratet
