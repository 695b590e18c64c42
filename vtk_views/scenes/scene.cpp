// vtk_views/scenes/scene.cpp: boxes and colours.
#include "vtk_views/scenes/scene.h"

#include <algorithm>
#include <array>

namespace softscope {

Eigen::AlignedBox3d boxOf(const std::vector<SceneSurface>& surfaces) {
  Eigen::AlignedBox3d box;
  for (const SceneSurface& surface : surfaces)
    for (const Eigen::Vector3f& p : surface.mesh.vertices_mm)
      if (p.allFinite()) box.extend(p.cast<double>());
  return box;
}

Middle middleOf(const std::vector<SceneSurface>& surfaces) {
  Middle middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> places;
    for (const SceneSurface& surface : surfaces)
      for (const Eigen::Vector3f& p : surface.mesh.vertices_mm)
        if (p.allFinite()) places.push_back(p[axis]);
    if (places.empty()) return middle;
    const auto at = [&](double share) {
      const auto place = places.begin() + std::ptrdiff_t(share * double(places.size() - 1) + 0.5);
      std::nth_element(places.begin(), place, places.end());
      return double(*place);
    };
    middle.median_mm[axis] = at(0.5);
    middle.size_mm[axis] = at(0.99) - at(0.01);
  }
  return middle;
}

Eigen::AlignedBox3d boxOf(const Volume& volume) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector4d voxel(0, 0, 0, 1);
    for (int axis = 0; axis < 3; ++axis)
      voxel[axis] =
          (corner >> axis & 1) != 0 ? volume.facts.size_voxels[std::size_t(axis)] - 0.5 : -0.5;
    box.extend((volume.facts.lps_from_voxel * voxel).head<3>());
  }
  return box;
}

Rgb8 surfaceColour(std::size_t index) {
  constexpr std::array<Rgb8, 5> kSurfaceColours{
      {{240, 165, 0}, {60, 170, 235}, {0, 170, 125}, {215, 125, 175}, {235, 105, 20}}};
  return kSurfaceColours[index % kSurfaceColours.size()];
}

Rgb8 onWhite(Rgb8 c) {
  return {std::uint8_t(c.red * 4 / 5), std::uint8_t(c.green * 4 / 5), std::uint8_t(c.blue * 4 / 5)};
}

}  // namespace softscope
