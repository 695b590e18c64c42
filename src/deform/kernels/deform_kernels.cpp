// src/deform/kernels/deform_kernels.cpp: SIMD by the compiler's vector types; compiled once a set,
// with SOFTSCOPE_SIMD_SET naming it. Lane = node of the stencil, or row of a matrix.
#include "deform/kernels/deform_kernels.h"

#include <cstddef>
#include <cstring>

#include "deform/kernels/plane_term.h"
#include "deform/kernels/warp_points.h"

namespace softscope {
namespace {

using Double4 = double __attribute__((vector_size(32)));
using Float4 = float __attribute__((vector_size(16)));

inline Double4 splat(double x) { return Double4{x, x, x, x}; }

// From and to any address, by one unaligned instruction each.
template <class Vector, class Number>
inline Vector loadVector(const Number* p) {
  Vector x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
inline Double4 load(const double* p) { return loadVector<Double4>(p); }
inline void store(double* p, const Double4& x) { std::memcpy(p, &x, sizeof x); }
inline Double4 loadFloats(const float* p) {
  return __builtin_convertvector(loadVector<Float4>(p), Double4);
}
inline double sum(const Double4& x) { return (x[0] + x[1]) + (x[2] + x[3]); }
inline Vec3<Double4> splat3(const float* p) { return {splat(p[0]), splat(p[1]), splat(p[2])}; }

// --- points against planes: four nodes at once ---------------------------------------------------

/// The stencil's nodes in registers.
struct Nodes {
  Double4 linear[9];
  Vec3<Double4> rest;
  Vec3<Double4> moved;
};

inline Nodes loadNodes(const StencilState& state) {
  Nodes nodes;
  for (int i = 0; i < 9; ++i) nodes.linear[i] = load(state.linear[i]);
  nodes.rest = {load(state.rest[0]), load(state.rest[1]), load(state.rest[2])};
  nodes.moved = {load(state.moved[0]), load(state.moved[1]), load(state.moved[2])};
  return nodes;
}

void residuals(const StencilState& state, const PlaneConstraint* constraints, int count,
               double* out) {
  const Nodes nodes = loadNodes(state);
  for (int i = 0; i < count; ++i) {
    const PlaneConstraint& c = constraints[i];
    const auto turned = multiply(nodes.linear, subtract(splat3(c.point), nodes.rest));
    out[i] = sum(planeShare(turned, nodes.moved, splat3(c.target), splat3(c.normal),
                            loadFloats(c.node_weights)));
  }
}

template <int kUnknowns>
void planeRow(const Nodes& nodes, const PlaneConstraint& c, Double4* row);

template <>
inline void planeRow<6>(const Nodes& nodes, const PlaneConstraint& c, Double4* row) {
  const auto turned = multiply(nodes.linear, subtract(splat3(c.point), nodes.rest));
  rigidPlaneRow(turned, splat3(c.normal), loadFloats(c.node_weights), row);
}

template <>
inline void planeRow<12>(const Nodes& nodes, const PlaneConstraint& c, Double4* row) {
  affinePlaneRow(subtract(splat3(c.point), nodes.rest), splat3(c.normal),
                 loadFloats(c.node_weights), row);
}

/// Tile (a, b), a <= b, of J^T J: lane j of row i is the entry (unknown a of node i, unknown b of
/// node j).
struct Tile {
  Double4 rows[4];
};

template <int kUnknowns>
constexpr int tileIndex(int a, int b) {
  return a * kUnknowns - a * (a - 1) / 2 + b - a;
}

/// Adds `count` rows to `kWidth` tiles (a, b) .. (a, b + kWidth - 1).
template <int kUnknowns, int kWidth>
inline void addRows(const Double4* rows, int count, int a, int b, Tile* tiles) {
  Double4 total[kWidth][4];
  for (int w = 0; w < kWidth; ++w)
    for (int i = 0; i < 4; ++i) total[w][i] = tiles[w].rows[i];
  for (int r = 0; r < count; ++r) {
    const Double4* row = rows + r * kUnknowns;
    const double* left = reinterpret_cast<const double*>(row + a);
    for (int i = 0; i < 4; ++i) {
      const Double4 factor = splat(left[i]);
      for (int w = 0; w < kWidth; ++w) total[w][i] += factor * row[b + w];
    }
  }
  for (int w = 0; w < kWidth; ++w)
    for (int i = 0; i < 4; ++i) tiles[w].rows[i] = total[w][i];
}

template <int kUnknowns>
void addBatch(const Double4* rows, int count, Tile* tiles) {
  for (int a = 0; a < kUnknowns; ++a) {
    int b = a;
    for (; b + 3 <= kUnknowns; b += 3)
      addRows<kUnknowns, 3>(rows, count, a, b, tiles + tileIndex<kUnknowns>(a, b));
    if (kUnknowns - b == 2)
      addRows<kUnknowns, 2>(rows, count, a, b, tiles + tileIndex<kUnknowns>(a, b));
    else if (kUnknowns - b == 1)
      addRows<kUnknowns, 1>(rows, count, a, b, tiles + tileIndex<kUnknowns>(a, b));
  }
}

/// From tiles (nodes inside, unknowns outside) to blocks (unknowns inside, nodes outside).
template <int kUnknowns>
void tilesToBlocks(const Tile* tiles, double* blocks) {
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      for (int a = 0; a < kUnknowns; ++a)
        for (int b = 0; b < kUnknowns; ++b)
          *blocks++ = a <= b ? tiles[tileIndex<kUnknowns>(a, b)].rows[i][j]
                             : tiles[tileIndex<kUnknowns>(b, a)].rows[j][i];
    }
  }
}

template <int kUnknowns>
void assemble(const StencilState& state, const PlaneConstraint* constraints,
              const double* residuals, const double* weights, int count, double* blocks,
              double* gradient) {
  constexpr int kBatch = 32;  // rows of a batch stay in the first-level cache
  constexpr int kTiles = kUnknowns * (kUnknowns + 1) / 2;
  const Nodes nodes = loadNodes(state);
  Tile tiles[kTiles] = {};
  Double4 slope[kUnknowns] = {};
  Double4 rows[kBatch * kUnknowns];
  for (int first = 0; first < count; first += kBatch) {
    const int batch = count - first < kBatch ? count - first : kBatch;
    for (int r = 0; r < batch; ++r) {
      Double4* row = rows + r * kUnknowns;
      planeRow<kUnknowns>(nodes, constraints[first + r], row);
      const Double4 root = splat(__builtin_sqrt(weights[first + r]));
      const Double4 pull = root * splat(residuals[first + r]);
      for (int a = 0; a < kUnknowns; ++a) {
        row[a] *= root;
        slope[a] += row[a] * pull;
      }
    }
    addBatch<kUnknowns>(rows, batch, tiles);
  }
  tilesToBlocks<kUnknowns>(tiles, blocks);
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < kUnknowns; ++a) *gradient++ = slope[a][i];
}

// --- dense columns of the Cholesky factor, six at a time -----------------------------------------

constexpr int kTileColumns = 6;

template <int kVectors>
inline void updateStrip(double* c, std::ptrdiff_t leading_c, const double* a, const double* b,
                        std::ptrdiff_t leading, int inner) {
  Double4 total[kTileColumns][kVectors] = {};
  for (int k = 0; k < inner; ++k) {
    Double4 left[kVectors];
    for (int v = 0; v < kVectors; ++v) left[v] = load(a + k * leading + 4 * v);
    for (int j = 0; j < kTileColumns; ++j) {
      const Double4 factor = splat(b[k * leading + j]);
      for (int v = 0; v < kVectors; ++v) total[j][v] += left[v] * factor;
    }
  }
  for (int j = 0; j < kTileColumns; ++j)
    for (int v = 0; v < kVectors; ++v) {
      double* target = c + j * leading_c + 4 * v;
      store(target, load(target) - total[j][v]);
    }
}

void updateColumns(double* c, int leading_c, const double* a, const double* b, int leading,
                   int rows, int inner) {
  int row = 0;
  for (; row + 8 <= rows; row += 8) updateStrip<2>(c + row, leading_c, a + row, b, leading, inner);
  for (; row < rows; row += 4) updateStrip<1>(c + row, leading_c, a + row, b, leading, inner);
}

/// Cholesky of the top tile; inverse[j] = 1 / L(j, j).
bool factorTile(double* c, std::ptrdiff_t leading, double smallest, double* inverse) {
  for (int j = 0; j < kTileColumns; ++j) {
    double pivot = c[j + j * leading];
    for (int k = 0; k < j; ++k) pivot -= c[j + k * leading] * c[j + k * leading];
    if (!(pivot > smallest)) return false;  // NaN too
    c[j + j * leading] = __builtin_sqrt(pivot);
    inverse[j] = 1 / c[j + j * leading];
    for (int i = j + 1; i < kTileColumns; ++i) {
      double value = c[i + j * leading];
      for (int k = 0; k < j; ++k) value -= c[i + k * leading] * c[j + k * leading];
      c[i + j * leading] = value * inverse[j];
    }
  }
  return true;
}

bool factorColumns(double* c, int leading, int rows, double smallest) {
  const std::ptrdiff_t stride = leading;
  double inverse[kTileColumns];
  if (!factorTile(c, stride, smallest, inverse)) return false;
  for (int row = kTileColumns; row < rows; row += 4) {
    Double4 x[kTileColumns];
    for (int j = 0; j < kTileColumns; ++j) {
      x[j] = load(c + row + j * stride);
      for (int k = 0; k < j; ++k) x[j] -= x[k] * splat(c[j + k * stride]);
      x[j] *= splat(inverse[j]);
      store(c + row + j * stride, x[j]);
    }
  }
  return true;
}

void multiplySubtract(const double* a, int leading, int rows, int columns, const double* x,
                      double* y) {
  const std::ptrdiff_t stride = leading;
  int row = 0;
  for (; row + 8 <= rows; row += 8) {
    Double4 low = load(y + row), high = load(y + row + 4);
    for (int k = 0; k < columns; ++k) {
      low -= load(a + row + k * stride) * splat(x[k]);
      high -= load(a + row + 4 + k * stride) * splat(x[k]);
    }
    store(y + row, low);
    store(y + row + 4, high);
  }
  for (; row < rows; ++row)
    for (int k = 0; k < columns; ++k) y[row] -= a[row + k * stride] * x[k];
}

void multiplyTransposedSubtract(const double* a, int leading, int rows, int columns,
                                const double* y, double* x) {
  const std::ptrdiff_t stride = leading;
  for (int k = 0; k < columns; ++k) {
    const double* column = a + k * stride;
    Double4 low = {}, high = {};
    int row = 0;
    for (; row + 8 <= rows; row += 8) {
      low += load(column + row) * load(y + row);
      high += load(column + row + 4) * load(y + row + 4);
    }
    double total = sum(low + high);
    for (; row < rows; ++row) total += column[row] * y[row];
    x[k] -= total;
  }
}

}  // namespace

extern const DeformKernels SOFTSCOPE_NAME(deformKernels, SOFTSCOPE_SIMD_SET);
const DeformKernels SOFTSCOPE_NAME(deformKernels, SOFTSCOPE_SIMD_SET) = {
    SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET),
    residuals,
    assemble<6>,
    assemble<12>,
    updateColumns,
    factorColumns,
    multiplySubtract,
    multiplyTransposedSubtract,
    SOFTSCOPE_NAME(warpPoints, SOFTSCOPE_SIMD_SET),
};

}  // namespace softscope
