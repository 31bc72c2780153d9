// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Values as bytes and back, between processes of one program on machines of one kind.

#include <cassert>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace terratet {

class ByteWriter {
  public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(const std::vector<T>& values) {
        put(static_cast<std::uint64_t>(values.size()));
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    void put(std::string_view text) {
        put(static_cast<std::uint64_t>(text.size()));
        bytes_.append(text);
    }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// \pre the bytes are a ByteWriter's, and are asked for in the same order
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] T get() {
        T value;
        copy(&value, sizeof value);
        return value;
    }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] std::vector<T> list() {
        std::vector<T> values(get<std::uint64_t>());
        copy(values.data(), values.size() * sizeof(T));
        return values;
    }
    [[nodiscard]] std::string_view text() {
        const auto size = get<std::uint64_t>();
        const std::string_view found = bytes_.substr(0, size);
        bytes_.remove_prefix(found.size());
        return found;
    }

  private:
    void copy(void* to, std::size_t size) {
        assert(size <= bytes_.size());
        if (size > 0) {
            std::memcpy(to, bytes_.data(), size);
        }
        bytes_.remove_prefix(size);
    }

    std::string_view bytes_;
};

}  // namespace terratet
