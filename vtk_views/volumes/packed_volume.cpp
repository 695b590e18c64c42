#include "vtk_views/volumes/packed_volume.h"

#include <utility>
#include <vector>

#include "vtk_views/files/packed_bytes.h"

namespace softscope {
namespace {

void packPairs(const std::vector<std::pair<std::string, std::string>>& pairs, BytePacker& packer) {
  packer.add(pairs.size());
  for (const auto& [name, value] : pairs) {
    packer.addText(name);
    packer.addText(value);
  }
}

void unpackPairs(ByteUnpacker& unpacker, std::vector<std::pair<std::string, std::string>>& pairs) {
  std::size_t count = 0;
  unpacker.take(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto& [name, value] = pairs.emplace_back();
    unpacker.takeText(name);
    unpacker.takeText(value);
  }
}

}  // namespace

std::string packVolume(const StoredVolume& volume) {
  BytePacker packer;
  const VolumeSummary& summary = volume.summary;
  for (const std::string* word : {&summary.format, &summary.file_space, &summary.axes})
    packer.addText(*word);
  packer.add(summary.size_voxels);
  packer.add(summary.spacing_mm);
  for (Eigen::Index i = 0; i < 16; ++i) packer.add(summary.lps_from_voxel.data()[i]);
  packer.add(summary.components);
  packPairs(summary.details, packer);
  packPairs(summary.patient, packer);
  packer.add(summary.warnings.size());
  for (const std::string& warning : summary.warnings) packer.addText(warning);
  packer.add(volume.type);
  packer.addAll(volume.stored_slices);
  packer.addText(volume.bytes);
  return std::move(packer.bytes);
}

StoredVolume unpackVolume(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  StoredVolume volume;
  VolumeSummary& summary = volume.summary;
  for (std::string* word : {&summary.format, &summary.file_space, &summary.axes})
    unpacker.takeText(*word);
  unpacker.take(summary.size_voxels);
  unpacker.take(summary.spacing_mm);
  for (Eigen::Index i = 0; i < 16; ++i) unpacker.take(summary.lps_from_voxel.data()[i]);
  unpacker.take(summary.components);
  unpackPairs(unpacker, summary.details);
  unpackPairs(unpacker, summary.patient);
  std::size_t count = 0;
  unpacker.take(count);
  for (std::size_t i = 0; i < count; ++i) unpacker.takeText(summary.warnings.emplace_back());
  unpacker.take(volume.type);
  unpacker.takeAll(volume.stored_slices);
  unpacker.takeText(volume.bytes);
  return volume;
}

}  // namespace softscope
