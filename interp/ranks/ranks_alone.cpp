// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Without MPI.

#include "interp/ranks/ranks.hpp"

namespace terratet {

struct Ranks::Impl {};

Ranks::Ranks() = default;
Ranks::~Ranks() = default;

bool Ranks::available() {
    return false;
}

int Ranks::rank() const {
    return 0;
}

int Ranks::count() const {
    return 1;
}

void Ranks::send(std::string) const {}

std::string Ranks::receive(int) const {
    return {};
}

std::string Ranks::broadcast(std::string bytes) const {
    return bytes;
}

std::vector<std::string> Ranks::exchange(std::string bytes) const {
    return {std::move(bytes)};
}

RankOutcome Ranks::finish(RankOutcome own) const {
    return own;
}

}  // namespace terratet
