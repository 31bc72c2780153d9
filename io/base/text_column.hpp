// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A column of a table as text, end to end in blocks: a cell costs its letters and four bytes.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// Grows at its end only. Views of cells hold as long as the column is not changed. A cell has less than 1 MiB.
class TextColumn {
  public:
    class Iterator {
      public:
        using value_type = std::string_view;
        using difference_type = std::ptrdiff_t;
        using reference = std::string_view;
        using pointer = void;
        using iterator_category = std::input_iterator_tag;
        using iterator_concept = std::forward_iterator_tag;

        Iterator() = default;
        Iterator(const TextColumn& column, std::size_t row) : column_(&column), row_(row) {}
        std::string_view operator*() const { return (*column_)[row_]; }
        Iterator& operator++() {
            ++row_;
            return *this;
        }
        Iterator operator++(int) {
            Iterator before = *this;
            ++row_;
            return before;
        }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.row_ == b.row_; }
        friend difference_type operator-(const Iterator& a, const Iterator& b) {
            return static_cast<difference_type>(a.row_) - static_cast<difference_type>(b.row_);
        }

      private:
        const TextColumn* column_ = nullptr;
        std::size_t row_ = 0;
    };

    TextColumn() = default;
    TextColumn(std::initializer_list<std::string_view> cells) {
        for (const std::string_view cell : cells) {
            push_back(cell);
        }
    }

    void push_back(std::string_view cell) {
        if (size_ % rows_a_block == 0) {
            begin_block();
        }
        Block& block = blocks_.back();
        block.letters.append(cell);
        block.ends.push_back(static_cast<std::uint32_t>(block.letters.size()));
        ++size_;
    }

    std::string_view operator[](std::size_t row) const {
        const Block& block = blocks_[row / rows_a_block];
        const std::size_t i = row % rows_a_block;
        const std::size_t begin = i == 0 ? 0 : block.ends[i - 1];
        return {block.letters.data() + begin, block.ends[i] - begin};
    }

    [[nodiscard]] std::string_view front() const { return (*this)[0]; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] Iterator begin() const { return {*this, 0}; }
    [[nodiscard]] Iterator end() const { return {*this, size_}; }

    friend bool operator==(const TextColumn& a, const std::vector<std::string>& b) {
        bool equal = a.size() == b.size();
        for (std::size_t row = 0; equal && row < b.size(); ++row) {
            equal = a[row] == b[row];
        }
        return equal;
    }

  private:
    static constexpr std::size_t rows_a_block = 4096;

    struct Block {
        std::string letters;
        std::vector<std::uint32_t> ends;
    };

    /// With room as the block before needed it; what that one has too much is given back.
    void begin_block() {
        Block next;
        if (!blocks_.empty()) {
            Block& last = blocks_.back();
            next.letters.reserve(last.letters.size() + last.letters.size() / 16);
            next.ends.reserve(rows_a_block);
            if (last.letters.capacity() > last.letters.size() + last.letters.size() / 8) {
                last.letters.shrink_to_fit();
            }
            last.ends.shrink_to_fit();
        }
        blocks_.push_back(std::move(next));
    }

    std::vector<Block> blocks_;
    std::size_t size_ = 0;
};

}  // namespace terratet
