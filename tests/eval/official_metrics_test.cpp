// tests/eval/official_metrics_test.cpp: every metric equals an independent script's value.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "eval/alignment/rigid_alignment.h"
#include "eval/images/depth_errors.h"
#include "eval/images/picture_errors.h"
#include "eval/motion/box_tracking.h"
#include "eval/motion/tracking_scores.h"
#include "eval/motion/trajectory_errors.h"

namespace softscope {
namespace {

using Json = nlohmann::json;

constexpr double kAgreement = 1e-6;  // two orders of summation in double differ by far less

/// What metric_fixtures.py wrote, from the published formulas alone.
const Json& fixture(const char* metric) {
  static const Json all = Json::parse(std::ifstream(SOFTSCOPE_METRIC_FIXTURES));
  return all.at(metric);
}

void expectNear(const std::vector<double>& found, const Json& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (expected[i].is_null())
      EXPECT_TRUE(std::isnan(found[i])) << i;
    else
      EXPECT_NEAR(found[i], expected[i].get<double>(), kAgreement) << i;
  }
}

TEST(OfficialMetrics, JaccardAccuracyAndOcclusionOfTrackedPoints) {
  const Json& f = fixture("tracking");
  std::vector<JudgedPoint> points;
  for (const Json& p : f["points"])
    points.push_back(
        {p["error"].get<double>(), p["truly_visible"].get<bool>(), p["said_visible"].get<bool>()});
  const TrackingScores scores = trackingScores(points, f["thresholds"].get<std::vector<double>>());
  expectNear(scores.jaccard_at, f["jaccard_at"]);
  expectNear(scores.accuracy_at, f["accuracy_at"]);
  EXPECT_NEAR(scores.average_jaccard, f["average_jaccard"].get<double>(), kAgreement);
  EXPECT_NEAR(scores.average_accuracy, f["average_accuracy"].get<double>(), kAgreement);
  EXPECT_NEAR(scores.occlusion_accuracy, f["occlusion_accuracy"].get<double>(), kAgreement);
}

TEST(OfficialMetrics, APointOnTheThresholdIsNotWithinItIn2026) {
  const TrackingScores scores = trackingScores({{2, true, true}}, {2, 4});
  expectNear(scores.jaccard_at, {0, 1});
  expectNear(scores.accuracy_at, {0, 1});
}

TEST(OfficialMetrics, AConfidentWrongPointCountsTwiceInTheJaccardIndex) {
  const TrackingScores scores = trackingScores({{1, true, true}, {9, true, true}}, {2});
  EXPECT_NEAR(scores.average_jaccard, 1.0 / 3, kAgreement);
  const TrackingScores modest = trackingScores({{1, true, true}, {9, true, false}}, {2});
  EXPECT_NEAR(modest.average_jaccard, 1.0 / 2, kAgreement);
}

TEST(OfficialMetrics, NoPointsHaveNoScoreAndNoPositionIsAnError) {
  EXPECT_TRUE(std::isnan(trackingScores({}, {2}).average_jaccard));
  EXPECT_TRUE(std::isnan(endPointScores({}, {2}).average_accuracy));
  EXPECT_THROW(trackingScores({{NAN, true, true}}, {2}), InputError);
  EXPECT_THROW(trackingScores({}, {}), OptionError);
  EXPECT_THROW(endPointDistances({{0, 0, 0}}, {}), InputError);
  EXPECT_THROW(endPointDistances({{0, NAN, 0}}, {{0, 0, 0}}), InputError);
}

std::vector<Eigen::Vector3d> pointsOf(const Json& list) {
  std::vector<Eigen::Vector3d> points;
  for (const Json& json : list) {
    const auto p = json.get<std::vector<double>>();
    points.emplace_back(p.at(0), p.at(1), p.at(2));
  }
  return points;
}

TEST(OfficialMetrics, EndPointsByTheNearestTrueOne) {
  const Json& f = fixture("end_points");
  const EndPointScores scores =
      endPointScores(endPointDistances(pointsOf(f["estimate"]), pointsOf(f["truth"])),
                     f["thresholds"].get<std::vector<double>>());
  expectNear(scores.accuracy_at, f["accuracy_at"]);
  EXPECT_NEAR(scores.average_accuracy, f["average_accuracy"].get<double>(), kAgreement);
  EXPECT_NEAR(scores.distance.mean, f["mean"].get<double>(), kAgreement);
  EXPECT_NEAR(scores.distance.median, f["median"].get<double>(), kAgreement);
}

std::optional<StereoBoxes> boxesOf(const Json& pair) {
  if (pair.is_null()) return std::nullopt;
  const auto box = [](const Json& json) {
    const auto b = json.get<std::vector<double>>();
    return PixelBox{b.at(0), b.at(1), b.at(2), b.at(3)};
  };
  return StereoBoxes{box(pair[0]), box(pair[1])};
}

RectifiedRig rigOf(const Json& json) {
  RectifiedRig rig;
  const double focal_px = json["focal_px"].get<double>();
  rig.left = {
      640, 480, focal_px, focal_px, json["cx_px"].get<double>(), json["cy_px"].get<double>()};
  rig.baseline_mm = json["baseline_mm"].get<double>();
  return rig;
}

void expectScores(const BoxScores& found, const Json& expected) {
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"accuracy", found.accuracy},
                                                             {"robustness_2d", found.robustness_2d},
                                                             {"robustness_3d", found.robustness_3d},
                                                             {"error_px", found.error_px},
                                                             {"error_mm", found.error_mm}})
    EXPECT_NEAR(value, expected[key].get<double>(), kAgreement) << key;
}

TEST(OfficialMetrics, OverlapRobustnessAndErrorsOfTrackedBoxes) {
  const Json& f = fixture("boxes");
  const RectifiedRig rig = rigOf(f["rig"]);
  BoxTrackingOptions options;
  options.first_rank = f["first_rank"].get<int>();
  options.last_rank = f["last_rank"].get<int>();
  std::vector<BoxScores> all;
  std::vector<std::vector<double>> curves;
  for (const Json& target : f["targets"]) {
    std::vector<BoxTruth> truth;
    for (const Json& t : target["truth"])
      truth.push_back({t["visible"].get<bool>(), t["difficult"].get<bool>(), boxesOf(t["boxes"])});
    std::vector<std::vector<double>> sequences;
    for (const Json& json : target["tracks"]) {
      BoxTrack track;
      track.first_frame = json["first_frame"].get<int>();
      for (const Json& boxes : json["boxes"]) track.boxes.push_back(boxesOf(boxes));
      const JudgedBoxTrack judged = judgeBoxTrack(truth, track, rig, options);
      expectScores(judged.scores, json["expected"]);
      EXPECT_EQ(judged.scores.frames_2d, json["expected"]["frames_2d"].get<std::size_t>());
      EXPECT_EQ(judged.scores.frames_3d, json["expected"]["frames_3d"].get<std::size_t>());
      EXPECT_EQ(judged.scores.frames_judged, json["expected"]["frames_judged"].get<std::size_t>());
      expectNear(judged.overlaps, json["expected"]["overlaps"]);
      sequences.push_back(judged.overlaps);
      all.push_back(judged.scores);
    }
    curves.push_back(overlapCurve(sequences));
  }
  expectScores(mergeBoxScores(all), f["merged"]);
  EXPECT_NEAR(expectedAverageOverlap(curves, options), f["expected_average_overlap"].get<double>(),
              kAgreement);
}

TEST(OfficialMetrics, ABoxTrackBeginsWhereTheTruthIsUsable) {
  const BoxTruth hidden{false, false, std::nullopt};
  EXPECT_THROW(judgeBoxTrack({hidden}, {0, {}}, {}), InputError);
  EXPECT_THROW(judgeBoxTrack({BoxTruth{true, false, std::nullopt}}, {0, {}}, {}), InputError);
  BoxTrackingOptions options;
  options.last_rank = options.first_rank;
  EXPECT_THROW(options.validate(), OptionError);
}

std::vector<Eigen::Isometry3d> pathOf(const Json& list) {
  std::vector<Eigen::Isometry3d> poses;
  for (const Json& json : list) {
    const auto p = json.get<std::vector<double>>();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p.data());
    pose.translation() = Eigen::Map<const Eigen::Vector3d>(p.data() + 9);
    poses.push_back(pose);
  }
  return poses;
}

TEST(OfficialMetrics, PathsAfterRigidAlignmentAndAfterOneWithScale) {
  const Json& f = fixture("paths");
  const TrajectoryErrors errors = trajectoryErrors(pathOf(f["truth"]), pathOf(f["estimate"]));
  const auto expect = [](const PoseErrors& ate, const PoseErrors& rpe, const Json& expected) {
    EXPECT_NEAR(ate.translation_mm.rmse, expected["ate_rmse_mm"].get<double>(), kAgreement);
    EXPECT_NEAR(ate.rotation_deg.rmse, expected["ate_rmse_deg"].get<double>(), kAgreement);
    EXPECT_NEAR(rpe.translation_mm.rmse, expected["rpe_rmse_mm"].get<double>(), kAgreement);
    EXPECT_NEAR(rpe.rotation_deg.rmse, expected["rpe_rmse_deg"].get<double>(), kAgreement);
  };
  expect(errors.absolute, errors.relative, f["se3"]);
  expect(errors.absolute_scaled, errors.relative_scaled, f["sim3"]);
  EXPECT_NEAR(errors.scale, f["sim3"]["scale"].get<double>(), kAgreement);
}

TEST(OfficialMetrics, AScaleIsFoundAndAStraightPathHasNone) {
  std::vector<Eigen::Vector3d> source{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}, target;
  for (const auto& p : source) target.push_back(2.5 * p + Eigen::Vector3d(1, 2, 3));
  const SimilarityFit fit = fitSimilarity(source, target);
  EXPECT_NEAR(fit.scale, 2.5, 1e-12);
  EXPECT_LT(fit.rmse_mm, 1e-12);
  EXPECT_TRUE(fit.unique);
  std::vector<Eigen::Isometry3d> line(5, Eigen::Isometry3d::Identity());
  for (int i = 0; i < 5; ++i) line[static_cast<std::size_t>(i)].translation().x() = i;
  EXPECT_TRUE(std::isnan(trajectoryErrors(line, line).scale));
}

TEST(OfficialMetrics, DepthErrorsWithCoverage) {
  const Json& f = fixture("depth");
  const auto mapOf = [&](const Json& values) {
    Raster<float> map(f["width"].get<int>(), f["height"].get<int>(),
                      std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < map.size(); ++i)
      if (!values[i].is_null()) map.values[i] = values[i].get<float>();
    return map;
  };
  const DepthErrors errors = depthErrors(mapOf(f["measured_mm"]), mapOf(f["truth_mm"]));
  EXPECT_NEAR(errors.absolute_mm.mean, f["mae_mm"].get<double>(), kAgreement);
  EXPECT_NEAR(errors.absolute_mm.rmse, f["rmse_mm"].get<double>(), kAgreement);
  EXPECT_NEAR(errors.absolute_mm.median, f["median_mm"].get<double>(), kAgreement);
  expectNear(errors.bad_percent, f["bad_percent"]);
  EXPECT_NEAR(errors.coverage_percent, f["coverage_percent"].get<double>(), kAgreement);
}

TEST(OfficialMetrics, PicturesWithTheirMaskingNamed) {
  const Json& f = fixture("pictures");
  const auto picture = [&](const Json& pixels) {
    ColourImage image(f["width"].get<int>(), f["height"].get<int>(), Rgb8{});
    for (std::size_t i = 0; i < image.size(); ++i)
      image.values[i] = {pixels[i][0].get<std::uint8_t>(), pixels[i][1].get<std::uint8_t>(),
                         pixels[i][2].get<std::uint8_t>()};
    return image;
  };
  Mask ignore(f["width"].get<int>(), f["height"].get<int>(), 0);
  for (std::size_t i = 0; i < ignore.size(); ++i)
    ignore.values[i] = f["ignored"][i].get<std::uint8_t>();
  const PictureErrors errors = pictureErrors(picture(f["drawn"]), picture(f["photograph"]), ignore);
  EXPECT_NEAR(errors.psnr_db, f["psnr_db"].get<double>(), kAgreement);
  EXPECT_NEAR(errors.psnr_over_all_pixels_db, f["psnr_over_all_pixels_db"].get<double>(),
              kAgreement);
  EXPECT_NEAR(errors.ssim, f["ssim"].get<double>(), kAgreement);
}

}  // namespace
}  // namespace softscope
