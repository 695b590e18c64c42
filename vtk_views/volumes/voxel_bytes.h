// vtk_views/volumes/voxel_bytes.h: reader of voxels with checked size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "vtk_views/volumes/voxel_type.h"

namespace softscope {

/// Position of the voxels on disk, from the header.
struct VoxelBlock {
  std::filesystem::path file;
  std::uintmax_t offset = 0;  // in the file; for compressed NIfTI in the decompressed data
  VoxelType type = VoxelType::kInt16;
  bool big_endian = false;
  double voxels = 0, components = 1;  // double: products of damaged sizes do not overflow
};

/// Uncompressed, from `offset` to the end of the file. Throws InputError
/// if the file is shorter or longer than sizes and type require.
std::string readPlainVoxels(const VoxelBlock& block);

/// zlib or gzip stream from `offset` to the end of the file. Throws InputError if
/// it is damaged (checksum of zlib), shorter or longer than sizes and type require.
std::string readPackedVoxels(const VoxelBlock& block);

bool isGzip(const std::filesystem::path& file);

/// First bytes of a file, decompressed for gzip; fewer for a short file.
std::string firstBytes(const std::filesystem::path& file, std::size_t count);

/// For a gzip file with voxels at `offset` of the decompressed data.
std::string readGzippedVoxels(const VoxelBlock& block);

}  // namespace softscope
