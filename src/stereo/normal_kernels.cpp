// src/stereo/normal_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/normal_kernels.h"

#include "stereo/simd.h"

namespace softscope {
namespace {

constexpr float kNaN = __builtin_nanf(""), kInfinity = __builtin_inff();

void invertRow(const InverseDepthRow& row) {
  for (int u = 0; u < row.width; u += 8) {
    const Float8 z = load8(row.depth_mm + u), inverse = 1.0f / z;
    store8(row.inverse + u, inverse);
    store8(row.weighted + u, z == z ? inverse : Float8{});
    store8(row.measured + u, z == z ? broadcast8(1) : Float8{});
  }
}

// A comparison with NaN is false: it counts neither as low nor as high.
inline Float8 lower(Float8 x, Float8 than) { return x < than ? x : than; }
inline Float8 higher(Float8 x, Float8 than) { return x > than ? x : than; }

void findMixed(const float* const* rows, int radius, int width, float share, float* low,
               float* high, unsigned char* mixed) {
  for (int u = 0; u < width; u += 8) {
    Float8 lowest = broadcast8(kInfinity), highest = broadcast8(-kInfinity);
    for (int y = 0; y <= 2 * radius; ++y) {
      const Float8 x = load8(rows[y] + u);
      lowest = lower(x, lowest);
      highest = higher(x, highest);
    }
    store8(low + u, lowest);
    store8(high + u, highest);
  }
  for (int u = 0; u < width; u += 8) {
    const Float8 centre = load8(rows[radius] + u);
    Float8 lowest = centre, highest = centre;
    for (int x = -radius; x <= radius; ++x) {
      lowest = lower(load8(low + u + x), lowest);
      highest = higher(load8(high + u + x), highest);
    }
    const Int8 found = (highest - centre > share * centre) | (centre - lowest > share * centre);
    for (int i = 0; i < 8; ++i) mixed[u + i] = found[i] != 0;
  }
}

void solveNormals(const NormalRow& row) {
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; u += 8) {
    const Float8 a = load8(m[0] + u), b = load8(m[1] + u), c = load8(m[2] + u), d = load8(m[3] + u),
                 e = load8(m[4] + u), f = load8(m[5] + u);
    const Float8 w = load8(m[6] + u), xw = load8(m[7] + u), yw = load8(m[8] + u);
    // The adjugate times the right side: the plane up to a positive factor.
    const Float8 c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d, c11 = a * f - c * c,
                 c12 = b * c - a * e, c22 = a * d - b * b;
    const Float8 determinant = a * c00 + b * c01 + c * c02;
    const Float8 p0 = c00 * w + c01 * xw + c02 * yw, pu = c01 * w + c11 * xw + c12 * yw,
                 pv = c02 * w + c12 * xw + c22 * yw;
    const Float8 du = lanes8() + (static_cast<float>(u) - row.cx_px);
    const Float8 x = pu * row.fx_px, y = pv * row.fy_px, z = p0 - pu * du - pv * row.dv_px;
    const Float8 inverse = load8(row.inverse + u);
    const Int8 holds = (inverse == inverse) & (a >= row.fewest_pixels) & (determinant > 1e-3f);
    // Inverse depth is positive in front: -n faces the camera.
    const Float8 scale = holds ? -1.0f / squareRoot(x * x + y * y + z * z) : broadcast8(kNaN);
    store8(row.normal[0] + u, x * scale);
    store8(row.normal[1] + u, y * scale);
    store8(row.normal[2] + u, z * scale);
  }
}

}  // namespace

extern const NormalKernels SOFTSCOPE_NAME(normalKernels, SOFTSCOPE_SIMD_SET);
const NormalKernels SOFTSCOPE_NAME(normalKernels, SOFTSCOPE_SIMD_SET) = {invertRow, findMixed,
                                                                         solveNormals};

}  // namespace softscope
