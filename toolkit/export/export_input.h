// toolkit/export/export_input.h: input of `softscope export`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model_surface.h"

namespace softscope {

/// Model of a run with its time.
struct SavedModel {
  std::filesystem::path file;
  int frame = -1;  // -1: the last
  double time_s = 0;
};

/// Every `every`-th saved model of a run. Throws InputError
/// if there is none, OptionError for `every` below 1.
std::vector<SavedModel> savedModels(const std::filesystem::path& run, int every);

/// Model of `frame`, or the last model for -1. Throws InputError; OptionError
/// for a frame without a saved model, with the list of saved frames.
SavedModel savedModel(const std::filesystem::path& run, int frame);

/// Points (a PLY of `reconstruct` or `depth`) with all attributes, or a
/// mesh (PLY, STL, OBJ, VTP, VTK) with its colours. mm. Throws InputError.
ModelSurface readModelSurface(const std::filesystem::path& file, double unit_mm);

}  // namespace softscope
