// vtk_views/volumes/voxel_bytes.h: the voxels behind a checked header, to the last byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "vtk_views/volumes/voxel_type.h"

namespace softscope {

/// Where voxels lie on disk, as a header says.
struct VoxelBlock {
  std::filesystem::path file;
  std::uintmax_t offset = 0;  // in the file; of a compressed NIfTI: in what is unpacked
  VoxelType type = VoxelType::kInt16;
  bool big_endian = false;
  double voxels = 0, components = 1;  // double: a product of damaged sizes stays in range
};

/// Uncompressed, from `offset` to the end of the file. Throws InputError where the file is shorter
/// or longer than sizes and type say.
std::string readPlainVoxels(const VoxelBlock& block);

/// A zlib or gzip stream from `offset` to the end of the file. Throws InputError where it is
/// damaged (zlib's check sum), shorter or longer than sizes and type say.
std::string readPackedVoxels(const VoxelBlock& block);

bool isGzip(const std::filesystem::path& file);

/// The first bytes of a file, unpacked where it is gzip; fewer where it ends before.
std::string firstBytes(const std::filesystem::path& file, std::size_t count);

/// Of a gzip file whose voxels begin `offset` bytes into what it holds.
std::string readGzippedVoxels(const VoxelBlock& block);

}  // namespace softscope
