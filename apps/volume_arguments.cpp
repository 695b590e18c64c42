#include "apps/volume_arguments.h"

#include "apps/figure_options.h"
#include "core/error.h"

namespace softscope {

void VolumeArguments::declare(ArgumentList& arguments) {
  arguments.option("--spacing", "X,Y,Z", spacing,
                   "of the volume's voxels along i, j, k in mm, where its file fails to say it");
  arguments.flag(
      "--allow-missing-slices", allow_missing_slices,
      "read a DICOM series that lacks slices, or has damaged ones: their place is empty");
}

VolumeOptions VolumeArguments::options() const {
  VolumeOptions options;
  options.allow_missing_slices = allow_missing_slices;
  if (spacing.empty()) return options;
  options.spacing_mm = parseVector(spacing, "--spacing");
  if (!(options.spacing_mm->minCoeff() >= 1e-4 && options.spacing_mm->maxCoeff() <= 1000))
    throw OptionError("--spacing is `" + spacing +
                      "`, but must be three lengths from 0.0001 to 1000 mm: 0.7,0.7,2");
  return options;
}

}  // namespace softscope
