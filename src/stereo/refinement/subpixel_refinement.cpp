#include "stereo/refinement/subpixel_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"
#include "stereo/kernels/stereo_kernels.h"
#include "stereo/refinement/depth_steps.h"
#include "stereo/refinement/plane.h"
#include "stereo/refinement/refinement_window.h"
#include "stereo/refinement/smooth_relief.h"
#include "stereo/refinement/uneven_windows.h"

namespace softscope {
namespace {

constexpr int kBandRows = 80;  // solved by one thread at a time

/// Shared by all bands: the images, the window, and the weights.
struct RefinementContext {
  RefinementContext(const GrayImage& left_image, const GrayImage& right_image,
                    const RefinementOptions& refinement)
      : options(refinement),
        width(left_image.width_px),
        height(left_image.height_px),
        left(splitBrightness(left_image, refinement.highpass_sigma_px)),
        right(splitBrightness(right_image, refinement.highpass_sigma_px)),
        window(refinementWindow(refinement)),
        limits(planeLimits(refinement)) {}

  RefinementOptions options;
  int width, height;
  BrightnessParts left, right;
  RefinementWindow window;
  PlaneLimits limits;
};

/// EvidenceCentre of every pixel.
struct EvidenceCentres {
  EvidenceCentres(int width, int height) : beside(width, height), below(width, height) {}
  Plane beside, below;
};

/// Of the last step: standard errors of the planes, and reliefResponse().
struct StepErrors {
  StepErrors(int width, int height) : sigma(width, height), response(width, height) {}
  Plane sigma, response;
};

/// A band of rows, solved from top to bottom. Only the rows
/// of a window are held, so that they stay in the cache.
class Band {
 public:
  /// Input and output of a step.
  struct Step {
    const LightDifference& light;
    const Plane& disparity;
    Plane& next;
    RefinementStep rules;
    StepErrors* errors;           // null but in the last step, which is complete
    EvidenceCentres* centres;     // null if they are not wanted
    Raster<std::uint8_t>& mixed;  // windows that may contain two surfaces; after the first step: do
    bool first;                   // mixed windows, slow to solve, wait for the next step
  };

  Band(const RefinementContext& context, const Step& step)
      : context_(context),
        radius_(context.options.radius_px),
        width_(context.width),
        light_(step.light),
        disparity_(step.disparity),
        next_(step.next),
        rules_(step.rules),
        residual_limits_(residualLimits(context.options, step.rules)),
        errors_(step.errors),
        centres_(step.centres),
        mixed_(step.mixed),
        first_(step.first),
        pixels_(step.errors == nullptr ? kTarget + 1 : kPixelPlanes, Plane(width_, height(), 0, 0)),
        columns_(width_, kColumnMomentCount, 0, 0),
        moments_(width_, kMomentCount, 0, 0) {}

  void solve(int begin, int end) {
    for (int v = begin - radius_; v < end + radius_; ++v) {
      linearise(v);
      if (v - radius_ >= begin) solveRow(v - radius_);
    }
  }

 private:
  enum { kInformation, kTarget, kResidualSq, kWeight, kDifferenceSq, kEnergy, kPixelPlanes };
  using RowsOfWindow = std::array<const float*, 2 * RefinementOptions::kLargestRadiusPx + 1>;

  int height() const { return 2 * radius_ + 1; }
  int slot(int v) const { return (v + height()) % height(); }

  /// Residual and gradient of every pixel of a row at its current disparity.
  void linearise(int v) {
    const auto pixel = [&](int plane) {
      return errors_ == nullptr && plane > kTarget ? nullptr : pixels_[plane].row(slot(v));
    };
    refinementKernels().residualRow(
        {context_.left.fast.row(v), context_.right.fast.row(v), context_.left.slow.row(v),
         context_.right.slow.row(v), lightOfRow(light_, v, width_, context_.height),
         disparity_.row(v), width_, residual_limits_, pixel(kInformation), pixel(kTarget),
         pixel(kResidualSq), pixel(kWeight), pixel(kDifferenceSq), pixel(kEnergy)});
  }

  /// Sums over the windows of a row, then the plane of each pixel.
  void solveRow(int v) {
    MomentRow moments;
    for (int k = 0; k < kMomentCount; ++k) moments.sums[k] = moments_.row(k);
    sumWindows(v, moments);
    selectWindows(v, moments);
    const PlaneLimits& limits = context_.limits;
    const PlaneRow row{moments,
                       disparity_.row(v),
                       width_,
                       rules_.of_disparity,
                       limits.farthest_step_px,
                       limits.prior_weight,
                       limits.noise_floor_sq,
                       limits.independent_pixels,
                       limits.model_variance_px2,
                       limits.max_variance_px2,
                       limits.max_difference,
                       rules_.relaxation,
                       next_.row(v),
                       errors_ != nullptr ? errors_->sigma.row(v) : nullptr,
                       errors_ != nullptr ? errors_->response.row(v) : nullptr,
                       centres_ != nullptr ? centres_->beside.row(v) : nullptr,
                       centres_ != nullptr ? centres_->below.row(v) : nullptr};
    refinementKernels().solvePlanes(row);
    if (holdsMixed())
      for (const int u : near_) next_.row(v)[u] = disparity_.row(v)[u];
    if (errors_ != nullptr) refinementKernels().estimatePlaneErrors(row);
  }

  /// The rows of one plane in the window around row v.
  RowsOfWindow rowsAround(int plane, int v) const {
    RowsOfWindow rows{};
    for (int y = 0; y < height(); ++y)
      rows[static_cast<std::size_t>(y)] = pixels_[plane].row(slot(v - radius_ + y));
    return rows;
  }

  void sumWindows(int v, const MomentRow& moments) {
    const float* window = context_.window.weights.data();
    const RefinementKernels& kernels = refinementKernels();
    float* columns[kColumnMomentCount];
    for (int k = 0; k < kColumnMomentCount; ++k) columns[k] = columns_.row(k);
    kernels.columnMoments(rowsAround(kInformation, v).data(), rowsAround(kTarget, v).data(), window,
                          radius_, width_, columns);
    kernels.rowMoments(columns, window, radius_, width_, moments);
    for (int plane = kResidualSq; plane < kPixelPlanes && errors_ != nullptr; ++plane) {
      kernels.sumRows(rowsAround(plane, v).data(), window, height(), width_, columns[0]);
      RowsOfWindow shifted{};
      for (int x = 0; x < height(); ++x)
        shifted[static_cast<std::size_t>(x)] = columns[0] + x - radius_;
      kernels.sumRows(shifted.data(), window, height(), width_,
                      moments.sums[kFirstEvidence + plane - kResidualSq]);
    }
  }

  bool holdsMixed() const { return first_ && errors_ == nullptr; }

  /// Lists the mixed windows of a row and, unless deferred, sums the pixels of their centres.
  void selectWindows(int v, const MomentRow& moments) {
    listNear(v);
    if (near_.empty()) return;
    std::array<RowsOfWindow, kPixelPlanes> rows;
    for (std::size_t plane = 0; plane < pixels_.size(); ++plane)
      rows[plane] = rowsAround(static_cast<int>(plane), v);
    RowsOfWindow disparity{};
    for (int y = 0; y < height(); ++y)
      disparity[static_cast<std::size_t>(y)] = disparity_.row(v - radius_ + y);
    SelectedRows selected{disparity.data(),
                          rows[kInformation].data(),
                          rows[kTarget].data(),
                          {},
                          context_.window.selection.data(),
                          context_.window.tolerance.data(),
                          false,
                          radius_};
    for (int m = 0; m < 4 && errors_ != nullptr; ++m)
      selected.evidence[m] = rows[static_cast<std::size_t>(kResidualSq + m)].data();
    if (first_) {
      refinementKernels().markMixed(selected, near_.data(), static_cast<int>(near_.size()),
                                    mixed_.row(v));
      listNear(v);
    }
    if (!holdsMixed())
      refinementKernels().selectedMoments(selected, near_.data(), static_cast<int>(near_.size()),
                                          moments);
  }

  void listNear(int v) {
    const std::uint8_t* mixed = mixed_.row(v);
    near_.clear();
    for (int u = 0; u < width_; ++u)
      if (mixed[u] != 0 && !std::isnan(disparity_.row(v)[u])) near_.push_back(u);
  }

  const RefinementContext& context_;
  int radius_, width_;
  LightDifference light_;
  const Plane& disparity_;
  Plane& next_;
  RefinementStep rules_;
  ResidualLimits residual_limits_;
  StepErrors* errors_;
  EvidenceCentres* centres_;
  Raster<std::uint8_t>& mixed_;
  bool first_;
  std::vector<Plane> pixels_;
  Plane columns_, moments_;
  std::vector<int> near_;  // columns of a row with windows that may reach across a step
};

/// Margins stay NaN: unmatched.
Plane planeOf(const Raster<float>& raster) {
  Plane plane(raster.width_px, raster.height_px, kNotMeasured<float>);
  parallelRows(raster.height_px,
               [&](int v) { std::copy_n(raster.row(v), raster.width_px, plane.row(v)); });
  return plane;
}

Raster<float> rasterOf(const Plane& plane, int width, int height) {
  Raster<float> raster(width, height);
  parallelRows(height, [&](int v) { std::copy_n(plane.row(v), width, raster.row(v)); });
  return raster;
}

/// One round of reweighting.
LightDifference fitLight(const RefinementContext& context, const Plane& disparity,
                         const LightDifference& light, double tolerance_gray) {
  const int count = LightFit::samplesAlong(context.height);
  std::vector<LightSums> rows(static_cast<std::size_t>(count));
  parallelRows(count, [&](int i) {
    const int v = LightFit::place(i);
    for (int part = 0; part < LightFit::kParts; ++part)
      rows[static_cast<std::size_t>(i)].add(
          lightSumsOfPart(context.left.slow.row(v), context.right.slow.row(v), disparity.row(v), v,
                          part, context.width, context.height, light, tolerance_gray));
  });
  LightSums sums;
  for (const LightSums& row : rows) sums.add(row);
  return solveLight(sums);
}

/// Keeps the relief that the last steps returned to `planes` as far as it exceeds noise.
void shrinkRelief(const RefinementContext& context, const Plane& planes, Plane& disparity,
                  StepErrors& errors) {
  const int width = context.width, taps = 2 * context.options.radius_px + 1;
  const float* window = context.window.weights.data();
  const RefinementKernels& kernels = refinementKernels();
  const SmoothRelief smooth(planes, disparity, errors.response, width, context.height,
                            context.window.weights);
  Plane relief_sq(width, context.height), noise_sq = relief_sq;
  const auto rowAt = [&](int v, const float* of_smooth, float* of_relief, float* of_noise) {
    return ReliefRow{planes.row(v), of_smooth, disparity.row(v), errors.sigma.row(v),
                     width,         of_relief, of_noise,         context.limits.model_variance_px2};
  };
  parallelRows(context.height, [&](int v) {
    kernels.measureRelief(rowAt(v, nullptr, relief_sq.row(v), noise_sq.row(v)));
  });
  const auto fromCentre = [&](int tap) {
    return RefinementWindow::kReliefSpacingPx * (tap - context.options.radius_px);
  };
  parallelRanges(context.height, kBandRows, [&](int begin, int end) {
    Plane columns(width + Plane::kMargin, 1, 0, 0), sums(width, 3, 0, 0);
    std::vector<const float*> rows(static_cast<std::size_t>(taps)), shifted(rows);
    for (int x = 0; x < taps; ++x)
      shifted[static_cast<std::size_t>(x)] = columns.row(0) + fromCentre(x);
    const auto sumWindows = [&](const Plane& values, int v, float* out) {
      for (int y = 0; y < taps; ++y)
        rows[static_cast<std::size_t>(y)] = values.row(v + fromCentre(y));
      kernels.sumRows(rows.data(), window, taps, width, columns.row(0));
      kernels.sumRows(shifted.data(), window, taps, width, out);
    };
    for (int v = begin; v < end; ++v) {
      sumWindows(relief_sq, v, sums.row(0));
      sumWindows(noise_sq, v, sums.row(1));
      smooth.row(v, width, sums.row(2));
      kernels.shrinkRelief(rowAt(v, sums.row(2), sums.row(0), sums.row(1)));
    }
  });
}

/// All steps. `centres`: null if they are not wanted.
DisparityMap refineAll(const RefinementContext& context, const Raster<float>& initial_px,
                       EvidenceCentres* centres) {
  const RefinementOptions& options = context.options;
  const int width = context.width, height = context.height;
  Raster<std::uint8_t> mixed = nearDepthSteps(
      initial_px, options.radius_px, RefinementWindow::kClearStepPx, RefinementWindow::kSlope);
  Plane disparity = planeOf(initial_px), next = disparity;
  StepErrors errors(width, height);
  LightDifference light;
  const auto runSteps = [&](int begin_step, int end_step) {
    for (int i = begin_step; i < end_step; ++i) {
      const RefinementStep rules = refinementStep(i);
      for (int round = 0; round < LightFit::rounds(i); ++round)
        light = fitLight(context, disparity, light, LightFit::tolerance(i, round));
      parallelRanges(height, kBandRows, [&](int begin, int end) {
        Band(context, {light, disparity, next, rules, rules.last ? &errors : nullptr,
                       rules.last ? centres : nullptr, mixed, i == 0})
            .solve(begin, end);
      });
      std::swap(disparity, next);
    }
  };
  runSteps(0, options.plane_steps);
  const Plane planes = disparity;
  runSteps(options.plane_steps, options.steps);
  shrinkRelief(context, planes, disparity, errors);
  return {rasterOf(disparity, width, height), rasterOf(errors.sigma, width, height)};
}

/// At the rim of a surface, windows see its texture from beside it.
void dropBeyondEvidence(const RefinementContext& context, const EvidenceCentres& centres,
                        DisparityMap& map) {
  const Raster<float> measured = map.disparity_px;
  const float rim_px = rimFromEvidencePx(context.options);
  parallelRows(context.height, [&](int v) {
    for (int u = 0; u < context.width; ++u) {
      const auto isMeasured = [&](int x, int y) {
        return measured.contains(u + x, v + y) && isNumber(measured.at(u + x, v + y));
      };
      const auto grayAt = [&](int x, int y) {
        const int column = std::clamp(u + x, 0, context.width - 1);
        const int row = std::clamp(v + y, 0, context.height - 1);
        return context.left.fast.row(row)[column] + context.left.slow.row(row)[column];
      };
      if (isMeasured(0, 0) &&
          isBeyondEvidence(centres.beside.row(v)[u], centres.below.row(v)[u], rim_px,
                           context.options.radius_px, isMeasured, grayAt))
        map.disparity_px.at(u, v) = map.sigma_px.at(u, v) = kNotMeasured<float>;
    }
  });
}

}  // namespace

DisparityMap refineDisparity(const GrayImage& left, const GrayImage& right,
                             const Raster<float>& initial_px, const RefinementOptions& options) {
  if (!options.dropsBeyondEvidence()) return refineEveryPixel(left, right, initial_px, options);
  const RefinementContext context(left, right, options);
  EvidenceCentres centres(context.width, context.height);
  DisparityMap map = refineAll(context, initial_px, &centres);
  dropBeyondEvidence(context, centres, map);
  if (options.dropsUneven()) dropUnevenWindows(options.radius_px, &map);
  return map;
}

DisparityMap refineEveryPixel(const GrayImage& left, const GrayImage& right,
                              const Raster<float>& initial_px, const RefinementOptions& options) {
  return refineAll(RefinementContext(left, right, options), initial_px, nullptr);
}

}  // namespace softscope
