// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/bricks.hpp"

#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "interp/ranks/bytes.hpp"
#include "interp/ranks/ranks.hpp"

namespace terratet {
namespace {

struct InFlight {
    std::size_t number = 0;
    Brick brick;
    std::vector<std::unique_ptr<BrickPiece>> pieces;  ///< one a sink
    std::string message;                              ///< to or from another rank
};
using Token = InFlight*;
using Sinks = std::span<BrickSink* const>;

/// Owns what is in flight: a pipeline that ends by an exception forgets what is in it.
class Flight {
  public:
    explicit Flight(const BrickSource& source) : source_(source) {}

    Token begin(std::size_t number) {
        auto made = std::make_unique<InFlight>();
        const Token token = made.get();
        token->number = number;
        place_brick(source_.lattice(), number, token->brick);
        const std::lock_guard lock(mutex_);
        all_.emplace(number, std::move(made));
        return token;
    }
    void end(Token token) {
        const std::lock_guard lock(mutex_);
        all_.erase(token->number);
    }

  private:
    const BrickSource& source_;
    std::mutex mutex_;
    std::map<std::size_t, std::unique_ptr<InFlight>> all_;  ///< by number
};

void make_brick(const BrickSource& source, Brick& brick) {
    brick.values.assign(source.fields(), {});
    source.fill(brick);
}

std::size_t total_bricks(const BrickSource& source) {
    const auto counts = brick_counts(source.lattice());
    return static_cast<std::size_t>(counts[0] * counts[1] * counts[2]);
}

std::size_t most_in_flight(Sinks sinks) {
    return static_cast<std::size_t>(2 * tbb::info::default_concurrency()) + sinks.size();
}

/// A brick for rank 0: the pieces of portable sinks, and the values if a sink is not.
std::string packed(const Brick& brick, Sinks sinks) {
    ByteWriter out;
    const bool with_values = !std::ranges::all_of(sinks, &BrickSink::portable);
    for (const auto& values : brick.values) {
        out.put(with_values ? values : std::vector<float>{});
    }
    for (const BrickSink* sink : sinks) {
        if (sink->portable()) {
            out.put(sink->to_bytes(*sink->prepare(brick)));
        }
    }
    return out.take();
}

void unpack(std::size_t fields, Sinks sinks, InFlight& token) {
    ByteReader in(token.message);
    for (std::size_t f = 0; f < fields; ++f) {
        token.brick.values.push_back(in.list<float>());
    }
    for (const BrickSink* sink : sinks) {
        token.pieces.push_back(sink->portable() ? sink->from_bytes(in.text()) : sink->prepare(token.brick));
    }
    token.message.clear();
}

/// Another rank's part.
void send_bricks(const BrickSource& source, Sinks sinks, const Progress& progress, const Ranks& ranks) {
    const std::size_t total = total_bricks(source);
    Flight flight(source);
    auto next = static_cast<std::size_t>(ranks.rank());
    const auto begin =
        tbb::make_filter<void, Token>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> Token {
            if (next >= total) {
                control.stop();
                return nullptr;
            }
            return flight.begin(std::exchange(next, next + static_cast<std::size_t>(ranks.count())));
        });
    const auto make = tbb::make_filter<Token, Token>(tbb::filter_mode::parallel, [&](Token token) {
        make_brick(source, token->brick);
        token->message = packed(token->brick, sinks);
        return token;
    });
    const auto send = tbb::make_filter<Token, void>(tbb::filter_mode::serial_in_order, [&](Token token) {
        ranks.send(std::move(token->message));
        report_progress(progress, "resample", static_cast<double>(token->number + 1) / static_cast<double>(total));
        flight.end(token);
    });
    tbb::parallel_pipeline(most_in_flight(sinks), begin & make & send);
}

void gather_bricks(const BrickSource& source, Sinks sinks, const Progress& progress, const Ranks* ranks) {
    const std::size_t total = total_bricks(source);
    const auto count = static_cast<std::size_t>(ranks == nullptr ? 1 : ranks->count());
    Flight flight(source);
    std::size_t next = 0;
    const auto begin =
        tbb::make_filter<void, Token>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> Token {
            if (next == total) {
                control.stop();
                return nullptr;
            }
            const Token token = flight.begin(next++);
            if (const std::size_t owner = token->number % count; owner != 0) {
                token->message = ranks->receive(static_cast<int>(owner));
            }
            return token;
        });
    const auto make = tbb::make_filter<Token, Token>(tbb::filter_mode::parallel, [&](Token token) {
        if (token->number % count != 0) {
            unpack(source.fields(), sinks, *token);
            return token;
        }
        make_brick(source, token->brick);
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
    const auto end = tbb::make_filter<Token, void>(tbb::filter_mode::serial_in_order, [&](Token token) {
        report_progress(progress, "resample", static_cast<double>(token->number + 1) / static_cast<double>(total));
        flight.end(token);
    });
    tbb::parallel_pipeline(most_in_flight(sinks), chain & end);
}

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

void stream_bricks(const BrickSource& source, std::span<BrickSink* const> sinks, const Progress& progress,
                   const Ranks* ranks) {
    if (ranks != nullptr && !ranks->is_root()) {
        send_bricks(source, sinks, progress, *ranks);
    } else {
        gather_bricks(source, sinks, progress, ranks);
    }
}

}  // namespace terratet
