// tests/vtk_views/volume_fuzz.cpp: the reader of one volume format, SOFTSCOPE_FUZZ_READER.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "fuzz/fuzz_target.h"
#include "vtk_views/volumes/volume_formats.h"

namespace softscope::test {
namespace {

/// The one file that each input is written to; the readers take paths.
const std::string& inputFile() {
  static const std::string file =
      std::filesystem::temp_directory_path() / ("softscope_fuzz_" + std::to_string(getpid()));
  return file;
}

/// A volume that was accepted has the voxels that it states, and a place.
void mustBeSound(const StoredVolume& volume) noexcept {
  std::size_t voxels = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mustHold(volume.summary.size_voxels[axis] > 0);
    voxels *= static_cast<std::size_t>(volume.summary.size_voxels[axis]);
    const double spacing_mm = volume.summary.spacing_mm[axis];
    mustHold(std::isfinite(spacing_mm) && spacing_mm > 0 && spacing_mm <= 1000);
  }
  mustHold(volume.bytes.size() >= voxels * static_cast<std::size_t>(volume.summary.components));
  mustHold(std::isfinite(volume.slope) && std::isfinite(volume.intercept));
}

}  // namespace
}  // namespace softscope::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  std::ofstream(inputFile(), std::ios::binary) << textOf(data, size);
  const auto volume = answerOf([&] { return SOFTSCOPE_FUZZ_READER(inputFile(), VolumeOptions{}); });
  if (volume) mustBeSound(*volume);
  std::filesystem::remove(inputFile());
  return 0;
}
