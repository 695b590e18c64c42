// src/stereo/kernels/normal_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/kernels/normal_kernels.h"

#include "core/kernel_list.h"
#include "stereo/kernels/refinement_formulas.h"
#include "stereo/kernels/simd.h"

namespace softscope {
namespace {

constexpr float kNaN = __builtin_nanf(""), kInfinity = __builtin_inff();

void invertRow(const InverseDepthRow& row) {
  for (int u = 0; u < row.width; u += kFloatLanes) {
    const Floats z = loadFloats(row.depth_mm + u), inverse = 1.0f / z;
    store(row.inverse + u, inverse);
    store(row.weighted + u, z == z ? inverse : Floats{});
    store(row.measured + u, z == z ? broadcast(1) : Floats{});
  }
}

// A comparison with NaN is false: it is neither low nor high.
inline Floats lower(Floats x, Floats than) { return x < than ? x : than; }
inline Floats higher(Floats x, Floats than) { return x > than ? x : than; }

void findMixed(const float* const* rows, int radius, int width, float share, float* low,
               float* high, unsigned char* mixed) {
  for (int u = 0; u < width; u += kFloatLanes) {
    Floats lowest = broadcast(kInfinity), highest = broadcast(-kInfinity);
    for (int y = 0; y <= 2 * radius; ++y) {
      const Floats x = loadFloats(rows[y] + u);
      lowest = lower(x, lowest);
      highest = higher(x, highest);
    }
    store(low + u, lowest);
    store(high + u, highest);
  }
  for (int u = 0; u < width; u += kFloatLanes) {
    const Floats centre = loadFloats(rows[radius] + u);
    Floats lowest = centre, highest = centre;
    for (int x = -radius; x <= radius; ++x) {
      lowest = lower(loadFloats(low + u + x), lowest);
      highest = higher(loadFloats(high + u + x), highest);
    }
    const Ints found = (highest - centre > share * centre) | (centre - lowest > share * centre);
    for (int i = 0; i < kFloatLanes; ++i) mixed[u + i] = found[i] != 0;
  }
}

void solveNormals(const NormalRow& row) {
  for (int u = 0; u < row.width; u += kFloatLanes) {
    Floats m[kFirstEvidence];
    for (int k = 0; k < kFirstEvidence; ++k) m[k] = loadFloats(row.moments.sums[k] + u);
    // Rounded once: the same on every instruction set.
    const Floats du = (laneNumbers() + static_cast<float>(u)) - row.cx_px;
    const auto [x, y, z, determinant] = planeNormal(m, du, row.dv_px, row.fx_px, row.fy_px);
    const Floats inverse = loadFloats(row.inverse + u);
    const Ints holds = (inverse == inverse) & (m[0] >= row.fewest_pixels) & (determinant > 1e-3f);
    // Inverse depth is positive in front: -n faces the camera.
    const Floats scale = holds ? -1.0f / squareRoot(x * x + y * y + z * z) : broadcast(kNaN);
    store(row.normal[0] + u, x * scale);
    store(row.normal[1] + u, y * scale);
    store(row.normal[2] + u, z * scale);
  }
}

}  // namespace

extern const NormalKernels SOFTSCOPE_NAME(normalKernels, SOFTSCOPE_SIMD_SET);
const NormalKernels SOFTSCOPE_NAME(normalKernels, SOFTSCOPE_SIMD_SET) = {invertRow, findMixed,
                                                                         solveNormals};

}  // namespace softscope
