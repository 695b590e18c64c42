#include "features/surface_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/parallel.h"
#include "features/kernels.h"

namespace softscope {
namespace {

constexpr int kSide = 16;            // samples a side
constexpr int kDirections = 36;      // bins of the dominant direction
constexpr float kLeastContrast = 2;  // mean gradient, grey values a sample
constexpr float kClip = 0.2F;        // Lowe's limit on one entry of a unit descriptor
constexpr float kSteepest = 0.35F;   // cosine between normal and ray below which a patch is grazed

using Samples = std::array<float, kSide * kSide>;

/// Tangent plane at a pixel; columns: two tangents and the normal.
struct TangentFrame {
  Eigen::Vector3f centre_mm;
  Eigen::Matrix3f axes;
};

Eigen::Vector3f lifted(const DepthImage& image, int u, int v) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  if (!image.depth_mm.contains(u, v)) return Eigen::Vector3f::Constant(nan);
  return liftPixel(image.camera, static_cast<float>(u), static_cast<float>(v),
                   image.depth_mm.at(u, v));
}

/// From points at `reach_px` on both sides; none without depth or at grazing angles.
std::optional<TangentFrame> tangentFrame(const DepthImage& image, int u, int v, int reach_px) {
  TangentFrame frame;
  frame.centre_mm = lifted(image, u, v);
  const Eigen::Vector3f right = lifted(image, u + reach_px, v) - lifted(image, u - reach_px, v);
  const Eigen::Vector3f down = lifted(image, u, v + reach_px) - lifted(image, u, v - reach_px);
  if (!frame.centre_mm.allFinite() || !right.allFinite() || !down.allFinite()) return std::nullopt;
  const Eigen::Vector3f normal = down.cross(right).normalized();  // towards the camera
  if (!(-normal.dot(frame.centre_mm.normalized()) > kSteepest)) return std::nullopt;
  frame.axes.col(0) = (Eigen::Vector3f::UnitX() - normal.x() * normal).normalized();
  frame.axes.col(1) = frame.axes.col(0).cross(normal);
  frame.axes.col(2) = normal;
  return frame;
}

/// NaN outside of the image, and for ignored pixels.
float grayAt(const DepthImage& image, const Eigen::Vector3f& point_mm) {
  const Eigen::Vector2f at = projectPoint(image.camera, point_mm);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<float>(image.gray.width_px - 1) &&
        at.y() < static_cast<float>(image.gray.height_px - 1)))
    return nan;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  if (!image.ignore.empty() && (image.ignore.at(u, v) | image.ignore.at(u + 1, v) |
                                image.ignore.at(u, v + 1) | image.ignore.at(u + 1, v + 1)) != 0)
    return nan;
  const auto x = at.x() - static_cast<float>(u), y = at.y() - static_cast<float>(v);
  const std::uint8_t *above = image.gray.row(v) + u, *below = image.gray.row(v + 1) + u;
  return (1 - y) * ((1 - x) * above[0] + x * above[1]) + y * ((1 - x) * below[0] + x * below[1]);
}

/// Grey values of the plane, rotated by `angle_rad`; false if one is missing.
bool sample(const DepthImage& image, const TangentFrame& frame, float radius_mm, float angle_rad,
            Samples* gray) {
  const Eigen::Vector3f along =
      std::cos(angle_rad) * frame.axes.col(0) + std::sin(angle_rad) * frame.axes.col(1);
  const Eigen::Vector3f across = along.cross(frame.axes.col(2));
  const float step_mm = 2 * radius_mm / kSide;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const float x_mm = (static_cast<float>(i) - 0.5F * (kSide - 1)) * step_mm;
      const float y_mm = (static_cast<float>(j) - 0.5F * (kSide - 1)) * step_mm;
      const float value = grayAt(image, frame.centre_mm + x_mm * along + y_mm * across);
      if (!std::isfinite(value)) return false;
      (*gray)[static_cast<std::size_t>(kSide * j + i)] = value;
    }
  return true;
}

/// Calls use(i, j, dx, dy, weight) for every inner sample; the weight decays from the centre.
template <class Use>
void forEachGradient(const Samples& gray, const Use& use) {
  constexpr float kMiddle = 0.5F * (kSide - 1);
  for (int j = 1; j + 1 < kSide; ++j)
    for (int i = 1; i + 1 < kSide; ++i) {
      const std::size_t k = static_cast<std::size_t>(kSide * j + i);
      const float x = (static_cast<float>(i) - kMiddle) / kMiddle;
      const float y = (static_cast<float>(j) - kMiddle) / kMiddle;
      use(i, j, 0.5F * (gray[k + 1] - gray[k - 1]), 0.5F * (gray[k + kSide] - gray[k - kSide]),
          std::exp(-(x * x + y * y)));
    }
}

/// Dominant gradient direction; none without texture.
std::optional<float> preferredDirection(const Samples& gray) {
  std::array<float, kDirections> histogram{};
  float sum = 0, weights = 0;
  forEachGradient(gray, [&](int, int, float dx, float dy, float weight) {
    const float length = std::sqrt(dx * dx + dy * dy);
    const float turns = std::atan2(dy, dx) / (2 * float(M_PI)) + 1;
    const int bin = static_cast<int>(turns * kDirections) % kDirections;
    histogram[static_cast<std::size_t>(bin)] += weight * length;
    sum += weight * length;
    weights += weight;
  });
  if (sum < kLeastContrast * weights) return std::nullopt;
  const auto at = [&](int bin) {
    return histogram[static_cast<std::size_t>((bin + kDirections) % kDirections)];
  };
  int best = 0;
  const auto smooth = [&](int bin) { return at(bin - 1) + 2 * at(bin) + at(bin + 1); };
  for (int bin = 1; bin < kDirections; ++bin)
    if (smooth(bin) > smooth(best)) best = bin;
  const float left = smooth(best - 1), middle = smooth(best), right = smooth(best + 1);
  const float bend = left - 2 * middle + right;
  const float shift = bend < 0 ? 0.5F * (left - right) / bend : 0;
  return (static_cast<float>(best) + 0.5F + shift) * 2 * float(M_PI) / kDirections;
}

/// Histograms of gradient directions in 4 x 4 cells,
/// interpolated between neighbouring cells and bins.
std::array<std::uint8_t, SurfacePatch::kSize> describe(const Samples& gray) {
  constexpr int kCells = SurfacePatch::kCells, kBins = SurfacePatch::kBins;
  std::array<float, SurfacePatch::kSize> sums{};
  forEachGradient(gray, [&](int i, int j, float dx, float dy, float weight) {
    const float length = weight * std::sqrt(dx * dx + dy * dy);
    const float x = (static_cast<float>(i) + 0.5F) * kCells / kSide - 0.5F;
    const float y = (static_cast<float>(j) + 0.5F) * kCells / kSide - 0.5F;
    const float b = (std::atan2(dy, dx) / (2 * float(M_PI)) + 1) * kBins;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const int b0 = static_cast<int>(std::floor(b));
    for (int k = 0; k < 8; ++k) {
      const int cx = x0 + (k & 1), cy = y0 + ((k >> 1) & 1), cb = b0 + (k >> 2);
      if (cx < 0 || cy < 0 || cx >= kCells || cy >= kCells) continue;
      const float share = (1 - std::abs(x - float(cx))) * (1 - std::abs(y - float(cy))) *
                          (1 - std::abs(b - float(cb)));
      sums[static_cast<std::size_t>((cy * kCells + cx) * kBins + cb % kBins)] += share * length;
    }
  });
  const auto normalise = [&] {
    float squared = 0;
    for (const float value : sums) squared += value * value;
    const float scale = squared > 0 ? 1 / std::sqrt(squared) : 0;
    for (float& value : sums) value *= scale;
  };
  normalise();
  for (float& value : sums) value = std::min(value, kClip);
  normalise();
  std::array<std::uint8_t, SurfacePatch::kSize> bytes;
  for (std::size_t k = 0; k < sums.size(); ++k)
    bytes[k] = static_cast<std::uint8_t>(std::min(255.0F, 512 * sums[k] + 0.5F));
  return bytes;
}

std::optional<SurfacePatch> patchAt(const DepthImage& image, int u, int v, float radius_mm,
                                    int reach_px) {
  const std::optional<TangentFrame> frame = tangentFrame(image, u, v, reach_px);
  Samples gray;
  if (!frame || !sample(image, *frame, radius_mm, 0, &gray)) return std::nullopt;
  const std::optional<float> direction = preferredDirection(gray);
  if (!direction || !sample(image, *frame, radius_mm, *direction, &gray)) return std::nullopt;
  return SurfacePatch{frame->centre_mm, describe(gray)};
}

/// Halves of descriptors, each of the size that the kernels compare.
struct DescriptorHalves {
  explicit DescriptorHalves(const std::vector<SurfacePatch>& patches) {
    for (std::size_t half = 0; half < 2; ++half) {
      bytes[half].resize(patches.size() * kDescriptorSize);
      for (std::size_t k = 0; k < patches.size(); ++k)
        std::copy_n(patches[k].descriptor.data() + half * kDescriptorSize, kDescriptorSize,
                    bytes[half].data() + k * kDescriptorSize);
    }
  }
  std::array<std::vector<std::uint8_t>, 2> bytes;
};
static_assert(SurfacePatch::kSize == 2 * kDescriptorSize);

/// Most similar patch (index in `among`), and whether it is distinct from all others.
struct Nearest {
  int index = -1;
  bool distinct = false;
};

/// Search of the patches most similar to one. Sums of absolute differences.
class PatchSearch {
 public:
  explicit PatchSearch(const std::vector<SurfacePatch>& among) : among_(among), halves_(among) {}

  /// The first of equally similar ones; -1 without any. Its distances remain in `distances`.
  int indexFor(const SurfacePatch& patch, std::vector<std::uint16_t>* distances) const {
    const FeatureKernels& kernels = featureKernels();
    const int count = static_cast<int>(among_.size());
    std::vector<std::uint16_t> second(among_.size());
    distances->resize(among_.size());
    kernels.descriptorDistances(patch.descriptor.data(), halves_.bytes[0].data(), count,
                                distances->data());
    kernels.descriptorDistances(patch.descriptor.data() + kDescriptorSize, halves_.bytes[1].data(),
                                count, second.data());
    for (std::size_t k = 0; k < second.size(); ++k)
      (*distances)[k] = static_cast<std::uint16_t>((*distances)[k] + second[k]);
    const auto least = std::min_element(distances->begin(), distances->end());
    return least == distances->end() ? -1 : static_cast<int>(least - distances->begin());
  }

  Nearest nearest(const SurfacePatch& patch, double max_ratio, double elsewhere_mm) const {
    std::vector<std::uint16_t> distances;
    Nearest found{indexFor(patch, &distances), false};
    if (found.index < 0) return found;
    const Eigen::Vector3f place_mm = among_[static_cast<std::size_t>(found.index)].centre_mm;
    int second = std::numeric_limits<int>::max();
    for (std::size_t k = 0; k < among_.size(); ++k)
      if (distances[k] < second && (among_[k].centre_mm - place_mm).norm() > elsewhere_mm)
        second = distances[k];
    found.distinct = distances[static_cast<std::size_t>(found.index)] < max_ratio * second;
    return found;
  }

 private:
  const std::vector<SurfacePatch>& among_;
  DescriptorHalves halves_;
};

}  // namespace

std::vector<SurfacePatch> surfacePatches(const DepthImage& image, double radius_mm,
                                         int spacing_px) {
  const int rows = image.gray.height_px / spacing_px;
  std::vector<std::vector<SurfacePatch>> by_row(static_cast<std::size_t>(std::max(rows, 0)));
  parallelRows(rows, [&](int row) {
    for (int u = spacing_px / 2; u < image.gray.width_px; u += spacing_px)
      if (const auto patch = patchAt(image, u, row * spacing_px + spacing_px / 2,
                                     static_cast<float>(radius_mm), spacing_px))
        by_row[static_cast<std::size_t>(row)].push_back(*patch);
  });
  std::vector<SurfacePatch> patches;
  for (const auto& row : by_row) patches.insert(patches.end(), row.begin(), row.end());
  return patches;
}

std::vector<std::pair<int, int>> matchPatches(const std::vector<SurfacePatch>& a,
                                              const std::vector<SurfacePatch>& b, double max_ratio,
                                              double elsewhere_mm) {
  const PatchSearch in_a(a), in_b(b);
  std::vector<int> matches(a.size(), -1);
  parallelRows(static_cast<int>(a.size()), [&](int k) {
    const SurfacePatch& patch = a[static_cast<std::size_t>(k)];
    const Nearest there = in_b.nearest(patch, max_ratio, elsewhere_mm);
    if (!there.distinct) return;
    std::vector<std::uint16_t> distances;
    const int home = in_a.indexFor(b[static_cast<std::size_t>(there.index)], &distances);
    if ((a[static_cast<std::size_t>(home)].centre_mm - patch.centre_mm).norm() <= elsewhere_mm)
      matches[static_cast<std::size_t>(k)] = there.index;
  });
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (matches[i] >= 0) pairs.emplace_back(static_cast<int>(i), matches[i]);
  return pairs;
}

}  // namespace softscope
