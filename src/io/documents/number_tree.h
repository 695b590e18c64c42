// src/io/documents/number_tree.h: matrices of numbers in a document.
#pragma once

#include <string>
#include <vector>

#include "io/documents/document.h"

namespace softscope {

/// All numbers in the order of the file: from a text with blanks, nested lists, or
/// a map with rows, cols and data (OpenCV and ROS) with consistent counts. `what`:
/// name in errors: "calib.yaml: M1". Throws InputError for an invalid number.
std::vector<double> numbersOf(const Document& document, const std::string& what);

}  // namespace softscope
