// src/deform/kernels/deform_kernels.h: the inner loops of deformation, compiled once for each
// instruction set.
//
// Raw pointers only: a header-only container compiled here with AVX2 could be picked by the linker
// for the whole program. The AVX2 set uses fused multiply-add, so its last bits differ from the
// baseline's; within a set the result is the same whatever the number of threads.
#pragma once

#include <cstdint>

#include "core/kernel_list.h"

namespace softscope {

/// n . (warped point - target), times a base weight: docs/energy.md (8). mm. 56 bytes.
struct PlaneConstraint {
  float point[3];   // before the warp
  float normal[3];  // of the target's plane
  float target[3];
  float node_weights[4];
  float weight;  // of the squared residual, before any robust weight
};

/// The four nodes of a stencil in parallel: A row by row, g, g + t.
struct StencilState {
  double linear[9][4];
  double rest[3][4];
  double moved[3][4];
};

/// The ten blocks (i, j), i <= j, of the normal equations of a
/// stencil, in this order: 00 01 02 03 11 12 13 22 23 33. Block
/// (i, j) has rows of node j, columns of node i, column-major.
constexpr int kStencilBlocks = 10;

/// Float copy of a node for warping points: columns of A - I, then
/// g + t - A g; every fourth unused. Displacements, not positions,
/// are blended: weights with a sum of 1 + 1e-7 do not cause drift.
struct PackedNode {
  float values[16];
};

struct DeformKernels {
  const char* instruction_set;

  /// Unweighted residuals of `count` constraints of one stencil.
  void (*residuals)(const StencilState& nodes, const PlaneConstraint* constraints, int count,
                    double* out);

  /// J^T J (10 blocks) and J^T r (4 x unknowns) of `count` constraints of one stencil,
  /// each weighted by weights[i] (base and robust). Overwrites blocks and gradient.
  void (*assembleRigid)(const StencilState& nodes, const PlaneConstraint* constraints,
                        const double* residuals, const double* weights, int count, double* blocks,
                        double* gradient);
  void (*assembleAffine)(const StencilState& nodes, const PlaneConstraint* constraints,
                         const double* residuals, const double* weights, int count, double* blocks,
                         double* gradient);

  /// C (rows x 6) -= A (rows x inner) B (6 x inner)^T, column-major; A and B share `leading`.
  /// May write up to 3 rows more: leading dimensions leave room for them.
  void (*updateColumns)(double* c, int leading_c, const double* a, const double* b, int leading,
                        int rows, int inner);
  /// Cholesky of the top 6 x 6 of C (rows x 6), the rows below multiplied by its inverse
  /// transposed. False where a pivot is not above `smallest`.
  bool (*factorColumns)(double* c, int leading, int rows, double smallest);
  /// y (rows) -= A (rows x columns) x.
  void (*multiplySubtract)(const double* a, int leading, int rows, int columns, const double* x,
                           double* y);
  /// x (columns) -= A^T y.
  void (*multiplyTransposedSubtract)(const double* a, int leading, int rows, int columns,
                                     const double* y, double* x);

  /// Warps `count` points and normals: xyz triples, mm. stencil_of: index into stencils (4 node ids
  /// each) and then 4 floats of weights, `binding_stride` bytes apart; below 0: not warped.
  void (*warpPoints)(const PackedNode* nodes, const std::int32_t* stencils, const void* bindings,
                     int binding_stride, const float* positions, const float* normals, int count,
                     float* out_positions, float* out_normals);
};

/// The fastest set supported by this processor.
const DeformKernels& deformKernels();

/// Sets supported by this processor, slowest first.
KernelList<DeformKernels> allDeformKernels();

}  // namespace softscope
