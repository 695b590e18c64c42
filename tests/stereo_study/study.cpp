#include "stereo_study/study.h"

#include <cmath>
#include <cstdio>

#include "eval/distance/triangle_tree.h"
#include "eval/images/pixel_masks.h"
#include "io/calibrations/calibration_reader.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/sequences/sequence_reader.h"
#include "mesh/mesh_reader.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/rectification/image_border.h"
#include "stereo/rectification/rectifier.h"

namespace softscope::test {
namespace {

std::string numbered(int frame) {
  char name[16];
  std::snprintf(name, sizeof name, "%06d.png", frame);
  return name;
}

DisparityMap matchWith(const std::string& method, const GrayImage& left, const GrayImage& right,
                       const ViewMasks& ignored = {}) {
  StereoOptions options;
  options.method = method;
  return makeStereoMatcher(options)->match(left, right, ignored);
}

PairScore scorePair(const std::string& name, const GrayImage& left, const GrayImage& right,
                    const Raster<float>& truth_px) {
  const Raster<float> elas = matchWith("elas", left, right).disparity_px;
  const Raster<float> sgbm = matchWith("sgbm", left, right).disparity_px;
  PairScore score{name, disparityErrors(elas, truth_px), disparityErrors(sgbm, truth_px)};
  score.elas_common_median_px =
      disparityErrors(elas, truth_px, {}, ignoreUnmeasured(sgbm)).absolute_px.median;
  score.sgbm_common_median_px =
      disparityErrors(sgbm, truth_px, {}, ignoreUnmeasured(elas)).absolute_px.median;
  return score;
}

/// Rectified, rows aligned, matched.
struct Measured {
  DepthMap depth;
  RowAlignment rows;
};

Measured measure(const StereoPair& raw, const Rectifier& rectifier, bool align_rows) {
  StereoPair pair = rectifier.rectify(raw);
  ViewMasks ignored = pixelsToIgnore(pair, rectifier, /*find_border=*/true);
  AlignedPair aligned =
      alignRows(pair, StereoOptions{}.forWidth(pair.left.width_px).disparity_max_px, ignored);
  if (align_rows) {
    pair = std::move(aligned.pair);
    ignored = std::move(aligned.ignored);
  }
  DisparityMap disparity = matchWith("elas", toGray(pair.left), toGray(pair.right), ignored);
  if (align_rows) removeRoll(aligned.roll_rad, &disparity.disparity_px);
  return {depthFromDisparity(disparity, rectifier.rig()), aligned.before};
}

/// The frame's errors, and all absolute ones added to `pooled_mm`. Some reference files hold a few
/// stray pixels only: they judge nothing.
bool judge(const Raster<float>& measured_mm, const Raster<float>& truth_mm, const Mask& ignore,
           DepthErrors& errors, std::vector<double>& pooled_mm) {
  const DepthErrors found = depthErrors(measured_mm, truth_mm, {}, ignore);
  if (found.known_count < truth_mm.size() / 100) return false;
  errors = found;
  for (std::size_t i = 0; i < truth_mm.size(); ++i)
    if (ignore.values[i] == 0)
      pooled_mm.push_back(std::abs(measured_mm.values[i] - truth_mm.values[i]));  // NaN: left out
  return true;
}

/// Points in the raw left camera's frame whose pixel, in the raw picture, `ignore` leaves.
/// Both rectified and raw pixel are found through the rectified mask, good to a pixel.
std::vector<Eigen::Vector3f> rawPoints(const Raster<float>& depth_mm, const Rectifier& rectifier,
                                       const Mask& ignore) {
  std::vector<Eigen::Vector3f> points;
  const Mask rectified = rectifier.rectifyMask(ignore);
  const Eigen::Matrix3d raw_from_rectified = rectifier.rig().rectified_from_raw_left.transpose();
  for (int v = 0; v < depth_mm.height_px; ++v)
    for (int u = 0; u < depth_mm.width_px; ++u) {
      if (rectified.at(u, v) != 0 || std::isnan(depth_mm.at(u, v))) continue;
      const Eigen::Vector3d p = liftPixel<double>(rectifier.rig().left, u, v, depth_mm.at(u, v));
      points.push_back((raw_from_rectified * p).cast<float>());
    }
  return points;
}

}  // namespace

std::vector<PairScore> scoreTissuePairs(const std::filesystem::path& folder) {
  std::vector<PairScore> scores;
  SequenceReader reader(folder);
  const RectifiedRig rig = Rectifier(reader.calibration()).rig();
  while (const auto result = reader.next()) {
    const Raster<float> depth_mm =
        readDepth(folder / "groundtruth" / "depth" / numbered(result->index));
    scores.push_back(scorePair("tissue " + std::to_string(result->index),
                               toGray(result->frame.pair.left), toGray(result->frame.pair.right),
                               disparityFromDepth(depth_mm, rig)));
  }
  return scores;
}

PairScore scoreAloe(const std::filesystem::path& folder) {
  const GrayImage truth = readGrayImage(folder / "aloeGT.png");
  Raster<float> truth_px(truth.width_px, truth.height_px);
  for (std::size_t i = 0; i < truth.size(); ++i)
    truth_px.values[i] = truth.values[i] == 0 ? std::nanf("") : truth.values[i];
  return scorePair("aloe", readGrayImage(folder / "aloe_left.pgm"),
                   readGrayImage(folder / "aloe_right.pgm"), truth_px);
}

Agreement agreeWithLibelas(const std::filesystem::path& folder, const std::string& name,
                           double disparity_max_px) {
  const Raster<float> ours = matchWith("elas", readGrayImage(folder / (name + "_left.pgm")),
                                       readGrayImage(folder / (name + "_right.pgm")))
                                 .disparity_px;
  const GrayImage theirs = readGrayImage(folder / ("libelas_" + name + "_left_disp.pgm"));
  double within = 0, both = 0, our_count = 0, their_count = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool measured = !std::isnan(ours.values[i]), stored = theirs.values[i] != 0;
    our_count += measured;
    their_count += stored;
    if (!measured || !stored) continue;
    ++both;
    within += std::abs(ours.values[i] - theirs.values[i] * disparity_max_px / 255) <= 1;
  }
  const double all = static_cast<double>(ours.size());
  return {100 * within / both, 100 * our_count / all, 100 * their_count / all};
}

SequenceScore scoreSequence(const std::filesystem::path& folder, const std::string& truth) {
  SequenceScore score;
  SequenceReader reader(folder);
  const Rectifier rectifier(reader.calibration());
  std::vector<double> errors_mm;
  int judged = 0;
  while (const auto result = reader.next()) {
    if (!result->ok()) {
      ++score.failed_frames;
      continue;
    }
    const Measured measured = measure(result->frame.pair, rectifier, true);
    FrameScore frame{result->index, {}, measured.rows};
    const auto file = folder / truth / numbered(result->index);
    if (std::filesystem::exists(file)) {
      const Raster<float> truth_mm = readDepth(file);
      const Mask ignore =
          ignoreEither(ignoreMatchesOutside(disparityFromDepth(truth_mm, rectifier.rig())),
                       rectifier.rectifyMask(result->frame.mask));
      if (judge(measured.depth.depth_mm, truth_mm, ignore, frame.errors, errors_mm)) {
        score.mean_coverage_percent += frame.errors.coverage_percent;
        ++judged;
      }
    }
    score.frames.push_back(frame);
  }
  score.pooled_mm = statistics(errors_mm);
  score.mean_coverage_percent /= judged;
  return score;
}

CtScore scoreOpencas(const std::filesystem::path& folder, bool align_rows) {
  const StereoCalibration calibration =
      readCalibration(folder / "Stereo_SD_d_complete_22_Calibration.txt");
  const Rectifier rectifier(calibration);
  const StereoPair raw{readColourImage(folder / "left.png"), readColourImage(folder / "right.png")};
  const Measured measured = measure(raw, rectifier, align_rows);
  const auto points = rawPoints(measured.depth.depth_mm, rectifier,
                                readMask(folder / "Stereo_SD_d_complete_22_MASK_eval.png"));
  const TriangleMesh patch = readMesh(folder / "Stereo_SD_d_complete_22_CT_cut.stl");
  return {alignToSurface(points, TriangleTree(patch)), measured.rows, points.size()};
}

}  // namespace softscope::test
