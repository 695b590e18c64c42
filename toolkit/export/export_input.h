// toolkit/export/export_input.h: input of `softscope export`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model_surface.h"

namespace softscope {

/// A model of a run, and when it was so.
struct SavedModel {
  std::filesystem::path file;
  int frame = -1;  // -1: the last
  double time_s = 0;
};

/// All saved models of a run, every `every`-th of them. Throws InputError where there is none,
/// OptionError unless `every` is 1 or more.
std::vector<SavedModel> savedModels(const std::filesystem::path& run, int every);

/// The run's model of `frame`, or its last one where that is -1. Throws InputError; OptionError for
/// a frame that wasn't saved, naming those that were.
SavedModel savedModel(const std::filesystem::path& run, int frame);

/// Points (a PLY, as `reconstruct` and `depth` write it) with all they have, or a mesh (PLY, STL,
/// OBJ, VTP, VTK) with its colours. mm. Throws InputError.
ModelSurface readModelSurface(const std::filesystem::path& file, double unit_mm);

}  // namespace softscope
