// src/io/sequences/view_similarity.h: do two pictures show the same scene, shifted sideways?
#pragma once

#include "core/image.h"

namespace softscope {

/// Normalised cross-correlation (-1 to 1) of the pictures' details, without their slow shading.
struct ViewSimilarity {
  double unshifted = 0;
  double best = 0;  // over shifts of up to a quarter of the width
};

/// Both must have one shape. Works on copies of 128 columns.
ViewSimilarity viewSimilarity(const ColourImage& a, const ColourImage& b);

}  // namespace softscope
