// tests/support/in_folder.cpp: sequences of a slope; files as bytes.
#include "support/in_folder.h"

#include <fstream>
#include <sstream>

#include "io/calibrations/calibration_writer.h"
#include "io/images/image_writer.h"
#include "support/scene.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

ColourImage tinted(const GrayImage& gray) {
  ColourImage colour(gray.width_px, gray.height_px);
  for (std::size_t i = 0; i < gray.size(); ++i) {
    const std::uint8_t value = gray.values[i];
    colour.values[i] = {value, std::uint8_t(value / 2), std::uint8_t(value / 3)};
  }
  return colour;
}

/// Drawn once for all sequences.
const Scene& slope() {
  static const Scene scene = makeScene(sequenceRig(), plane(50, 0.2, 0.1));
  return scene;
}

}  // namespace

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

int countFiles(const fs::path& folder) {
  if (!fs::exists(folder)) return 0;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) count += !entry.is_directory();
  return count;
}

RectifiedRig sequenceRig() { return endoscope(160, 120); }

void writeSequence(const fs::path& folder, int frames) {
  const RectifiedRig rig = sequenceRig();
  StereoCalibration calibration;
  calibration.left.pinhole = calibration.right.pinhole = rig.left;
  calibration.right_from_left.translation().x() = -rig.baseline_mm;
  calibration.rectified = true;
  fs::create_directories(folder / "left");
  fs::create_directories(folder / "right");
  writeCalibration(folder / "calibration.yaml", calibration);
  for (int i = 0; i < frames; ++i) {
    const std::string file = "00000" + std::to_string(i) + ".png";
    writePng(folder / "left" / file, tinted(slope().left));
    writePng(folder / "right" / file, tinted(slope().right));
  }
}

}  // namespace softscope::test
