// src/io/documents/npy_file.h: NumPy arrays of floating-point numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/raster.h"

namespace softscope {

struct NpyArray {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;  // row-major, rows * columns
};

bool isNpy(std::string_view bytes);

/// Reads a two-dimensional array of <f4 or <f8 in C order. Throws InputError for other content.
NpyArray parseNpy(std::string_view bytes, const std::string& name);

/// As <f4 in C order.
std::string npyBytes(const Raster<float>& values);

}  // namespace softscope
