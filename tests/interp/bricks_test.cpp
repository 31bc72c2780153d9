// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/bricks.hpp"

#include <tbb/global_control.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tess/error.hpp"

using namespace terratet;

namespace {

/// Each voxel's value tells where it is; every third brick is empty.
class Numbers final : public BrickSource {
  public:
    explicit Numbers(const Lattice& lattice) : lattice_(lattice) {}
    [[nodiscard]] const Lattice& lattice() const override { return lattice_; }
    [[nodiscard]] std::size_t fields() const override { return 1; }
    void fill(Brick& brick) const override {
        ++made;
        if ((brick.lo[0] + brick.lo[1] + brick.lo[2]) / Brick::edge % 3 == 2) {
            return;
        }
        brick.values[0].assign(std::size_t{Brick::edge} * Brick::edge * Brick::edge,
                               std::numeric_limits<float>::quiet_NaN());
        for (int i = 0; i < brick.size[0]; ++i) {
            for (int j = 0; j < brick.size[1]; ++j) {
                for (int k = 0; k < brick.size[2]; ++k) {
                    brick.values[0][Brick::index(i, j, k)] =
                        static_cast<float>((brick.lo[0] + i) * 1000000 + (brick.lo[1] + j) * 1000 + brick.lo[2] + k);
                }
            }
        }
    }
    mutable std::atomic<int> made{0};

  private:
    Lattice lattice_;
};

struct Sum final : BrickPiece {
    double value = 0;
};

class Recorder final : public BrickSink {
  public:
    [[nodiscard]] std::unique_ptr<BrickPiece> prepare(const Brick& brick) const override {
        auto sum = std::make_unique<Sum>();
        for (const float value : brick.values[0]) {
            sum->value += std::isnan(value) ? 0 : static_cast<double>(value);
        }
        return sum;
    }
    void put(const Brick& brick, std::unique_ptr<BrickPiece> piece) override {
        seen.push_back({brick.lo[2], -brick.lo[1], brick.lo[0]});
        sums.push_back(static_cast<const Sum&>(*piece).value);
        if (fails) {
            throw Error("the disk is full");
        }
    }
    std::vector<std::array<std::int64_t, 3>> seen;
    std::vector<double> sums;
    bool fails = false;
};

const Lattice lattice{{0, 0, 0}, {1, 1, 1}, {130, 70, 200}};  // 3 × 2 × 4 bricks

}  // namespace

TEST_CASE("R6: every sink gets every brick once, from below, from the north, from the west, at any thread count") {
    std::vector<double> first;
    for (const std::size_t threads : {1, 2, 5}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const Numbers source(lattice);
        Recorder a;
        Recorder b;
        BrickSink* const sinks[] = {&a, &b};
        stream_bricks(source, sinks);
        CHECK(source.made == 24);  // for both sinks together
        CHECK(a.seen.size() == 24);
        CHECK(std::ranges::is_sorted(a.seen));
        CHECK(a.seen == b.seen);
        CHECK(a.sums == b.sums);
        if (first.empty()) {
            first = a.sums;
        }
        CHECK(a.sums == first);
    }
}

TEST_CASE("A sink that fails ends the stream with its error, and so does a progress callback that says stop") {
    const Numbers source(lattice);
    Recorder a;
    Recorder b;
    b.fails = true;
    BrickSink* const sinks[] = {&a, &b};
    CHECK_THROWS_WITH(stream_bricks(source, sinks), "the disk is full");
    CHECK_THROWS_AS(stream_bricks(source, std::span(sinks, 1), [](auto, double) { return false; }), Cancelled);
}
