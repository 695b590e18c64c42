#include "vtk_views/volumes/volume_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <new>

#include "core/error.h"
#include "core/parallel.h"
#include "vtk_views/volumes/dicom_series.h"
#include "vtk_views/volumes/volume_formats.h"

namespace softscope {
namespace {

bool endsWith(const std::string& path, const std::string& ending) {
  if (path.size() < ending.size()) return false;
  return std::equal(
      ending.begin(), ending.end(), path.end() - std::ptrdiff_t(ending.size()),
      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool namedNifti(const std::string& path) {
  return endsWith(path, ".nii") || endsWith(path, ".nii.gz");
}
bool namedNrrd(const std::string& path) {
  return endsWith(path, ".nrrd") || endsWith(path, ".nhdr");
}
bool namedMetaImage(const std::string& path) {
  return endsWith(path, ".mha") || endsWith(path, ".mhd");
}

StoredVolume readStored(const std::string& path, const VolumeOptions& options) {
  if (namedNifti(path)) return readNifti(path, options);
  if (namedNrrd(path)) return readNrrd(path, options);
  if (namedMetaImage(path)) return readMetaImage(path, options);
  if (looksLikeDicom(path)) return loadDicom(path, options);
  throw InputError(path +
                   ": no volume that softscope reads. Accepted: NIfTI (.nii, .nii.gz), NRRD "
                   "(.nrrd, .nhdr), MetaImage (.mha, .mhd), a DICOM file or folder");
}

/// First value of each voxel of one slice.
template <class Stored>
void copySlice(const StoredVolume& stored, std::size_t slice, std::size_t voxels, float* values) {
  const auto step = stored.planar ? std::size_t{1} : std::size_t(stored.summary.components);
  const auto* from = reinterpret_cast<const Stored*>(stored.bytes.data()) + slice * voxels * step;
  for (std::size_t i = 0; i < voxels; ++i)
    values[i] = static_cast<float>(stored.slope * double(from[i * step]) + stored.intercept);
}

/// Throws InputError for a stored value that is not finite.
void takeRange(const std::string& path, const StoredVolume& stored, Volume& volume) {
  float least = std::numeric_limits<float>::max(), most = -least;
  std::size_t bad = 0;
  for (const float value : volume.values) {
    bad += !std::isfinite(value);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const auto missing = std::count(stored.stored_slices.begin(), stored.stored_slices.end(), -1);
  const std::size_t expected = std::size_t(missing) * std::size_t(volume.facts.size_voxels[0]) *
                               std::size_t(volume.facts.size_voxels[1]);
  if (bad != expected)
    throw InputError(path + ": " + std::to_string(bad - expected) + " of " +
                     std::to_string(volume.values.size()) +
                     " values are not finite; fill them with the value of air and save it again");
  volume.facts.value_range = {least, most};
}

Volume withValues(const std::string& path, const StoredVolume& stored) {
  Volume volume;
  volume.facts = stored.summary;
  volume.facts.scalar_type = nameOf(stored.type);
  const auto& size = volume.facts.size_voxels;
  const std::size_t voxels = std::size_t(size[0]) * std::size_t(size[1]);
  volume.values.resize(voxels * std::size_t(size[2]));
  parallelRanges(size[2], 4, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const int from = stored.stored_slices.empty() ? k : stored.stored_slices[std::size_t(k)];
      float* slice = volume.values.data() + std::size_t(k) * voxels;
      if (from < 0)
        std::fill(slice, slice + voxels, std::numeric_limits<float>::quiet_NaN());
      else
        withTypeOf(stored.type, [&](auto zero) {
          copySlice<decltype(zero)>(stored, std::size_t(from), voxels, slice);
        });
    }
  });
  takeRange(path, stored, volume);
  return volume;
}

void checkPlausible(VolumeSummary& summary) {
  const auto [least, most] =
      std::minmax_element(summary.spacing_mm.begin(), summary.spacing_mm.end());
  double longest_mm = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    longest_mm = std::max(longest_mm, summary.spacing_mm[axis] * summary.size_voxels[axis]);
  if (longest_mm < 5)
    summary.warnings.push_back("the longest side is " + std::to_string(longest_mm) +
                               " mm, too short for an organ. In metres?");
  if (longest_mm > 5000)
    summary.warnings.push_back("the longest side is " + std::to_string(longest_mm) +
                               " mm, too long for a patient. In micrometres?");
  if (*least > 0 && *most / *least > 10)
    summary.warnings.emplace_back("voxels are more than 10 times longer than wide");
  if (summary.value_range[0] == summary.value_range[1])
    summary.warnings.emplace_back("every voxel has the same value");
}

}  // namespace

bool looksLikeVolume(const std::string& path) {
  return namedNifti(path) || namedNrrd(path) || namedMetaImage(path) || looksLikeDicom(path);
}

Volume loadVolume(const std::string& path, const VolumeOptions& options) try {
  if (!std::filesystem::exists(path)) throw InputError(path + ": does not exist");
  Volume volume = withValues(path, readStored(path, options));
  checkPlausible(volume.facts);
  return volume;
} catch (const std::bad_alloc&) {
  throw InputError(path + ": its voxels don't fit into memory; cut it to the organ, or halve it");
}

VolumeSummary summariseVolume(const std::string& path, const VolumeOptions& options) {
  return loadVolume(path, options).facts;
}

}  // namespace softscope
