// eval/distance/tree_kernels.h: the search in the triangle tree, compiled once for each instruction
// set.
//
// Raw pointers only: a header-only container compiled with AVX2 could be picked by the linker for
// the whole program. The float search only proposes; a double test without contraction decides, so
// every set gives the same bytes.
#pragma once

#include <cstdint>

#include "core/kernel_list.h"
#include "eval/distance/tree_layout.h"

namespace softscope {

/// Implementation of the search for one instruction set.
struct TreeKernels {
  const char* name;
  /// Finds the closest triangle of points order[begin] to order[end - 1] (x y z each, finite);
  /// writes hits at the indices of the points. Of equally close triangles, the lowest index.
  void (*search)(const TreeView& tree, const float* points_mm, const std::uint32_t* order,
                 int begin, int end, TreeHit* hits);
};

/// Those supported by this processor, the fastest last.
KernelList<TreeKernels> allTreeKernels();

/// The fastest supported by this processor.
const TreeKernels& treeKernels();

}  // namespace softscope
