// src/io/sequences/view_similarity.h: similarity of two images of one scene.
#pragma once

#include "core/image.h"

namespace softscope {

/// Normalised cross-correlation (-1 to 1) of image details, without low frequencies.
struct ViewSimilarity {
  double unshifted = 0;
  double best = 0;  // over shifts of up to a quarter of the width
};

/// Requires equal sizes. Computed on copies with 128 columns.
ViewSimilarity viewSimilarity(const ColourImage& a, const ColourImage& b);

}  // namespace softscope
