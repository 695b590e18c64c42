#include "features/dense_surf.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"
#include "core/parallel.h"
#include "features/integral_image.h"
#include "features/kernels.h"
#include "features/surf_formulas.h"

namespace softscope {
namespace {

constexpr int kSums = kSurfSums;

struct Integrals {
  Raster<std::int32_t> gray, invalid;
};

Integrals integralsOf(const GrayImage& image, const Mask& ignore) {
  Integrals out;
  const auto gray = [](std::uint8_t value) { return static_cast<std::int32_t>(value); };
  const auto marked = [](std::uint8_t value) { return value != 0 ? 1 : 0; };
  parallelInvoke([&] { out.gray = integralImage(image, gray); },
                 [&] {
                   out.invalid = ignore.empty() ? Raster<std::int32_t>(image.width_px + 1,
                                                                       image.height_px + 1, 0)
                                                : integralImage(ignore, marked);
                 });
  return out;
}

/// Sums of the wavelets per grid square.
struct Squares {
  Raster<std::int32_t> sums;   // kSums values a square: width is kSums * columns
  Raster<std::int32_t> valid;  // wavelets of the square without ignored pixels
};

/// Wavelets of one row of pixels; 0 if they exceed the image.
struct WaveletRow {
  explicit WaveletRow(int width) : du(static_cast<std::size_t>(width), 0), dv(du), valid(du) {}
  std::vector<std::int32_t> du, dv, valid;

  void compute(const Integrals& integrals, int v, int h, int count) {
    featureKernels().haarRow(integrals.gray.row(v - h) + h, integrals.gray.row(v) + h,
                             integrals.gray.row(v + h) + h, integrals.invalid.row(v - h) + h,
                             integrals.invalid.row(v + h) + h, h, count, du.data() + h,
                             dv.data() + h, valid.data() + h);
  }
};

void addRow(const WaveletRow& row, int grid, int columns, std::int32_t* sums, std::int32_t* valid) {
  for (int c = 0; c < columns; ++c)
    for (int k = c * grid; k < (c + 1) * grid; ++k) {
      const std::size_t u = static_cast<std::size_t>(k);
      sums[kSums * c] += row.du[u];
      sums[kSums * c + 1] += std::abs(row.du[u]);
      sums[kSums * c + 2] += row.dv[u];
      sums[kSums * c + 3] += std::abs(row.dv[u]);
      valid[c] += row.valid[u];
    }
}

Squares squaresOf(const Integrals& integrals, int width, int height,
                  const DenseSurfOptions& options) {
  const int grid = options.kGridPx, h = options.kWaveletPx / 2;
  const int columns = width / grid, rows = height / grid;
  Squares out{Raster<std::int32_t>(kSums * columns, rows, 0),
              Raster<std::int32_t>(columns, rows, 0)};
  parallelRanges(rows, 8, [&](int begin, int end) {
    WaveletRow wavelets(width + 1);
    for (int r = begin; r < end; ++r)
      for (int v = r * grid; v < (r + 1) * grid; ++v) {
        if (v < h || v > height - h) continue;
        wavelets.compute(integrals, v, h, width - 2 * h + 1);
        addRow(wavelets, grid, columns, out.sums.row(r), out.valid.row(r));
      }
  });
  return out;
}

/// Sums over `reach` x `reach` squares that begin at each square.
struct Cells {
  Raster<float> sums;  // kSums values per cell
  Raster<std::int32_t> valid;
};

template <class To, class From>
Raster<To> boxSums(const Raster<From>& in, int reach, int channels) {
  const int columns = in.width_px / channels - reach + 1, rows = in.height_px - reach + 1;
  Raster<To> out(channels * columns, rows);
  parallelRows(rows, [&](int r) {
    std::vector<From> upright(in.row(r), in.row(r) + in.width_px);
    for (int y = 1; y < reach; ++y)
      for (int k = 0; k < in.width_px; ++k) upright[static_cast<std::size_t>(k)] += in.at(k, r + y);
    for (int k = 0; k < out.width_px; ++k) {
      From sum = 0;
      for (int x = 0; x < reach; ++x) sum += upright[static_cast<std::size_t>(k + x * channels)];
      out.at(k, r) = static_cast<To>(sum);
    }
  });
  return out;
}

void describeRow(const Cells& cells, const SurfRules& rules, int r, DenseDescriptors* out) {
  const int step = kSums * rules.reach;
  for (int c = 0; c < out->columns(); ++c) {
    const float* rows[kSurfCells];
    int valid = 0;
    float absolute = 0;
    for (int i = 0; i < kSurfCells; ++i) {
      rows[i] = cells.sums.row(r + i * rules.reach) + kSums * c;
      for (int j = 0; j < kSurfCells; ++j) {
        valid += cells.valid.at(c + j * rules.reach, r + i * rules.reach);
        absolute += rows[i][j * step + 1] + rows[i][j * step + 3];
      }
    }
    const std::size_t node = static_cast<std::size_t>(r) * out->columns() + c;
    featureKernels().describe(rows, step, out->bytes.data() + kDescriptorSize * node);
    out->contrast_gray.values[node] = absolute * rules.gray_per_sum;
    out->valid.values[node] = isDistinct(valid, out->contrast_gray.values[node], rules);
  }
}

}  // namespace

DenseDescriptors denseSurf(const GrayImage& image, const Mask& ignore,
                           const DenseSurfOptions& options) {
  if (!ignore.empty() && !ignore.sameShape(image))
    throw Error("dense SURF: the mask has another shape than the image");
  const SurfRules rules = surfRules(options);
  DenseDescriptors out;
  out.grid_px = options.kGridPx;
  out.first_px = rules.first_px;
  const int columns = surfNodes(image.width_px, options),
            rows = surfNodes(image.height_px, options);
  if (columns == 0 || rows == 0) return out;

  const Squares squares =
      squaresOf(integralsOf(image, ignore), image.width_px, image.height_px, options);
  const Cells cells{boxSums<float>(squares.sums, rules.reach, kSums),
                    boxSums<std::int32_t>(squares.valid, rules.reach, 1)};
  out.valid = Raster<std::uint8_t>(columns, rows, 0);
  out.contrast_gray = Raster<float>(out.columns(), out.rows());
  out.bytes.resize(kDescriptorSize * out.valid.size());
  parallelRows(out.rows(), [&](int r) { describeRow(cells, rules, r, &out); });
  return out;
}

}  // namespace softscope
