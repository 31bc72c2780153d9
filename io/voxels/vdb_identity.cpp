// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/vdb_identity.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "tess/error.hpp"

namespace terratet {
namespace {

/// The header: magic number (8 bytes), format version (4), library version (4 + 4), a flag (1), the UUID as text.
constexpr std::size_t uuid_begin = 8 + 4 + 4 + 4 + 1;
constexpr std::size_t uuid_length = 36;

bool is_uuid(const char* text) {
    for (std::size_t i = 0; i < uuid_length; ++i) {
        const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
        if (dash ? text[i] != '-' : std::strchr("0123456789abcdefABCDEF", text[i]) == nullptr) {
            return false;
        }
    }
    return true;
}

/// 128 bits over a stream of bytes, eight at a time: two lanes of multiply and rotate. Good enough to tell files apart;
/// no protection against someone who wants two alike.
class Digest {
  public:
    void add(const char* bytes, std::size_t count) {
        for (std::size_t i = 0; i < count; i += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes + i, std::min<std::size_t>(8, count - i));
            mix(word);
        }
        mix(count);
    }
    [[nodiscard]] std::string uuid() const {
        std::array<std::uint64_t, 2> bits{finished(a_ ^ b_), finished(b_)};
        bits[0] = (bits[0] & ~0xF000ULL) | 0x8000ULL;            // version 8
        bits[1] = (bits[1] & ~(0xCULL << 60)) | (0x8ULL << 60);  // variant of the RFC
        constexpr const char* digits = "0123456789abcdef";
        std::string text;
        for (std::size_t i = 0; i < 32; ++i) {
            if (i == 8 || i == 12 || i == 16 || i == 20) {
                text += '-';
            }
            text += digits[bits[i / 16] >> (60 - 4 * (i % 16)) & 0xF];
        }
        return text;
    }

  private:
    void mix(std::uint64_t word) {
        a_ = (a_ ^ word) * 0x9E3779B97F4A7C15ULL;
        a_ ^= a_ >> 29;
        b_ = ((b_ << 31 | b_ >> 33) ^ word) * 0xD6E8FEB86659FD93ULL;
    }
    static std::uint64_t finished(std::uint64_t h) {
        h = (h ^ h >> 32) * 0xD6E8FEB86659FD93ULL;
        h = (h ^ h >> 32) * 0xD6E8FEB86659FD93ULL;
        return h ^ h >> 32;
    }
    std::uint64_t a_ = 1;
    std::uint64_t b_ = 2;
};

}  // namespace

void make_vdb_identity_reproducible(const std::string& path, const std::string& shown) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    std::vector<char> buffer(1 << 20);
    Digest digest;
    bool first = true;
    while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), file.gcount() > 0) {
        const auto count = static_cast<std::size_t>(file.gcount());
        if (first) {
            if (count < uuid_begin + uuid_length || !is_uuid(buffer.data() + uuid_begin)) {
                throw Error(shown + " does not begin as an OpenVDB file does");
            }
            std::fill_n(buffer.begin() + uuid_begin, uuid_length, '0');
            first = false;
        }
        digest.add(buffer.data(), count);
    }
    file.clear();
    file.seekp(uuid_begin);
    file << digest.uuid();
    if (first || !file.flush()) {
        throw Error("cannot write " + shown + ": the disk is full, or failing");
    }
}

}  // namespace terratet
