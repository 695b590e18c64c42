// toolkit/figures/volume_arguments.h: options of a CT or MR volume, for every command that reads
// one.
#pragma once

#include <string>

#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

/// As the user wrote it.
struct VolumeArguments {
  std::string spacing;
  bool allow_missing_slices = false;

  /// Throws OptionError where the spacing is not three lengths above 0.
  VolumeOptions options() const;
};

}  // namespace softscope
