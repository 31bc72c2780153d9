// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Storage for large arrays that are read here and there: on pages of 2 MiB where the system has them, so that fewer
/// reads wait for the address translation.

#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace terratet {

template <typename T>
struct HugePageAllocator {
    using value_type = T;
    static constexpr std::size_t page = std::size_t(1) << 21;

    HugePageAllocator() = default;
    template <typename Other>
    HugePageAllocator(const HugePageAllocator<Other>&) {}

    T* allocate(std::size_t count) {
        if (count > (std::numeric_limits<std::size_t>::max() - page) / sizeof(T)) {
            throw std::bad_array_new_length();
        }
        const std::size_t bytes = count * sizeof(T);
        const std::size_t alignment = bytes < 2 * page ? 64 : page;
        const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
        void* const memory = std::aligned_alloc(alignment, rounded);
        if (!memory) {
            throw std::bad_alloc();
        }
#if defined(__linux__)
        if (alignment == page) {
            madvise(memory, rounded, MADV_HUGEPAGE);  // a wish; refused, ordinary pages do
        }
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) {
        std::free(memory);
    }

    friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) {
        return true;
    }
};

template <typename T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace terratet
