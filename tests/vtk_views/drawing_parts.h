// tests/vtk_views/drawing_parts.h: what a vector drawing is made of.
#pragma once

#include <variant>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Those of one kind, in the order in which they are drawn.
template <class Part>
std::vector<Part> partsOf(const VectorDrawing& drawing) {
  std::vector<Part> parts;
  for (const auto& part : drawing.parts)
    if (const Part* found = std::get_if<Part>(&part)) parts.push_back(*found);
  return parts;
}

}  // namespace softscope
