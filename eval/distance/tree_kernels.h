// eval/distance/tree_kernels.h: the search in the triangle tree, compiled once for each instruction
// set.
//
// Raw pointers only: a header-only container compiled with AVX2 could be picked by the linker for
// the whole program. The float search only proposes; a double test without contraction decides, so
// every set gives the same bytes.
#pragma once

#include <cstdint>

#include "eval/distance/tree_layout.h"

namespace softscope {

/// One implementation of the search.
struct TreeKernels {
  const char* name;
  /// Finds the closest triangle of points order[begin] to order[end - 1] (x y z each, finite) and
  /// writes hits at the same places as the points. Among equally close triangles the lowest wins.
  void (*search)(const TreeView& tree, const float* points_mm, const std::uint32_t* order,
                 int begin, int end, TreeHit* hits);
};

struct TreeKernelList {
  const TreeKernels* sets[2];
  int count;
};

/// What this processor runs, the fastest last.
TreeKernelList allTreeKernels();

/// The fastest that this processor runs.
const TreeKernels& treeKernels();

}  // namespace softscope
