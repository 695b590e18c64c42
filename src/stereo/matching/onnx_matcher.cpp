#include "stereo/matching/onnx_matcher.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"
#include "stereo/matching/stage_clock.h"
#include "stereo/refinement/disparity_filter.h"

namespace softscope {
namespace {

constexpr float kTwoErrors = 2.0f;   // variance of left minus right, in variances of one
constexpr float kFiveErrors = 5.0f;  // of full minus half size, whose error doubles

NetworkInput inputOf(const std::string& name) {
  const std::map<std::string, NetworkInput> inputs{{"levels", NetworkInput::kLevels},
                                                   {"unit", NetworkInput::kUnit},
                                                   {"imagenet", NetworkInput::kImageNet}};
  return inputs.at(name);
}

ColourImage colourOf(const GrayImage& gray) {
  ColourImage colour(gray.width_px, gray.height_px);
  for (std::size_t i = 0; i < gray.size(); ++i)
    colour.values[i] = {gray.values[i], gray.values[i], gray.values[i]};
  return colour;
}

/// `change` of each channel.
template <class Change>
ColourImage byChannel(const ColourImage& image, const Change& change) {
  ColourImage result;
  for (std::uint8_t Rgb8::*channel : {&Rgb8::red, &Rgb8::green, &Rgb8::blue}) {
    GrayImage plane(image.width_px, image.height_px);
    for (std::size_t i = 0; i < image.size(); ++i) plane.values[i] = image.values[i].*channel;
    plane = change(plane);
    if (result.empty()) result = ColourImage(plane.width_px, plane.height_px);
    for (std::size_t i = 0; i < plane.size(); ++i) result.values[i].*channel = plane.values[i];
  }
  return result;
}

template <class T>
Raster<T> mirrored(Raster<T> raster) {
  for (int v = 0; v < raster.height_px; ++v)
    std::reverse(raster.row(v), raster.row(v) + raster.width_px);
  return raster;
}

/// Half the size, at least 2 pixels; a single row or column has none.
ColourImage halvedColour(const ColourImage& image) {
  return byChannel(image, [](const GrayImage& plane) { return halve(plane); });
}

/// Difference to the disparity of the right image at the matched column; NaN outside of it.
float leftRightDifference(const Raster<float>& left, const Raster<float>& right, int u, int v) {
  const float d = left.at(u, v), x = static_cast<float>(u) - d;
  if (!(x >= 0 && x <= static_cast<float>(right.width_px - 1))) return kNotMeasured<float>;
  const int u0 = static_cast<int>(x), u1 = std::min(u0 + 1, right.width_px - 1);
  const float share = x - static_cast<float>(u0);
  return (1 - share) * right.at(u0, v) + share * right.at(u1, v) - d;
}

/// Difference to twice the disparity of the half size.
float scaleDifference(const Raster<float>& full, const Raster<float>& half, int u, int v) {
  const HalfPosition at = halfPosition(u, v);
  if (!half.contains(at.u0, at.v0)) return kNotMeasured<float>;
  const FourPixels four =
      fourPixels(half.values.data(), half.width_px, half.height_px, at.u0, at.v0);
  return 2 * bilinear(four, at.fu, at.fv) - full.at(u, v);
}

/// Mean square over a window, of its finite values.
Raster<float> localMeanSquare(const Raster<float>& differences, int radius_px) {
  const int width = differences.width_px, height = differences.height_px;
  Raster<float> rows(width, height), counts(width, height),
      means(width, height, kNotMeasured<float>);
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u)
      for (int k = std::max(u - radius_px, 0); k <= std::min(u + radius_px, width - 1); ++k) {
        const float difference = differences.at(k, v);
        if (std::isnan(difference)) continue;
        rows.at(u, v) += difference * difference;
        counts.at(u, v) += 1;
      }
  });
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      float sum = 0, count = 0;
      for (int k = std::max(v - radius_px, 0); k <= std::min(v + radius_px, height - 1); ++k) {
        sum += rows.at(u, k);
        count += counts.at(u, k);
      }
      if (count > 0) means.at(u, v) = sum / count;
    }
  });
  return means;
}

bool isBlocked(const Mask& mask, int u, int v) { return mask.contains(u, v) && mask.at(u, v) != 0; }

/// NaN where the disparity is out of range, masked in either view, or rejected by the right image.
void dropDenied(const Raster<float>& left_right, const ViewMasks& ignored,
                const StereoOptions& options, Raster<float>* disparity_px) {
  parallelRows(disparity_px->height_px, [&](int v) {
    for (int u = 0; u < disparity_px->width_px; ++u) {
      float& d = disparity_px->at(u, v);
      const bool in_range = d > 0 && d >= static_cast<float>(options.disparity_min_px) - 0.5f &&
                            d <= static_cast<float>(options.disparity_max_px) + 0.5f;
      const bool agrees =
          std::abs(left_right.at(u, v)) <= static_cast<float>(NetworkOptions::left_right_px);
      if (!in_range || !agrees || isBlocked(ignored.left, u, v) ||
          isBlocked(ignored.right, static_cast<int>(std::lround(static_cast<float>(u) - d)), v))
        d = kNotMeasured<float>;
    }
  });
}

/// Sigma from the differences to the right image and to the half
/// size around each pixel; NaN disparity if they are too large.
void predictSigma(const Raster<float>& left_right, const Raster<float>& scale, DisparityMap* map) {
  const int radius_px = NetworkOptions::agreement_radius_px;
  const Raster<float> left_right_2 = localMeanSquare(left_right, radius_px);
  const Raster<float> scale_2 = localMeanSquare(scale, radius_px);
  const float known_2 = static_cast<float>(NetworkOptions::model_sigma_px) *
                        static_cast<float>(NetworkOptions::model_sigma_px);
  for (std::size_t i = 0; i < map->sigma_px.size(); ++i) {
    float& d = map->disparity_px.values[i];
    const float sigma = std::sqrt(
        known_2 + std::max(left_right_2.values[i] / kTwoErrors, scale_2.values[i] / kFiveErrors));
    if (!(sigma <= static_cast<float>(RefinementOptions::max_sigma_px))) d = kNotMeasured<float>;
    if (!std::isnan(d)) map->sigma_px.values[i] = sigma;
  }
}

}  // namespace

OnnxMatcher::OnnxMatcher(const StereoOptions& options)
    : options_(options), network_(options.model, inputOf(options.model_input)) {}

void OnnxMatcher::prepare(int width_px, int height_px) {
  const int max_px = options_.forWidth(width_px).disparity_max_px;
  network_.prepare(width_px, height_px, max_px);
  network_.prepare(width_px / 2, height_px / 2, max_px);
}

DisparityMap OnnxMatcher::match(const GrayImage& left, const GrayImage& right,
                                const ViewMasks& ignored) {
  return matchColour({colourOf(left), colourOf(right)}, ignored);
}

DisparityMap OnnxMatcher::matchColour(const StereoPair& pair, const ViewMasks& ignored) {
  const GrayImage left_gray = toGray(pair.left);
  requireRectifiedPair(left_gray, toGray(pair.right));
  StageClock clock;
  const int width = left_gray.width_px, height = left_gray.height_px;
  prepare(width, height);
  const auto filled = [](const ColourImage& image, const Mask& mask) {
    return byChannel(image, [&](const GrayImage& plane) { return fillMasked(plane, mask); });
  };
  const ColourImage left = filled(pair.left, ignored.left);
  const ColourImage right = filled(pair.right, ignored.right);
  clock.lap("masks");
  const Raster<float> found = network_.disparity(left, right);
  clock.lap("left");
  const Raster<float> back = mirrored(network_.disparity(mirrored(right), mirrored(left)));
  clock.lap("right");
  const Raster<float> half = network_.disparity(halvedColour(left), halvedColour(right));
  clock.lap("half");

  DisparityMap map{found, Raster<float>(width, height, kNotMeasured<float>)};
  Raster<float> left_right(width, height), scale(width, height);
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      left_right.at(u, v) = leftRightDifference(found, back, u, v);
      scale.at(u, v) = scaleDifference(found, half, u, v);
    }
  });
  dropDenied(left_right, ignored, options_.forWidth(width), &map.disparity_px);
  for (std::size_t i = 0; i < left_right.size(); ++i)  // rejected pixels say nothing of others
    if (std::isnan(map.disparity_px.values[i]))
      left_right.values[i] = scale.values[i] = kNotMeasured<float>;
  predictSigma(left_right, scale, &map);
  clock.lap("agreement");
  removeDark(map.disparity_px, left_gray, options_.darkest_gray, options_.dark_margin_px);
  removeSpeckles(map.disparity_px, options_.elas.speckle_size_px, ElasOptions::speckle_step_px);
  erodeEdges(map, options_.erode_edges_px, options_.edge_step_px, options_.border_px);
  for (std::size_t i = 0; i < map.sigma_px.size(); ++i)
    if (std::isnan(map.disparity_px.values[i])) map.sigma_px.values[i] = kNotMeasured<float>;
  clock.lap("filter");
  times_ = clock.laps();
  return map;
}

}  // namespace softscope
