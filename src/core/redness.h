// src/core/redness.h: how red a colour is, whatever its brightness.
#pragma once

namespace softscope {

/// (R - (G + B) / 2) / (R + G + B), from the red channel and the sum of all three; 0 for black.
inline float redness(int red, int all) {
  return all > 0 ? static_cast<float>(3 * red - all) / static_cast<float>(2 * all) : 0;
}

}  // namespace softscope
