#include "stereo/depth/dense_depth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/median.h"

namespace softscope {
namespace {

constexpr int kSweeps = 24;           // per level of the pyramid
constexpr int kBins = 16;             // of distance from the measured pixels
constexpr int kLeastInBin = 30;       // trials per standard error
constexpr double kFarthestShare = 2;  // filled depth is within this factor of the measured

using Field = Raster<double>;

/// 1 for known values.
using Known = Raster<std::uint8_t>;

/// Plane a + b u + c v through the known values, by least squares.
Eigen::Vector3d planeThrough(const Field& field, const Known& known) {
  Eigen::Matrix3d normal = 1e-12 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int v = 0; v < field.height_px; ++v)
    for (int u = 0; u < field.width_px; ++u) {
      if (known.at(u, v) == 0) continue;
      const Eigen::Vector3d row(1, u, v);
      normal += row * row.transpose();
      right += row * field.at(u, v);
    }
  return normal.ldlt().solve(right);
}

struct Level {
  Field values;
  Known known;
};

/// Half the size; a value is the mean of the known ones of its 2 x 2 pixels.
Level halved(const Level& fine) {
  const int width = (fine.values.width_px + 1) / 2, height = (fine.values.height_px + 1) / 2;
  Level coarse{Field(width, height), Known(width, height)};
  Raster<int> counts(width, height);
  for (int v = 0; v < fine.values.height_px; ++v)
    for (int u = 0; u < fine.values.width_px; ++u) {
      if (fine.known.at(u, v) == 0) continue;
      coarse.values.at(u / 2, v / 2) += fine.values.at(u, v);
      ++counts.at(u / 2, v / 2);
    }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts.values[i] == 0) continue;
    coarse.values.values[i] /= counts.values[i];
    coarse.known.values[i] = 1;
  }
  return coarse;
}

/// Mean of the neighbours inside the raster.
double meanAround(const Field& field, int u, int v) {
  double sum = 0;
  int count = 0;
  const auto take = [&](int x, int y) {
    if (!field.contains(x, y)) return;
    sum += field.at(x, y);
    ++count;
  };
  take(u - 1, v), take(u + 1, v), take(u, v - 1), take(u, v + 1);
  return count > 0 ? sum / count : field.at(u, v);
}

/// A membrane: every unknown value becomes the mean of its four
/// neighbours (Gauss-Seidel), from the values of the next level.
void relax(const Level* coarse, Level* level) {
  Field& field = level->values;
  std::vector<std::pair<int, int>> unknown;
  for (int v = 0; v < field.height_px; ++v)
    for (int u = 0; u < field.width_px; ++u) {
      if (level->known.at(u, v) != 0) continue;
      unknown.emplace_back(u, v);
      if (coarse != nullptr) field.at(u, v) = coarse->values.at(u / 2, v / 2);
    }
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const auto& [u, v] : unknown) field.at(u, v) = meanAround(field, u, v);
}

/// Interpolates the known values.
Field membrane(Field field, const Known& known) {
  std::vector<Level> levels{{std::move(field), known}};
  while (std::max(levels.back().values.width_px, levels.back().values.height_px) > 2)
    levels.push_back(halved(levels.back()));
  for (std::size_t k = levels.size(); k-- > 0;)
    relax(k + 1 < levels.size() ? &levels[k + 1] : nullptr, &levels[k]);
  return std::move(levels[0].values);
}

/// A filled field. A value of the membrane is a weighted mean of the known values around a
/// gap; `spread` is their weighted variance: large for a gap between a near and a far surface.
struct Fill {
  Field values, spread;
};

/// The plane through all known values, and a membrane for the difference from it.
Fill filled(const Field& field, const Known& known) {
  const Eigen::Vector3d plane = planeThrough(field, known);
  Fill fill{field, Field(field.width_px, field.height_px)};
  const auto visit = [&](const auto& change) {
    for (int v = 0; v < field.height_px; ++v)
      for (int u = 0; u < field.width_px; ++u)
        change(plane.dot(Eigen::Vector3d(1, u, v)), &fill.values.at(u, v), &fill.spread.at(u, v));
  };
  visit([](double on_plane, double* value, double* square) {
    *value -= on_plane;
    *square = *value * *value;
  });
  fill.values = membrane(std::move(fill.values), known);
  fill.spread = membrane(std::move(fill.spread), known);
  visit([](double on_plane, double* value, double* square) {
    *square = std::max(0.0, *square - *value * *value);
    *value += on_plane;
  });
  return fill;
}

/// Of each pixel from the nearest set pixel, px.
Raster<float> distanceFrom(const Known& set) {
  Raster<std::uint8_t> clear(set.width_px, set.height_px);
  std::transform(set.values.begin(), set.values.end(), clear.values.begin(),
                 [](std::uint8_t is_set) { return is_set != 0 ? 0 : 1; });
  Raster<float> distance_px(set.width_px, set.height_px);
  const cv::Mat from(set.height_px, set.width_px, CV_8U, clear.values.data());
  cv::Mat to(set.height_px, set.width_px, CV_32F, distance_px.values.data());
  cv::distanceTransform(from, to, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance_px;
}

/// Root mean square error of a fill by distance from known pixels; never decreases.
class FillError {
 public:
  FillError(const std::vector<float>& distances_px, const std::vector<double>& errors) {
    if (distances_px.empty()) return;
    const double step_px = *std::max_element(distances_px.begin(), distances_px.end()) / kBins;
    std::vector<double> sums(kBins), places(kBins);
    std::vector<int> counts(kBins);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const std::size_t bin =
          std::min<std::size_t>(kBins - 1, std::size_t(distances_px[i] / step_px));
      sums[bin] += errors[i] * errors[i];
      places[bin] += distances_px[i];
      ++counts[bin];
    }
    double sum = 0, place = 0, largest = 0;
    int count = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      sum += sums[bin], place += places[bin], count += counts[bin];
      const bool last = bin + 1 == kBins && places_px_.empty();
      if (count < kLeastInBin && !(last && count > 0)) continue;
      largest = std::max(largest, std::sqrt(sum / count));
      places_px_.push_back(place / count);
      errors_.push_back(largest);
      sum = place = 0, count = 0;
    }
  }

  /// In proportion to the distance beyond the farthest trial; NaN without any.
  double at(double distance_px) const {
    if (places_px_.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto above = std::upper_bound(places_px_.begin(), places_px_.end(), distance_px);
    if (above == places_px_.begin()) return errors_.front();
    if (above == places_px_.end()) return errors_.back() * distance_px / places_px_.back();
    const std::size_t k = std::size_t(above - places_px_.begin());
    const double share = (distance_px - places_px_[k - 1]) / (places_px_[k] - places_px_[k - 1]);
    return errors_[k - 1] + share * (errors_[k] - errors_[k - 1]);
  }

 private:
  std::vector<double> places_px_, errors_;  // ascending
};

/// Removes the measured pixels nearest to the gaps, as far as the gaps extend, and fills again.
FillError triedAround(const Known& gaps, const Field& field, const Known& known,
                      double farthest_px) {
  const Raster<float> from_gap_px = distanceFrom(gaps);
  std::vector<float> distances;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known.values[i] != 0) distances.push_back(from_gap_px.values[i]);
  // About half of the measured pixels are kept, or more.
  const double reach_px = std::min<double>(farthest_px, medianOf(std::move(distances)));

  Known kept = known;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (from_gap_px.values[i] <= reach_px) kept.values[i] = 0;
  const Field again = filled(field, kept).values;
  const Raster<float> from_kept_px = distanceFrom(kept);
  std::vector<float> places;
  std::vector<double> errors;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known.values[i] == 0 || kept.values[i] != 0) continue;
    places.push_back(from_kept_px.values[i]);
    errors.push_back(again.values[i] - field.values[i]);
  }
  return {places, errors};
}

/// Measured depth of the tissue, and the gaps.
struct Measured {
  Field inverse;  // of the depth, 1/mm: linear in the pixel on any plane
  Known known, gaps;
  double nearest = 0, farthest = std::numeric_limits<double>::infinity();  // inverse
  long count = 0;
};

Measured measuredOf(const Raster<float>& depth_mm, const Mask& ignored) {
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  Measured all{Field(width, height), Known(width, height), Known(width, height)};
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    if (!ignored.empty() && ignored.values[i] != 0) continue;
    all.known.values[i] = depth_mm.values[i] > 0 && std::isfinite(depth_mm.values[i]);
    all.gaps.values[i] = all.known.values[i] == 0;
    if (all.known.values[i] == 0) continue;
    all.inverse.values[i] = 1 / double(depth_mm.values[i]);
    all.nearest = std::max(all.nearest, all.inverse.values[i]);
    all.farthest = std::min(all.farthest, all.inverse.values[i]);
    ++all.count;
  }
  return all;
}

/// Gives each gap a depth and its standard error.
void fillGaps(const Measured& measured, DepthMap* dense) {
  const Known& gaps = measured.gaps;
  const Raster<float> distance_px = distanceFrom(measured.known);
  double reach_px = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i)
    if (gaps.values[i] != 0) reach_px = std::max<double>(reach_px, distance_px.values[i]);
  const FillError error = triedAround(gaps, measured.inverse, measured.known, reach_px);
  const Fill whole = filled(measured.inverse, measured.known);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps.values[i] == 0) continue;
    const double z_mm = 1 / std::clamp(whole.values.values[i], measured.farthest / kFarthestShare,
                                       measured.nearest * kFarthestShare);
    dense->depth_mm.values[i] = float(z_mm);
    const double sigma =
        std::hypot(error.at(distance_px.values[i]), std::sqrt(whole.spread.values[i]));
    dense->sigma_mm.values[i] = float(z_mm * z_mm * sigma);
  }
}

}  // namespace

DepthMap denseDepth(const DepthMap& measured, const Mask& ignored) {
  const Measured all = measuredOf(measured.depth_mm, ignored);
  if (all.count < kLeastMeasured)
    throw InputError("dense depth: " + std::to_string(all.count) + " pixels were measured, but " +
                     std::to_string(kLeastMeasured) +
                     " are needed to fill the others. Leave `dense` out");
  DepthMap dense = measured;
  if (std::find(all.gaps.values.begin(), all.gaps.values.end(), 1) == all.gaps.values.end())
    return dense;
  if (dense.sigma_mm.empty())
    dense.sigma_mm = Raster<float>(measured.depth_mm.width_px, measured.depth_mm.height_px,
                                   std::numeric_limits<float>::quiet_NaN());
  fillGaps(all, &dense);
  return dense;
}

}  // namespace softscope
