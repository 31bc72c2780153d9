// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/facet_block.hpp"

#include "interp/base/stolen_volumes.hpp"

// The loops below are vectorised by the compiler (interp/CMakeLists.txt asks for it) once all they call is inlined.
// They are compiled twice: for any processor, and for those with AVX2. No fused operations, hence the same bits.
#if defined(__GNUC__)
#define TERRATET_INLINE_ALL __attribute__((flatten))
#else
#define TERRATET_INLINE_ALL
#endif
#if defined(__GNUC__) && defined(__x86_64__)
#define TERRATET_AVX2 __attribute__((target("avx2")))
#endif

namespace terratet {

struct FacetBlockLoops {
    static BoundaryFacet<Vec3, double> facet(const FacetBlock& block, std::size_t lane) {
        return {at(block, 0, lane), at(block, 3, lane), at(block, 6, lane)};
    }
    static Vec3 at(const FacetBlock& block, std::size_t row, std::size_t lane) {
        return {block.in_[row][lane], block.in_[row + 1][lane], block.in_[row + 2][lane]};
    }
    static void store(FacetBlock& block, std::size_t lane, const std::array<double, 3>& terms) {
        for (std::size_t k = 0; k < 3; ++k) {
            block.out_[k][lane] = terms[k];
        }
    }

    TERRATET_INLINE_ALL static void sibson(FacetBlock& block) {
        for (std::size_t lane = 0; lane < FacetBlock::lanes; ++lane) {
            store(block, lane, facet(block, lane).sibson(at(block, 9, lane)));
        }
    }
    TERRATET_INLINE_ALL static void laplace(FacetBlock& block) {
        for (std::size_t lane = 0; lane < FacetBlock::lanes; ++lane) {
            store(block, lane, facet(block, lane).laplace());
        }
    }
#if defined(TERRATET_AVX2)
    TERRATET_INLINE_ALL TERRATET_AVX2 static void sibson_avx2(FacetBlock& block) {
        for (std::size_t lane = 0; lane < FacetBlock::lanes; ++lane) {
            store(block, lane, facet(block, lane).sibson(at(block, 9, lane)));
        }
    }
    TERRATET_INLINE_ALL TERRATET_AVX2 static void laplace_avx2(FacetBlock& block) {
        for (std::size_t lane = 0; lane < FacetBlock::lanes; ++lane) {
            store(block, lane, facet(block, lane).laplace());
        }
    }
#endif
};

#if defined(TERRATET_AVX2)
namespace {

const bool has_avx2 = [] {
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") != 0;
}();

}  // namespace

void FacetBlock::sibson() {
    has_avx2 ? FacetBlockLoops::sibson_avx2(*this) : FacetBlockLoops::sibson(*this);
}
void FacetBlock::laplace() {
    has_avx2 ? FacetBlockLoops::laplace_avx2(*this) : FacetBlockLoops::laplace(*this);
}
#else
void FacetBlock::sibson() {
    FacetBlockLoops::sibson(*this);
}
void FacetBlock::laplace() {
    FacetBlockLoops::laplace(*this);
}
#endif

}  // namespace terratet
