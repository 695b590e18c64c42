// src/stereo/depth/normals_from_depth.cpp: a plane fitted to the inverse depth around every pixel.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/kernels/refinement_formulas.h"
#include "stereo/kernels/stereo_kernels.h"
#include "stereo/refinement/plane.h"

namespace softscope {
namespace {

constexpr int kHeight = 2 * kNormalReach + 1;
constexpr int kNormalBandRows = 60;  // solved by one thread at a time
constexpr float kBox[kHeight] = {1, 1, 1, 1, 1, 1, 1};

/// Pixels of a window that count, for selectedMoments().
struct Selection {
  Selection() {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kSelectLanes; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * kSelectLanes + x);
        window[i] = x < kHeight ? 1.0f : 0.0f;
        tolerance[i] = x < kHeight ? kNormalDepthStep : std::numeric_limits<float>::infinity();
      }
  }
  std::array<float, kHeight * kSelectLanes> window, tolerance;
};

/// A band of rows, from top to bottom; only the rows of the window are held.
class NormalBand {
 public:
  NormalBand(const Raster<float>& depth_mm, const PinholeCamera& camera, NormalMap& normals)
      : depth_(depth_mm),
        camera_(camera),
        normals_(normals),
        width_(depth_mm.width_px),
        inverse_(width_, kHeight, kNotMeasured<float>, 0),
        weighted_(width_, kHeight, 0, 0),
        measured_(width_, kHeight, 0, 0),
        columns_(width_, kColumnMomentCount, 0, 0),
        moments_(width_, kMomentCount, 0, 0),
        range_(width_, 2, kNotMeasured<float>, 0),
        normal_(width_, 3, 0, 0),
        mixed_(static_cast<std::size_t>(width_ + Plane::kMargin)) {}

  void solve(int begin, int end) {
    for (int v = begin - kNormalReach; v < end + kNormalReach; ++v) {
      invert(v);
      if (v - kNormalReach >= begin) solveRow(v - kNormalReach);
    }
  }

 private:
  using RowsOfWindow = std::array<const float*, kHeight>;
  static int slot(int v) { return (v + kHeight) % kHeight; }

  void invert(int v) {
    float* depth = normal_.row(0);  // not yet in use
    std::fill_n(depth, width_ + Plane::kMargin, kNotMeasured<float>);
    if (v >= 0 && v < depth_.height_px) std::copy_n(depth_.row(v), width_, depth);
    normalKernels().invertRow(
        {depth, width_, inverse_.row(slot(v)), weighted_.row(slot(v)), measured_.row(slot(v))});
  }

  static RowsOfWindow rowsAround(const Plane& plane, int v) {
    RowsOfWindow rows;
    for (int y = 0; y < kHeight; ++y)
      rows[static_cast<std::size_t>(y)] = plane.row(slot(v - kNormalReach + y));
    return rows;
  }

  void solveRow(int v) {
    const RowsOfWindow measured = rowsAround(measured_, v), weighted = rowsAround(weighted_, v);
    MomentRow moments;
    for (int k = 0; k < kMomentCount; ++k) moments.sums[k] = moments_.row(k);
    float* columns[kColumnMomentCount];
    for (int k = 0; k < kColumnMomentCount; ++k) columns[k] = columns_.row(k);
    const RefinementKernels& kernels = refinementKernels();
    kernels.columnMoments(measured.data(), weighted.data(), kBox, kNormalReach, width_, columns);
    kernels.rowMoments(columns, kBox, kNormalReach, width_, moments);
    selectWindows(v, moments, measured, weighted);
    normalKernels().solveNormals({moments,
                                  inverse_.row(slot(v)),
                                  width_,
                                  kFewestNormalPixels,
                                  static_cast<float>(camera_.fx_px),
                                  static_cast<float>(camera_.fy_px),
                                  static_cast<float>(camera_.cx_px),
                                  static_cast<float>(v - camera_.cy_px),
                                  {normal_.row(0), normal_.row(1), normal_.row(2)}});
    const float *x = normal_.row(0), *y = normal_.row(1), *z = normal_.row(2);
    for (int u = 0; u < width_; ++u) normals_.at(u, v) = {x[u], y[u], z[u]};
  }

  /// If a window reaches across a step, only the pixels of the centre's surface count.
  void selectWindows(int v, const MomentRow& moments, const RowsOfWindow& measured,
                     const RowsOfWindow& weighted) {
    const RowsOfWindow inverse = rowsAround(inverse_, v);
    normalKernels().findMixed(inverse.data(), kNormalReach, width_, kNormalDepthStep, range_.row(0),
                              range_.row(1), mixed_.data());
    columns_mixed_.clear();
    for (int u = 0; u < width_; ++u)
      if (mixed_[static_cast<std::size_t>(u)] != 0) columns_mixed_.push_back(u);
    if (columns_mixed_.empty()) return;
    refinementKernels().selectedMoments({inverse.data(),
                                         measured.data(),
                                         weighted.data(),
                                         {},
                                         selection_.window.data(),
                                         selection_.tolerance.data(),
                                         true,
                                         kNormalReach},
                                        columns_mixed_.data(),
                                        static_cast<int>(columns_mixed_.size()), moments);
  }

  const Raster<float>& depth_;
  const PinholeCamera& camera_;
  NormalMap& normals_;
  int width_;
  Plane inverse_, weighted_, measured_, columns_, moments_, range_, normal_;
  std::vector<unsigned char> mixed_;
  std::vector<int> columns_mixed_;
  Selection selection_;
};

}  // namespace

NormalMap normalsFromDepth(const Raster<float>& depth_mm, const PinholeCamera& camera) {
  NormalMap normals(depth_mm.width_px, depth_mm.height_px, Eigen::Vector3f::Zero());
  parallelRanges(depth_mm.height_px, kNormalBandRows, [&](int begin, int end) {
    NormalBand(depth_mm, camera, normals).solve(begin, end);
  });
  return normals;
}

}  // namespace softscope
