// toolkit/figures/volume_arguments.h: options
// of a CT or MR volume, common to all commands.
#pragma once

#include <string>

#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

/// Text as given.
struct VolumeArguments {
  std::string spacing;
  bool allow_missing_slices = false;

  /// Throws OptionError unless the spacing is three positive lengths.
  VolumeOptions options() const;
};

}  // namespace softscope
