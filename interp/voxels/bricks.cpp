// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/bricks.hpp"

#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>

namespace terratet {
namespace {

struct InFlight {
    std::size_t number = 0;
    Brick brick;
    std::vector<std::unique_ptr<BrickPiece>> pieces;  ///< one a sink
};
using Token = std::shared_ptr<InFlight>;

}  // namespace

bool Brick::empty() const {
    return std::ranges::all_of(values, [](const auto& field) { return field.empty(); });
}

std::array<std::int64_t, 3> brick_counts(const Lattice& lattice) {
    std::array<std::int64_t, 3> count{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        count[axis] = (lattice.size[axis] + Brick::edge - 1) / Brick::edge;
    }
    return count;
}

void place_brick(const Lattice& lattice, std::size_t n, Brick& brick) {
    const auto count = brick_counts(lattice);
    const auto index = static_cast<std::int64_t>(n);
    const std::array<std::int64_t, 3> place{index % count[0], count[1] - 1 - index / count[0] % count[1],
                                            index / (count[0] * count[1])};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        brick.lo[axis] = place[axis] * Brick::edge;
        brick.size[axis] = static_cast<int>(std::min<std::int64_t>(Brick::edge, lattice.size[axis] - brick.lo[axis]));
    }
}

void stream_bricks(const BrickSource& source, std::span<BrickSink* const> sinks, const Progress& progress) {
    const auto counts = brick_counts(source.lattice());
    const auto total = static_cast<std::size_t>(counts[0] * counts[1] * counts[2]);
    const auto tokens = static_cast<std::size_t>(2 * tbb::info::default_concurrency()) + sinks.size();

    std::size_t next = 0;
    const auto begin =
        tbb::make_filter<void, Token>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> Token {
            if (next == total) {
                control.stop();
                return nullptr;
            }
            auto token = std::make_shared<InFlight>();
            token->number = next++;
            place_brick(source.lattice(), token->number, token->brick);
            return token;
        });
    const auto make = tbb::make_filter<Token, Token>(tbb::filter_mode::parallel, [&](Token token) {
        token->brick.values.assign(source.fields(), {});
        source.fill(token->brick);
        for (const BrickSink* sink : sinks) {
            token->pieces.push_back(sink->prepare(token->brick));
        }
        return token;
    });
    auto chain = begin & make;
    for (std::size_t s = 0; s < sinks.size(); ++s) {
        chain = chain & tbb::make_filter<Token, Token>(tbb::filter_mode::serial_in_order, [&, s](Token token) {
                    sinks[s]->put(token->brick, std::move(token->pieces[s]));
                    return token;
                });
    }
    const auto end = tbb::make_filter<Token, void>(tbb::filter_mode::serial_in_order, [&](const Token& token) {
        report_progress(progress, "resample", static_cast<double>(token->number + 1) / static_cast<double>(total));
    });
    tbb::parallel_pipeline(tokens, chain & end);
}

}  // namespace terratet
