// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/seal.hpp"

#include <algorithm>
#include <tuple>

#include "tess/barrier/seeds/leak_sheets.hpp"
#include "tess/barrier/seeds/leaks.hpp"
#include "tess/barrier/seeds/slivers.hpp"
#include "tess/base/random_share.hpp"

namespace terratet {
namespace {

constexpr int rounds = 24;
constexpr double flake_share = 1e-3;  ///< size of a flake, in protection radii
constexpr double closable = 0.99;     ///< radius of a ball that one flake closes, in protection radii
constexpr double coverable = 1.4;     ///< radius of a ball that twelve cover, in the same: 0.68 of it is what it takes
constexpr double widest_kept = 4;     ///< radius of a ball that several may close, in the same
constexpr double lowest = 1e-4;       ///< height of an added seed over its sheet at least, in spacings
constexpr double harmful = 1e-3;      ///< distance of a seed from a foreign sheet, in spacings
constexpr double aside = 0.06;        ///< how far an added pair may go not to make slivers, in spacings
constexpr std::uint64_t asides = 12;  ///< places tried for that
constexpr double touching = 1 - 1e-6;

class Sealer {
  public:
    Sealer(std::span<const Barrier> barriers, const Box3& hull, const Frame& frame,
           const std::function<void(double)>& progress)
        : barriers_(barriers), hull_(hull), frame_(frame), progress_(progress), finder_(barriers, hull, [this] {
              report(0, 0);
          }) {
        seal_.flakes.resize(barriers.size());
    }

    Seal run() {
        for (int round = 0; round <= rounds; ++round) {
            bool changes = false;
            std::size_t closed = 0;
            for (const Leak& leak : finder_.find([&](double share) { report(round, share); })) {
                if (closed++ % 64 == 0) {
                    report(round, 1);
                }
                if (close_by_flake(leak) || will_change(leak) ||
                    (round < rounds && (add_pair(leak) || drop_pair(leak) || keep_away(leak)))) {
                    changes = true;
                } else {
                    seal_.open.push_back({leak.barrier, finder_.sites()[leak.from].owner, leak.place});
                }
            }
            if (!changes) {
                break;
            }
            exchange();
        }
        return result();
    }

  private:
    /// The first round looks at everything; the later ones are short, and nobody knows how many they are.
    void report(int round, double share) const {
        if (progress_) {
            progress_(round == 0 ? 0.7 * share : 1 - 0.3 / (1 + 0.3 * (round - 1 + share)));
        }
    }

    struct Pair {
        std::uint32_t barrier = 0;
        Vec3 plus;
        Vec3 minus;
        Leak leak;  ///< that it closes
    };

    bool close_by_flake(const Leak& leak) {
        if (leak.between_seeds || leak.radius > closable * protection(leak)) {
            return false;
        }
        if (!finder_.protects(leak)) {
            add_flake(leak, leak.center);
        }
        return true;
    }

    /// By what is planned already?
    [[nodiscard]] bool will_change(const Leak& leak) const {
        return std::ranges::find(dropped_, finder_.sites()[leak.from].first) != dropped_.end() ||
               std::ranges::any_of(added_,
                                   [&](const Pair& pair) { return holds(leak, pair.plus) || holds(leak, pair.minus); });
    }

    static bool holds(const Leak& leak, const Vec3& p) { return distance(p, leak.center) < touching * leak.radius; }

    [[nodiscard]] double protection(const Leak& leak) const { return barriers_[leak.protector].protection_radius; }

    /// Where the sheet runs through the ball, as high as other sheets and seeds allow.
    bool add_pair(const Leak& leak) {
        const Barrier& barrier = barriers_[leak.barrier];
        const Vec3 normal = finder_.sheets().normal_at(leak.barrier, leak.place);
        double height = std::min(0.5 * barrier.width, 0.4 * finder_.sheets().distance_to_others(
                                                                leak.barrier, leak.place, 2 * barrier.width));
        for (; height > lowest * barrier.spacing; height *= 0.5) {
            const Vec3 plus = frame_.snapped(leak.place + height * normal);
            const Vec3 minus = frame_.snapped(leak.place - height * normal);
            if (fits(plus, leak, height) && fits(minus, leak, height)) {
                added_.push_back({leak.barrier, plus, minus, leak});
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] bool fits(const Vec3& seed, const Leak& leak, double height) const {
        const double clear = 0.25 * height;
        return hull_.grown(-0.5 * barriers_[leak.barrier].spacing).contains(seed) && holds(leak, seed) &&
               finder_.distance_to_seed(seed) >= clear &&
               !finder_.sheets().hide(leak.place + 0.01 * (seed - leak.place), seed) &&
               std::ranges::none_of(added_, [&](const Pair& pair) {
                   return distance(pair.plus, seed) < clear || distance(pair.minus, seed) < clear;
               });
    }

    /// A seed that all but lies on another sheet, or on another part of its own, does more harm than good.
    bool drop_pair(const Leak& leak) {
        const LeakFinder::Site& site = finder_.sites()[leak.from];
        if (finder_.sheets().query().distance_to_sheet(static_cast<std::int32_t>(leak.barrier), site.position) >
            harmful * barriers_[leak.barrier].spacing) {
            return false;
        }
        dropped_.push_back(site.first);
        return true;
    }

    /// What the ball reaches beyond the sheet is kept free, bit by bit; all of a small one at once.
    bool keep_away(const Leak& leak) {
        if (leak.between_seeds || leak.radius > widest_kept * protection(leak)) {
            return false;
        }
        if (leak.radius < coverable * protection(leak)) {
            constexpr double small = 0.5257311121191336;  // an icosahedron's corners, half way out
            constexpr double large = 0.8506508083520399;
            for (const double a : {-small, small}) {
                for (const double b : {-large, large}) {
                    for (const Vec3& out : {Vec3{a, b, 0}, Vec3{b, 0, a}, Vec3{0, a, b}}) {
                        add_flake(leak, leak.center + 0.5 * leak.radius * out);
                    }
                }
            }
            return true;
        }
        const double back = std::min(1.0, 0.9 * protection(leak) / leak.radius);
        add_flake(leak, leak.to + back * (leak.center - leak.to));
        finder_.look_again(leak);
        return true;
    }

    void add_flake(const Leak& leak, const Vec3& center) {
        finder_.protect(leak.protector, center);
        const double size = flake_share * protection(leak);
        TriMesh flake;
        flake.points = {center, center + Vec3{size, 0, 0}, center + Vec3{0, size, 0}};
        flake.triangles = {{0, 1, 2}};
        append(seal_.flakes[leak.protector], flake);
    }

    void exchange() {
        for (const std::uint32_t first : dropped_) {
            seal_.changed.push_back(finder_.sites()[first].position);
            seal_.changed.push_back(finder_.sites()[first + 1].position);
            finder_.drop_pair(first);
        }
        for (const Pair& pair : added_) {
            const std::uint32_t first = add_without_slivers(pair);
            seal_.changed.push_back(finder_.sites()[first].position);
            seal_.changed.push_back(finder_.sites()[first + 1].position);
        }
        dropped_.clear();
        added_.clear();
    }

    /// There, or a little aside where that makes fewer slivers, but for what the model ends at. Returns the first site.
    std::uint32_t add_without_slivers(const Pair& pair) {
        std::uint32_t first = finder_.add_pair(pair.barrier, pair.plus, pair.minus);
        std::size_t least = is_bound(barriers_[pair.barrier].sheet.kind) ? 0 : slivers_at(first);
        Pair best = pair;
        for (std::uint64_t number = 0; number < asides && least > 0; ++number) {
            const Pair other = moved_aside(pair, number);
            finder_.drop_pair(first);
            const double height = 0.5 * distance(other.plus, other.minus);
            if (fits(other.plus, pair.leak, height) && fits(other.minus, pair.leak, height)) {
                first = finder_.add_pair(pair.barrier, other.plus, other.minus);
                if (const std::size_t slivers = slivers_at(first); slivers < least) {
                    least = slivers;
                    best = other;
                    continue;
                }
                finder_.drop_pair(first);
            }
            first = finder_.add_pair(best.barrier, best.plus, best.minus);
        }
        return first;
    }

    [[nodiscard]] Pair moved_aside(const Pair& pair, std::uint64_t number) const {
        const auto share = [&](std::uint64_t which) { return 2 * random_share(3 * number + which) - 1; };
        const Vec3 middle = 0.5 * (pair.plus + pair.minus);
        const Vec3 half = (1 - 0.15 * (1 + share(0))) * (0.5 * (pair.plus - pair.minus));
        const Vec3 level = std::abs(half.x) < 0.7 * length(half) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 first = unit(cross(half, level));
        const double way = aside * barriers_[pair.barrier].spacing;
        const Vec3 to = middle + way * (share(1) * first + share(2) * unit(cross(half, first)));
        return {pair.barrier, frame_.snapped(to + half), frame_.snapped(to - half), pair.leak};
    }

    [[nodiscard]] std::size_t slivers_at(std::uint32_t first) const {
        const SliverRule rule{widest_sliver * barriers_[finder_.sites()[first].owner].spacing, hull_,
                              [this](const Vec3& a, const Vec3& b) { return finder_.sheets().hide(a, b); }};
        const auto cells = finder_.cells_at(first);
        return static_cast<std::size_t>(std::ranges::count_if(cells, [&](const auto& cell) {
            std::array<SliverCorner, 4> corners;
            for (std::size_t i = 0; i < 4; ++i) {
                const LeakFinder::Site& site = finder_.sites()[cell[i]];
                if (site.owner == no_index) {
                    return false;
                }
                corners[i] = {site.position, site.owner, cell[i] == site.first};
            }
            return is_sliver(corners, rule);
        }));
    }

    Seal result() {
        seal_.seeds.resize(barriers_.size());
        for (std::uint32_t i = 0; i < finder_.sites().size(); ++i) {
            const LeakFinder::Site& site = finder_.sites()[i];
            if (site.owner != no_index && site.present) {
                seal_.seeds[site.owner].push_back({site.position, static_cast<std::int8_t>(i == site.first ? 1 : -1)});
            }
        }
        const auto by_barrier = [](const Seal::Open& o) { return std::tuple(o.barrier, o.owner, o.place); };
        std::ranges::sort(seal_.open, {}, by_barrier);
        seal_.open.erase(std::ranges::unique(seal_.open, {}, by_barrier).begin(), seal_.open.end());
        return std::move(seal_);
    }

    std::span<const Barrier> barriers_;
    const Box3& hull_;
    const Frame& frame_;
    const std::function<void(double)>& progress_;
    LeakFinder finder_;
    std::vector<Pair> added_;             ///< in this round
    std::vector<std::uint32_t> dropped_;  ///< in this round: first sites of pairs
    Seal seal_;
};

}  // namespace

Seal seal_sheets(std::span<const Barrier> barriers, const Box3& hull, const Frame& frame,
                 const std::function<void(double)>& progress) {
    return Sealer(barriers, hull, frame, progress).run();
}

}  // namespace terratet
