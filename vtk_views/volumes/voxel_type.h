// vtk_views/volumes/voxel_type.h: storage type of a voxel value.
#pragma once

#include <cstddef>
#include <cstdint>

namespace softscope {

enum class VoxelType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

inline std::size_t bytesOf(VoxelType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

/// "short", "unsigned char", "float" …
inline const char* nameOf(VoxelType type) {
  constexpr const char* kNames[] = {
      "signed char", "unsigned char",      "short", "unsigned short", "int", "unsigned int",
      "long long",   "unsigned long long", "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

/// Calls `use` with a value of the stored type: withTypeOf(type, [&](auto zero) { … }).
template <class Use>
void withTypeOf(VoxelType type, const Use& use) {
  switch (type) {
    case VoxelType::kInt8:
      return use(std::int8_t{});
    case VoxelType::kUint8:
      return use(std::uint8_t{});
    case VoxelType::kInt16:
      return use(std::int16_t{});
    case VoxelType::kUint16:
      return use(std::uint16_t{});
    case VoxelType::kInt32:
      return use(std::int32_t{});
    case VoxelType::kUint32:
      return use(std::uint32_t{});
    case VoxelType::kInt64:
      return use(std::int64_t{});
    case VoxelType::kUint64:
      return use(std::uint64_t{});
    case VoxelType::kFloat32:
      return use(float{});
    case VoxelType::kFloat64:
      return use(double{});
  }
}

}  // namespace softscope
