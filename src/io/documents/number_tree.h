// src/io/documents/number_tree.h: matrices of numbers in a document.
#pragma once

#include <string>
#include <vector>

#include "io/documents/document.h"

namespace softscope {

/// All numbers in the order of the file: of a text with blanks, of nested lists, or of a map with
/// rows, cols and data (OpenCV and ROS), whose counts must agree.
/// `what` names it in errors: "calib.yaml: M1". Throws InputError where something is no number.
std::vector<double> numbersOf(const Document& document, const std::string& what);

}  // namespace softscope
