// toolkit/run/model_file.h: a reconstructed model from its file, fast.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/length_unit.h"
#include "core/point_model.h"

namespace softscope {

/// A model as far as its file tells it: no bindings, anchors that are the colours' own brightness,
/// and zeros for what the file lacks.
struct ModelFile {
  PointModel model;
  bool coloured = false, with_normals = false, weighted = false;
  std::vector<float> sigmas_mm;  // predicted standard errors; empty where the file has none
  double unit_mm = 1;            // length of one unit of the positions in the file
};

/// Reads a binary little-endian PLY whose vertices have float x, y, z and, one after the other as
/// well, maybe nx, ny, nz (float), red, green, blue (uchar), weight and sigma_mm (float), as
/// `reconstruct` writes it. Throws InputError: not such a file, cut short, no point at all, or a
/// point that is not finite or beyond 1 km. `unit_mm`: of the positions; sigma_mm is always in mm.
ModelFile readModel(const std::filesystem::path& file);
ModelFile parseModel(std::string_view bytes, const std::string& name, double unit_mm = kUnitOfFile);

}  // namespace softscope
