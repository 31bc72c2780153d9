// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/vdb_file.hpp"

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "io/base/output_file.hpp"
#include "io/write/vdb_identity.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// OpenVDB's format on a stream of ours.
class GridArchive : public openvdb::io::Archive {
  public:
    void write_to(std::ostream& out, const openvdb::GridPtrVec& grids, const openvdb::MetaMap& meta) const {
        write(out, grids, /*seekable=*/true, meta);
    }
};

std::uint32_t compression() {
    return openvdb::io::COMPRESS_ACTIVE_MASK |
           (openvdb::io::Archive::hasBloscCompression()  ? openvdb::io::COMPRESS_BLOSC
            : openvdb::io::Archive::hasZLibCompression() ? openvdb::io::COMPRESS_ZIP
                                                         : openvdb::io::COMPRESS_NONE);
}

/// Returns the bytes written. The stream throws at the first that does not get through.
std::uintmax_t write_grids(const std::string& path, const std::string& shown, const openvdb::GridPtrVec& grids,
                           const openvdb::MetaMap& meta) {
    errno = 0;
    try {
        std::ofstream out;
        out.exceptions(std::ios::failbit | std::ios::badbit);
        out.open(path, std::ios::binary | std::ios::trunc);
        GridArchive archive;
        archive.setCompression(compression());
        archive.write_to(out, grids, meta);
        out.seekp(0, std::ios::end);
        const auto bytes = static_cast<std::uintmax_t>(out.tellp());
        out.close();
        return bytes;
    } catch (const std::ios_base::failure&) {
        fail_writing(shown, errno == 0 ? EIO : errno);
    }
}

void require_whole(const std::string& path, const std::string& shown, const openvdb::GridPtrVec& grids,
                   std::uintmax_t bytes) {
    std::error_code error;
    bool whole = std::filesystem::file_size(path, error) == bytes && !error;
    if (whole) {
        openvdb::io::File file(path);
        file.open(/*delayLoad=*/false);
        std::size_t found = 0;
        for (auto name = file.beginName(); name != file.endName(); ++name) {
            ++found;
        }
        whole = found == grids.size();
        for (const auto& grid : grids) {
            whole = whole && file.hasGrid(grid->getName()) && file.readGridMetadata(grid->getName()) != nullptr;
        }
    }
    if (!whole) {
        throw Error("cannot write " + shown +
                    ": what was read back is not what was written; is the disk full, or failing?");
    }
}

}  // namespace

void write_vdb_file(const std::string& path, const std::string& shown, const openvdb::GridPtrVec& grids,
                    const openvdb::MetaMap& meta) {
    try {
        const std::uintmax_t bytes = write_grids(path, shown, grids, meta);
        make_vdb_identity_reproducible(path, shown);
        require_whole(path, shown, grids, bytes);
    } catch (const openvdb::Exception& error) {
        throw Error("cannot write " + shown + ": OpenVDB says " + error.what());
    }
}

}  // namespace terratet
