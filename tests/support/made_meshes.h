// tests/support/made_meshes.h: meshes and a volume of known shape, as files.
#pragma once

#include <Eigen/Core>
#include <string>

namespace softscope::test {

/// A square of 20 mm at height z, facing up, its corner at (x, 0), in steps of 1 mm.
inline std::string squareObj(double x_mm, double z_mm, double scale = 1,
                             const std::string& head = "") {
  std::string text = head;
  const auto at = [](int i, int j) { return std::to_string(1 + j * 21 + i); };
  for (int j = 0; j <= 20; ++j)
    for (int i = 0; i <= 20; ++i)
      text += "v " + std::to_string((x_mm + i) * scale) + " " + std::to_string(j * scale) + " " +
              std::to_string(z_mm * scale) + "\n";
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i)
      text +=
          "f " + at(i, j) + " " + at(i + 1, j) + " " + at(i + 1, j + 1) + " " + at(i, j + 1) + "\n";
  return text;
}

/// A box of quads with corners at `low` and `high`.
inline std::string boxObj(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                          const std::string& head = "") {
  std::string text = head;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                            (i & 4) != 0 ? high.z() : low.z());
    text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
            std::to_string(p.z()) + "\n";
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// 40 x 30 x 20 voxels of 2 mm from (-40, -30, -20) on, all 50 HU but the first, air.
inline std::string ctMha() {
  std::string voxels(40 * 30 * 20 * 2, '\0');
  for (std::size_t i = 0; i < voxels.size(); i += 2) voxels[i] = 50;
  voxels[0] = char(0x18);  // -1000
  voxels[1] = char(0xfc);
  voxels[2] = char(0xe8);  // 1000
  voxels[3] = char(0x03);
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "Offset = -40 -30 -20\nElementSpacing = 2 2 2\nDimSize = 40 30 20\n"
         "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
         voxels;
}

}  // namespace softscope::test
