// src/stereo/refinement/grey_foreground.h: smoke and instruments before red tissue.
#pragma once

#include "core/camera.h"
#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// 1 where `depth_mm` is that of a surface without red, apart from the tissue: of smoke before an
/// unlit background, which has texture of its own, or of an instrument. Judged in blocks of an 80th
/// of the image width: grey has a quarter of the redness of the red blocks, and is apart where it
/// is nearer than the closest tissue and no path over measured blocks, less steep than 70 degrees,
/// leads to tissue. Empty if the image has few red blocks. `depth_mm` is NaN if unmeasured. Throws
/// Error if the shapes differ.
Mask greyForeground(const ColourImage& left, const Raster<float>& depth_mm,
                    const PinholeCamera& camera);

}  // namespace softscope
