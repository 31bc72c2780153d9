// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a vertex is, in words.

#include <string>

#include "tess/model.hpp"

namespace terratet {

inline const char* role_name(Role role) {
    switch (role) {
        case Role::sample:
            return "sample";
        case Role::seed:
            return "seed";
        case Role::domain:
            return "domain";
        case Role::inserted:
            return "inserted";
    }
    return "";
}

/// The borehole of a sample, the fault of a seed; empty for a vertex without either.
inline std::string owner_name(const Model& model, const Vertex& vertex) {
    if (vertex.owner < 0) {
        return {};
    }
    const auto owner = static_cast<std::size_t>(vertex.owner);
    if (vertex.role == Role::seed) {
        return model.barriers[owner].name;
    }
    const std::int32_t hole = vertex.role == Role::sample ? model.samples.borehole[owner] : -1;
    return hole < 0 ? std::string() : model.boreholes[static_cast<std::size_t>(hole)].id;
}

/// Properties some of whose samples are censored.
inline std::vector<std::size_t> censored_properties(const Model& model) {
    std::vector<std::size_t> censored;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (model.samples.censored_count(p) > 0) {
            censored.push_back(p);
        }
    }
    return censored;
}

/// Of a vertex's value: that of its sample; what is estimated is not.
inline Censoring censoring_of(const Model& model, const Vertex& vertex, std::size_t property) {
    return vertex.role == Role::sample ? model.samples.censoring(property, static_cast<std::size_t>(vertex.owner))
                                       : Censoring::none;
}

}  // namespace terratet
