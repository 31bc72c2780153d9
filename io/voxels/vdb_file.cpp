// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/vdb_file.hpp"

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "io/base/output_file.hpp"
#include "io/voxels/vdb_identity.hpp"
#include "io/voxels/vdb_leaves.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// OpenVDB's format on a stream of ours, step by step: its own function works on copies of the grids, which would not
/// know where their values are, and reads all values once more for an index that only speeds up delayed loading.
class GridArchive : public openvdb::io::Archive {
  public:
    void write_to(std::ostream& out, const openvdb::GridPtrVec& grids, const openvdb::MetaMap& meta) const {
        writeHeader(out, /*seekable=*/true);
        meta.writeMeta(out);
        const auto count = static_cast<std::int32_t>(grids.size());
        out.write(reinterpret_cast<const char*>(&count), sizeof count);
        for (const auto& grid : grids) {
            write_one(out, *grid);
        }
    }

  private:
    void write_one(std::ostream& out, openvdb::GridBase& grid) const {
        openvdb::io::GridDescriptor descriptor(grid.getName(), grid.type(), grid.saveFloatAsHalf());
        descriptor.writeHeader(out);
        const auto offsets = out.tellp();
        descriptor.writeStreamPos(out);  // to make room
        descriptor.setGridPos(out.tellp());
        setGridCompression(out, grid);
        grid.addStatsMetadata();
        constexpr std::uint64_t leaf_values = 512 * sizeof(float);  // which are elsewhere
        grid.insertMeta(openvdb::GridBase::META_FILE_MEM_BYTES,
                        openvdb::Int64Metadata(static_cast<std::int64_t>(grid.baseTree().memUsage() +
                                                                         leaf_values * grid.baseTree().leafCount())));
        grid.insertMeta(openvdb::GridBase::META_FILE_COMPRESSION,
                        openvdb::StringMetadata(openvdb::io::compressionToString(compression())));
        grid.writeMeta(out);
        grid.writeTransform(out);
        grid.writeTopology(out);
        descriptor.setBlockPos(out.tellp());
        grid.writeBuffers(out);
        descriptor.setEndPos(out.tellp());
        out.seekp(offsets);
        descriptor.writeStreamPos(out);
        descriptor.seekToEnd(out);
    }
};

/// Returns the bytes written. The stream throws at the first that does not get through.
std::uintmax_t write_grids(const std::string& path, const std::string& shown, const openvdb::GridPtrVec& grids,
                           const openvdb::MetaMap& meta) {
    errno = 0;
    try {
        std::ofstream out;
        out.exceptions(std::ios::failbit | std::ios::badbit);
        out.open(path, std::ios::binary | std::ios::trunc);
        GridArchive archive;
        archive.setCompression(vdb_compression());
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

std::uint32_t vdb_compression() {
    return openvdb::io::COMPRESS_ACTIVE_MASK |
           (openvdb::io::Archive::hasBloscCompression()  ? openvdb::io::COMPRESS_BLOSC
            : openvdb::io::Archive::hasZLibCompression() ? openvdb::io::COMPRESS_ZIP
                                                         : openvdb::io::COMPRESS_NONE);
}

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
