#include "toolkit/figures/volume_arguments.h"

#include "core/error.h"
#include "toolkit/figures/figure_options.h"

namespace softscope {

VolumeOptions VolumeArguments::options() const {
  VolumeOptions options;
  options.allow_missing_slices = allow_missing_slices;
  if (spacing.empty()) return options;
  options.spacing_mm = parseVector(spacing, "`spacing=`");
  if (!(options.spacing_mm->minCoeff() >= 1e-4 && options.spacing_mm->maxCoeff() <= 1000))
    throw OptionError("`spacing=` is `" + spacing +
                      "`, but must be three lengths from 0.0001 to 1000 mm: 0.7,0.7,2");
  return options;
}

}  // namespace softscope
