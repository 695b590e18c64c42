// src/features/look_search.h: position of one window of a first look in an image.
#pragma once

#include "features/first_look.h"
#include "features/look_formulas.h"

namespace softscope {

/// Moves the search from its place to that where the image shows the window; false if it is not
/// found. `expected_map`: of the place that is expected; the search may start with another one.
bool findWindow(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                const double (&expected_map)[4], LookSearch* search);

}  // namespace softscope
