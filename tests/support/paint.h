// tests/support/paint.h: rectangles of one colour.
#pragma once

#include "core/image.h"

namespace softscope::test {

/// Columns u0 to u1 - 1 of rows v0 to v1 - 1.
inline void paint(ColourImage* image, int u0, int v0, int u1, int v1, Rgb8 colour) {
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) image->at(u, v) = colour;
}

}  // namespace softscope::test
