// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The content is hashed as a stream of little-endian numbers and length-prefixed texts, in the order of the fields in
// tess/model.hpp. Every list comes with its length, so that no two models share a stream. Structured bindings name all
// fields of a struct: one that is added later fails to compile here, and needs its place in model_meta.cpp or in the
// layers.
#include <openssl/evp.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <type_traits>

#include "io/model_store.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

static_assert(std::endian::native == std::endian::little, "model files hold little-endian arrays");

class Hash {
  public:
    Hash() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
        if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
            throw Error("SHA-256 is not available in the OpenSSL of this system");
        }
        buffer_.reserve(capacity);
    }

    void bytes(const void* data, std::size_t size) {
        if (buffer_.size() + size > capacity) {
            flush();
        }
        if (size > capacity) {
            EVP_DigestUpdate(context_.get(), data, size);
            return;
        }
        const auto* const first = static_cast<const unsigned char*>(data);
        buffer_.insert(buffer_.end(), first, first + size);
    }

    template <typename Integer>
    requires std::is_integral_v<Integer>
    void add(Integer value) {
        const auto wide = static_cast<std::uint64_t>(value);
        bytes(&wide, sizeof wide);
    }
    /// Zeros and NaNs alike, whatever their sign and payload: a database keeps neither.
    void add(double value) {
        const double plain = std::isnan(value) ? missing : value + 0.0;
        bytes(&plain, sizeof plain);
    }
    void add(const std::string& text) {
        add(text.size());
        bytes(text.data(), text.size());
    }
    void add(const Vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void add(const Box3& b) {
        add(b.lo);
        add(b.hi);
    }
    void add(const Triangle& t) { bytes(t.data(), sizeof t); }
    template <typename T>
    void add(const std::vector<T>& list) {
        add(list.size());
        for (const T& item : list) {
            add(item);
        }
    }
    template <typename Enum>
    requires std::is_enum_v<Enum>
    void add(Enum value) { add(static_cast<std::uint64_t>(value)); }
    template <typename... Fields>
    void add_all(const Fields&... fields) {
        (add(fields), ...);
    }

    void add(const Property& p) {
        const auto& [name, unit, scale, kind, classes, hard_horizons] = p;
        add_all(name, unit, scale, kind, classes);
        if (hard_horizons) {
            add(std::string("hard horizons"));
        }
    }
    void add(const Borehole& b) {
        const auto& [id, collar, path, path_depth] = b;
        add_all(id, collar, path, path_depth);
    }
    /// Not the file: where a copy of it lies is no content.
    void add(const Surface& s) {
        const auto& [name, kind, vertices, triangles, file] = s;
        static_cast<void>(file);
        add_all(name, kind, vertices, triangles);
    }
    void add(const Seed& s) {
        const auto& [position, side] = s;
        add_all(position, side);
    }
    void add(const Barrier& f) {
        const auto& [name, sheet, margin, seeds, spacing, width, covering_radius, protection_radius, refined] = f;
        add_all(name, sheet, margin, seeds, spacing, width, covering_radius, protection_radius, refined);
    }
    void add(const RegionName& r) {
        const auto& [point, name] = r;
        add_all(point, name);
    }
    void add(const VariationLimits& v) {
        const auto& [df_min, df_max, tolerance, residual, trend] = v;
        add_all(df_min, df_max);
        if (tolerance > 0) {  // as models were before there were any
            add_all(tolerance, residual, trend);
        }
    }
    void add(const ResolutionOverride& o) {
        const auto& [where, box, point, l_min, l_max] = o;
        add_all(where, box, point, l_min, l_max);
    }
    void add(const FinePlace& f) {
        const auto& [position, l_min] = f;
        add_all(position, l_min);
    }
    void add(const Vertex& v) {
        const auto& [id, position, role, owner, side] = v;
        add_all(id, position, role, owner, side);
    }
    void add(const Frame& f) {
        const auto& [crs_wkt, crs_name, unit, metres_per_unit, origin, z_scale] = f;
        add_all(crs_wkt, crs_name, unit, metres_per_unit, origin, z_scale);
    }
    void add(const Samples& s) {
        const auto& [positions, borehole, depth, length, values, censored] = s;
        add_all(positions, borehole, depth, length, values);
        add(s.any_censored() ? censored : decltype(s.censored){});  // there or not, it means the same
    }
    void add(const Domain& d) {
        const auto& [extent, hull, outline] = d;
        add_all(extent, hull, outline);
    }
    void add(const Criteria& c) {
        const auto& [l_min, l_max, radius_edge, aspect, v_min, v_max, dihedral_deg, variation, overrides, l_min_between,
                     l_min_floor, shape_everywhere, fine] = c;
        add_all(l_min, l_max, radius_edge, aspect, v_min, v_max, dihedral_deg, variation, overrides);
        if (c.has_tolerance()) {
            add_all(l_min_between, l_min_floor, shape_everywhere, fine);
        }
    }
    void add(const BarrierOptions& o) {
        const auto& [spacing, width, snap, max_seeds, mode, refine] = o;
        add_all(spacing, width, snap, max_seeds, mode, refine);
    }
    void add(const VertexValues& v) {
        const auto& [values, extrapolation] = v;
        add_all(values, extrapolation);
    }

    std::string hex() {
        flush();
        unsigned char digest[32];
        EVP_DigestFinal_ex(context_.get(), digest, nullptr);
        std::string result;
        for (const unsigned char byte : digest) {
            result += "0123456789abcdef"[byte >> 4];
            result += "0123456789abcdef"[byte & 15];
        }
        return result;
    }

  private:
    static constexpr std::size_t capacity = 1 << 16;

    void flush() {
        EVP_DigestUpdate(context_.get(), buffer_.data(), buffer_.size());
        buffer_.clear();
    }

    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
    std::vector<unsigned char> buffer_;
};

}  // namespace

std::string model_digest(const Model& model) {
    Hash hash;
    hash.add(std::string("terratet model 1"));
    hash.add_all(model.frame, model.properties, model.boreholes, model.samples, model.surfaces, model.domain,
                 model.criteria, model.density, model.barrier_options, model.region_names, model.barriers,
                 model.vertices, model.vertex_values, model.estimator);
    return hash.hex();
}

}  // namespace terratet
