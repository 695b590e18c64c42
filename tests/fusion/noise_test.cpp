// tests/fusion/noise_test.cpp: N noisy frames make a model that is better than one, by how much
// theory says: docs/fusion.md (F20).
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

constexpr double kSigma = 3.3e-5;  // sigma = kSigma z²: 0.1 mm at 55 mm

/// No softening, no warp noise, and no merging of points: the theory is exact.
FusionOptions plainOptions() {
  FusionOptions options;
  options.points.soft_truncation = false;
  options.points.reference_sigma_mm = kSigma * 55 * 55;
  options.density.cell_mm = 0.02;
  return options;
}

/// (F20): variance of a running average after n equal measurements, in units of one's.
double expectedVariance(int n, double max_weight) {
  double weight = 1, variance = 1;
  for (int k = 1; k < n; ++k) {
    const double gain = 1 / (weight + 1);
    variance = (1 - gain) * (1 - gain) * variance + gain * gain;
    weight = std::min(weight + 1, max_weight);
  }
  return variance;
}

TEST(ExpectedNoise, IsOneOverNUntilTheLimit) {
  EXPECT_NEAR(expectedVariance(4, 10), 1.0 / 4, 1e-12);
  EXPECT_NEAR(expectedVariance(11, 10), 1.0 / 11, 1e-12);
  EXPECT_NEAR(expectedVariance(500, 10), 1.0 / 21, 1e-12);  // g / (2 - g), g = 1 / 11
}

/// The scene at frame k: where the surface is, where the scope is, how material points got there.
struct Motion {
  std::function<Surface(int)> surface;
  std::function<Eigen::Isometry3d(int)> pose;
  std::function<Eigen::Vector3f(int, const Eigen::Vector3f&)> step;  // from frame k - 1 to k
};

Motion standing() {
  return {[](int) { return plane(55); }, [](int) { return Eigen::Isometry3d::Identity(); },
          [](int, const Eigen::Vector3f& p) { return p; }};
}

/// Breathing: the tissue moves up to 3 mm, and the scope by up to 1 mm and 3 degrees of its own.
Motion breathing() {
  const auto height = [](int k) { return 55 + 1.5 * (1 - std::cos(0.4 * k)); };
  return {[=](int k) { return plane(height(k)); },
          [](int k) {
            Eigen::Isometry3d pose = shifted(std::sin(0.3 * k), 0.5 * std::sin(0.2 * k), 0);
            pose.rotate(Eigen::AngleAxisd(0.05 * std::sin(0.25 * k), Eigen::Vector3d::UnitY()));
            return pose;
          },
          [=](int k, const Eigen::Vector3f& p) {
            return Eigen::Vector3f(p.x(), p.y(),
                                   p.z() + static_cast<float>(height(k) - height(k - 1)));
          }};
}

/// Points that every frame saw, and their errors after `frames`.
std::vector<double> errorsAfter(int frames, const Motion& motion, const FusionOptions& options) {
  PointModel model;
  InsertionMemory memory;
  Shot shot;
  std::vector<int> seen_in;
  for (int k = 0; k < frames; ++k) {
    for (Eigen::Vector3f& p : model.positions_mm)
      if (k > 0) p = motion.step(k, p);
    shot = takeShot(motion.surface(k), smallCamera(192, 144), motion.pose(k), kSigma);
    addNoise(static_cast<unsigned>(k) + 1, &shot);
    if (k == 0) {
      update(shot, options, &memory, &model);
      seen_in.assign(model.size(), 1);
      continue;
    }
    const Raster<PixelState> states = classifyPixels(shot.observation(), options.pixels);
    const Visibility visibility =
        findVisible(model, shot.observation(), states, options.visibility);
    for (std::size_t i = 0; i < model.size(); ++i)
      seen_in[i] += visibility.points[i].sight == Sight::kSeen;
    fusePoints({}, shot.observation(), visibility, options.points, options.colour, &model);
  }
  const std::vector<double> all = depthErrors(model, motion.surface(frames - 1), shot);
  std::vector<double> errors;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (seen_in[i] == frames) errors.push_back(all[i]);
  return errors;
}

class FusedNoise : public testing::TestWithParam<int> {};

// Thousands of independent points know their rms to 1 / sqrt(2 n), about 1.5 %; 6 % is 4 sigma, and
// n frames against n + 1 differ by more than that up to the limit of 10. Bias: 4 sigma of a mean.
TEST_P(FusedNoise, DropsAsTheoryOnAStandingSurface) {
  const int n = GetParam();
  const std::vector<double> errors = errorsAfter(n, standing(), plainOptions());
  const double expected = kSigma * 55 * 55 * std::sqrt(expectedVariance(n, 10));
  ASSERT_GT(errors.size(), 1500u);
  EXPECT_NEAR(rmsOf(errors), expected, 0.06 * expected);
  EXPECT_NEAR(meanOf(errors), 0, 4 * expected / std::sqrt(errors.size()));
}

// Sigma grows with z², by up to 11 % here, and the camera has another pose: 12 %.
TEST_P(FusedNoise, DropsAsTheoryOnAMovingSurface) {
  const int n = GetParam();
  const std::vector<double> errors = errorsAfter(n, breathing(), plainOptions());
  const double expected = kSigma * 55 * 55 * std::sqrt(expectedVariance(n, 10));
  ASSERT_GT(errors.size(), 1000u);
  EXPECT_NEAR(rmsOf(errors), expected, 0.12 * expected);
  EXPECT_NEAR(meanOf(errors), 0, 4 * expected / std::sqrt(errors.size()));
}
INSTANTIATE_TEST_SUITE_P(Frames, FusedNoise, testing::Values(1, 2, 5, 10, 30));

// What a user gets by default: still at least 2.5 times better than one frame after ten.
TEST(FusedNoiseByDefault, DropsToOverAThird) {
  const std::vector<double> one = errorsAfter(1, standing(), {});
  const std::vector<double> ten = errorsAfter(10, standing(), {});
  EXPECT_LT(rmsOf(ten), rmsOf(one) / 2.5);
  EXPECT_NEAR(meanOf(ten), 0, 4 * rmsOf(ten) / std::sqrt(ten.size()));
}

// Alternating frames of 0.05 and 0.15 mm: ten of them leave 1 / sqrt(5 / 0.05² + 5 / 0.15²) by
// inverse variance, sqrt(5 * 0.05² + 5 * 0.15²) / 10 by equal weights.
TEST(InverseVariance, BeatsEqualWeightsWhereFramesDiffer) {
  const auto fused = [](double reference_mm) {
    FusionOptions options = plainOptions();
    options.points.reference_sigma_mm = reference_mm;
    options.points.max_measurement_weight = 1;
    PointModel model;
    InsertionMemory memory;
    Shot shot;
    for (unsigned k = 0; k < 10; ++k) {
      const double sigma = (k % 2 == 0 ? 0.5 : 1.5) * kSigma;
      shot = takeShot(plane(55), smallCamera(), Eigen::Isometry3d::Identity(), sigma);
      addNoise(k + 1, &shot);
      update(shot, options, &memory, &model);
    }
    return rmsOf(depthErrors(model, plane(55), shot));
  };
  const double weighted = fused(kSigma / 2 * 55 * 55), equal = fused(0);
  EXPECT_NEAR(weighted, 0.0212, 0.0013);  // 6 %, as above
  EXPECT_NEAR(equal, 0.0354, 0.0021);
}

// Averaging the full position would draw points to pixel centres; along the ray they keep theirs.
TEST(AlongTheRay, PointsDoNotSlide) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  model.add({0.03f, 0.02f, 55}, {0, 0, -1}, {}, 1);
  InsertionMemory memory;
  for (int k = 0; k < 10; ++k) update(shot, {}, &memory, &model);
  EXPECT_LT((model.positions_mm[0] - Eigen::Vector3f(0.03f, 0.02f, 55)).norm(), 1e-5f);
}

TEST(Fusion, IsTheSameForAnyNumberOfThreads) {
  const auto run = [] {
    PointModel model;
    InsertionMemory memory;
    for (unsigned k = 0; k < 4; ++k) {
      Shot shot = takeShot(sphere({0, 0, 75}, 20), smallCamera(240, 180), shifted(0.3 * k, 0, 0));
      addNoise(k, &shot);
      addWrongPatches(0.1, 12, k, &shot);
      update(shot, {}, &memory, &model);
    }
    return model;
  };
  const PointModel many = run();
  const ThreadLimit one(1);
  EXPECT_TRUE(sameModel(many, run()));
}

}  // namespace
}  // namespace softscope::test
