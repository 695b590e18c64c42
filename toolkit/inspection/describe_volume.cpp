// toolkit/inspection/describe_volume.cpp: facts about a CT or MR volume.
#include "toolkit/inspection/describe_file.h"
#include "toolkit/record/statistics_json.h"
#include "vtk_views/volumes/volume_summary.h"

namespace softscope {
namespace {

template <class Values>
std::string times(const Values& values, int decimals) {
  return fixed(values[0], decimals) + " x " + fixed(values[1], decimals) + " x " +
         fixed(values[2], decimals);
}

void addGeometry(const VolumeSummary& volume, FactSheet& facts) {
  facts.add("size", times(volume.size_voxels, 0) + " voxels", "size_voxels", volume.size_voxels);
  facts.add("spacing", times(volume.spacing_mm, 4) + " mm", "spacing_mm", volume.spacing_mm);
  std::array<double, 3> extent_mm{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    extent_mm[axis] = volume.spacing_mm[axis] * volume.size_voxels[axis];
  facts.add("extent", times(extent_mm, 1) + " mm", "extent_mm", extent_mm);
  const auto origin = volume.lps_from_voxel.col(3);
  facts.add(
      "first voxel at",
      fixed(origin[0], 2) + ", " + fixed(origin[1], 2) + ", " + fixed(origin[2], 2) + " mm (LPS)",
      "origin_lps_mm", {origin[0], origin[1], origin[2]});
  facts.add("axes run to", volume.axes + " (L left, P back, S head, R right, A front, I feet)",
            "axes", volume.axes);
  facts.add("header's space", "file_space", volume.file_space);
  facts.addQuietly("lps_from_voxel", matrixJson(volume.lps_from_voxel));
}

}  // namespace

FactSheet describeVolume(const std::string& path, const VolumeOptions& options) {
  const VolumeSummary volume = summariseVolume(path, options);
  FactSheet facts(path + ": a volume, " + volume.format);
  facts.addQuietly("kind", "volume");
  facts.addQuietly("format", volume.format);
  addGeometry(volume, facts);
  facts.add("voxels",
            volume.scalar_type +
                (volume.components > 1 ? ", " + std::to_string(volume.components) + " each" : ""),
            "scalar_type", volume.scalar_type);
  facts.addQuietly("components", volume.components);
  facts.add("values", fixed(volume.value_range[0], 1) + " to " + fixed(volume.value_range[1], 1),
            "value_range", volume.value_range);
  for (const auto& [name, value] : volume.details) facts.add(name, name, value);
  for (const auto& [name, value] : volume.patient)
    facts.add("patient " + name, value, "patient." + name, value);
  for (const std::string& warning : volume.warnings) facts.warn(warning);
  return facts;
}

}  // namespace softscope
