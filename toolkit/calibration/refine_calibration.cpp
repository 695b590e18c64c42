#include "toolkit/calibration/refine_calibration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/error.h"
#include "eval/statistics/statistics.h"
#include "io/calibrations/calibration_writer.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "pipeline/frame/frame_depth.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/rolled_rows.h"
#include "stereo/rectification/row_meter.h"
#include "stereo/rectification/view_synchrony.h"

namespace softscope {
namespace {

constexpr int kUnknowns = 4;      // pitch, roll, yaw, scale
constexpr int kRobustRounds = 6;  // iterations of reweighting
constexpr double kTukeyPx = 1.5;  // rejection limit for a match
constexpr int kResamples = 200;
constexpr std::uint64_t kRefineSeed = 15;
constexpr double kMilli = 1000;
constexpr double kNearestDepthMm = 15, kFarthestDepthMm = 250;  // of tissue from an endoscope
constexpr double kNarrowestDeg = 35, kWidestDeg = 120;          // diagonal field of view
constexpr double kDoubtfulScale = 0.5;                          // per cent

using RowMatches = std::vector<RowMatch>;
using RowMotion = Eigen::Matrix<double, kUnknowns, 1>;

/// Normal equations of least squares; plain loops, as fits to resampled frames add every match a
/// thousand times.
struct MotionEquations {
  double normal[kUnknowns][kUnknowns] = {}, side[kUnknowns] = {};

  void add(const RowMotion& terms, double value, double weight) {
    const double* a = terms.data();
    for (int i = 0; i < kUnknowns; ++i) {
      const double weighted = weight * a[i];
      side[i] += weighted * value;
      for (int j = 0; j <= i; ++j) normal[i][j] += weighted * a[j];
    }
  }
  RowMotion solution() const {
    Eigen::Matrix<double, kUnknowns, kUnknowns> lower;
    for (int i = 0; i < kUnknowns; ++i)
      for (int j = 0; j < kUnknowns; ++j) lower(i, j) = normal[i][j] + (i == j ? 1e-9 : 0);
    return lower.selfadjointView<Eigen::Lower>().ldlt().solve(Eigen::Map<const RowMotion>(side));
  }
};

/// Derivative of the vertical disparity, divided by the focal length, with respect to each
/// unknown, at a pixel of the right image: a point (x, y, 1) moves by omega x (x, y, 1).
RowMotion rowDerivative(const PinholeCamera& right, const RowMatch& match) {
  const double x = (match.u_right_px - right.cx_px) / right.fx_px;
  const double y = (match.v_right_px - right.cy_px) / right.fy_px;
  return {-(1 + y * y), x, x * y, y};
}

/// Least squares with Tukey weights, initialised at the median vertical disparity.
RowMotion fitMotion(const PinholeCamera& right, const std::vector<const RowMatches*>& frames) {
  std::vector<double> differences;
  for (const RowMatches* matches : frames)
    for (const RowMatch& match : *matches) differences.push_back(match.difference_px);
  RowMotion motion = RowMotion::Zero();
  motion[0] = -statistics(differences).median / right.fy_px;
  for (int round = 0; round < kRobustRounds; ++round) {
    MotionEquations equations;
    const double limit_px = kTukeyPx * (round == 0 ? 3 : 1);
    for (const RowMatches* matches : frames)
      for (const RowMatch& match : *matches) {
        const RowMotion a = rowDerivative(right, match);
        const double left_px = match.difference_px - right.fy_px * a.dot(motion);
        if (std::abs(left_px) >= limit_px) continue;
        const double weight = std::pow(1 - std::pow(left_px / limit_px, 2), 2);
        equations.add(a, match.difference_px / right.fy_px, weight);
      }
    motion = equations.solution();
  }
  return motion;
}

/// Mean absolute vertical disparity after `motion`,
/// over matches within 3 times the robust limit.
double rowError(const PinholeCamera& right, const std::vector<RowMatches>& frames,
                const RowMotion& motion, const RowMotion& removed) {
  std::vector<double> errors_px;
  for (const RowMatches& matches : frames)
    for (const RowMatch& match : matches) {
      const RowMotion a = rowDerivative(right, match);
      if (std::abs(match.difference_px - right.fy_px * a.dot(motion)) < kTukeyPx)
        errors_px.push_back(std::abs(match.difference_px - right.fy_px * a.dot(removed)));
    }
  return statistics(errors_px).mean;
}

/// 2.5 and 97.5 % percentiles of fits to resampled frames (bootstrap).
std::array<Interval, kUnknowns> motionIntervals(const PinholeCamera& right,
                                                const std::vector<RowMatches>& frames) {
  std::array<Interval, kUnknowns> intervals;
  if (frames.size() < 3) return intervals;
  std::mt19937_64 random(kRefineSeed);
  std::array<std::vector<double>, kUnknowns> values;
  for (int k = 0; k < kResamples; ++k) {
    std::vector<const RowMatches*> drawn;
    for (std::size_t i = 0; i < frames.size(); ++i)
      drawn.push_back(&frames[random() % frames.size()]);
    const RowMotion motion = fitMotion(right, drawn);
    for (std::size_t i = 0; i < kUnknowns; ++i) values[i].push_back(motion[static_cast<int>(i)]);
  }
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const std::vector<double> ends = percentiles(values[i], {2.5, 97.5});
    intervals[i] = {ends[0], ends[1]};
  }
  return intervals;
}

RefinedValue scaled(double value, const Interval& interval, double factor) {
  RefinedValue out{value * factor, {interval.low * factor, interval.high * factor}};
  if (out.interval.low > out.interval.high) std::swap(out.interval.low, out.interval.high);
  return out;
}

PinholeCamera rectifiedRight(const RectifiedRig& rig) {
  PinholeCamera right = rig.left;
  right.cx_px += rig.disparity_offset_px;
  return right;
}

/// p_right corrected by vertical disparity: C = exp(pitch, 0, roll) in the rectified right frame.
StereoCalibration corrected(const StereoCalibration& calibration, const Rectifier& rectifier,
                            const RowMotion& motion) {
  const Eigen::Vector3d axis(motion[0], 0, motion[1]);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (axis.norm() > 0) turn = Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix();
  // Both rectified cameras are parallel.
  const Eigen::Matrix3d rectified_from_raw_right =
      rectifier.rig().rectified_from_raw_left * calibration.right_from_left.linear().transpose();
  StereoCalibration out = calibration;
  out.right_from_left =
      Eigen::Isometry3d(rectified_from_raw_right.transpose() * turn * rectified_from_raw_right) *
      calibration.right_from_left;
  out.rectified = false;
  return out;
}

/// Frames selected from a clip.
struct ClipFrames {
  std::vector<RowMatches> matches;  // one entry per frame with enough matches
  std::vector<Frame> kept;          // frames used for depth
  StereoCalibration calibration;
  bool stopped = false;
};

ClipFrames readClipFrames(const SequencePaths& clip, const SequenceOptions& sequence,
                          const RefineOptions& options, const Progress& progress) {
  SequenceReader reader(clip, sequence);
  ClipFrames out;
  out.calibration = reader.calibration();
  const Rectifier rectifier(out.calibration);
  const int count = reader.frameCount(), every = (count - 1) / options.frames + 1;
  const int disparity_px = std::min(options.disparity_max_px, rectifier.rig().left.width_px / 2);
  RowPlane rolled;
  for (int i = 0; auto result = reader.next(); ++i) {
    if (!reportProgress(progress, i, count)) {
      out.stopped = true;
      return out;
    }
    if (i % every != 0 || !result->ok()) continue;
    if (result->frame.pair.right.empty())
      throw InputError("the clip has no right view, but rows of both are compared.");
    const StereoPair rectified = rectifier.rectify(result->frame.pair);
    const Mask ignored = rectifier.outside().left;
    RowMeter meter(toGray(rectified.left), disparity_px, ignored);
    const GrayImage right = toGray(rectified.right);
    if (out.matches.empty()) rolled = findRolledRows(meter, right);
    RowMatches matches = meter.match(right, rectifier.outside().right, rolled);
    if (static_cast<int>(matches.size()) < RowAlignment::kFewestMatches) continue;
    out.matches.push_back(std::move(matches));
    if (static_cast<int>(out.kept.size()) < options.depth_frames)
      out.kept.push_back(std::move(result->frame));
  }
  reportProgress(progress, count, count);
  if (out.matches.empty())
    throw InputError(say("none of ", count, " frames has ", RowAlignment::kFewestMatches,
                         " points that both views show. Are they of one moment, of textured "
                         "tissue, and left and right not exchanged?"));
  return out;
}

double medianDepth(const ClipFrames& clip, const StereoCalibration& calibration) {
  FrameDepth depth(calibration, FrameDepthOptions{});
  std::vector<double> depths_mm;
  for (const Frame& frame : clip.kept)
    for (const float value : depth.measure(frame).depth.depth_mm.values)
      if (std::isfinite(value)) depths_mm.push_back(value);
  return statistics(depths_mm).median;
}

double diagonalView(const PinholeCamera& camera) {
  const double radius = std::hypot(camera.width_px / camera.fx_px, camera.height_px / camera.fy_px);
  return 2 * std::atan(radius / 2) * 180 / 3.14159265358979323846;
}

/// Surely, by its interval.
bool isBeyond(const RefinedValue& value, double limit) {
  return value.interval.low > limit || value.interval.high < -limit;
}

void addDoubts(RefinedCalibration* refined) {
  const double view = refined->diagonal_view_deg, depth = refined->median_depth_mm;
  if (view < kNarrowestDeg || view > kWidestDeg)
    refined->doubts.push_back(
        say("the focal length gives a diagonal view of ", std::lround(view),
            " degrees, but scopes have 35 to 120. Is the calibration of this image size?"));
  if (depth < kNearestDepthMm || depth > kFarthestDepthMm)
    refined->doubts.push_back(say("focal length and baseline put the tissue at ", depth,
                                  " mm, but 15 to 250 mm are expected. Is one of them of another "
                                  "scope or unit?"));
  if (isBeyond(refined->scale_percent, kDoubtfulScale))
    refined->doubts.push_back(say("the right view's rows are scaled by ",
                                  refined->scale_percent.value,
                                  " % against the left ones: the focal lengths do not fit each "
                                  "other. Calibrate with a board."));
  if (isBeyond(refined->yaw_mrad, kMilli * RowDoubt::kLargestYawRad))
    refined->doubts.push_back(say("the rows fan out as if the right camera were turned by ",
                                  refined->yaw_mrad.value,
                                  " mrad sideways against the calibration, which rows alone can't "
                                  "correct: depth is wrong then. Calibrate with a board."));
}

std::string withInterval(const RefinedValue& value, const std::string& unit) {
  std::string text = fixed(value.value, 3) + " " + unit;
  if (std::isfinite(value.interval.low))
    text += " [" + fixed(value.interval.low, 3) + ", " + fixed(value.interval.high, 3) + "]";
  return text;
}

FactSheet::Json finiteOrNull(double value) {
  return std::isfinite(value) ? FactSheet::Json(value) : FactSheet::Json(nullptr);
}

void addRefined(const std::string& label, const std::string& key, const std::string& unit,
                const RefinedValue& value, FactSheet* facts) {
  facts->add(label, withInterval(value, unit), key,
             {{"value", value.value},
              {"ci_95", {finiteOrNull(value.interval.low), finiteOrNull(value.interval.high)}}});
}

}  // namespace

void RefineOptions::validate() const {
  require(frames >= 1, "refine.frames", frames, "must be 1 or more");
  require(depth_frames >= 1, "refine.depth_frames", depth_frames, "must be 1 or more");
  require(disparity_max_px >= 16, "refine.disparity_max_px", disparity_max_px,
          "must be 16 or more");
}

RefinedCalibration refineCalibration(const SequencePaths& clip, const SequenceOptions& sequence,
                                     const RefineOptions& options, const Progress& progress) {
  options.validate();
  const ClipFrames frames = readClipFrames(clip, sequence, options, progress);
  RefinedCalibration refined;
  refined.stopped = frames.stopped;
  if (refined.stopped) return refined;
  const Rectifier rectifier(frames.calibration);
  const PinholeCamera right = rectifiedRight(rectifier.rig());
  std::vector<const RowMatches*> all;
  for (const RowMatches& matches : frames.matches) {
    all.push_back(&matches);
    refined.matches += static_cast<int>(matches.size());
  }
  const RowMotion motion = fitMotion(right, all);
  const RowMotion removed(motion[0], motion[1], 0, 0);
  const auto intervals = motionIntervals(right, frames.matches);
  refined.frames = static_cast<int>(frames.matches.size());
  refined.row_error_px = rowError(right, frames.matches, motion, RowMotion::Zero());
  refined.row_error_left_px = rowError(right, frames.matches, motion, removed);
  refined.offset_px = scaled(motion[0], intervals[0], -right.fy_px);
  refined.pitch_mrad = scaled(motion[0], intervals[0], kMilli);
  refined.roll_mrad = scaled(motion[1], intervals[1], kMilli);
  refined.yaw_mrad = scaled(motion[2], intervals[2], kMilli);
  refined.scale_percent = scaled(motion[3], intervals[3], 100);
  refined.calibration = corrected(frames.calibration, rectifier, motion);
  refined.median_depth_mm = medianDepth(frames, refined.calibration);
  refined.diagonal_view_deg = diagonalView(right);
  addDoubts(&refined);
  return refined;
}

std::string refinedCalibrationText(const RefinedCalibration& refined) {
  return calibrationYaml(refined.calibration) +
         say("quality:\n   refined_from_frames: ", refined.frames,
             "\n   row_error_px: ", exactText(refined.row_error_left_px),
             "\n   row_error_before_px: ", exactText(refined.row_error_px),
             "\n   pitch_mrad: ", exactText(refined.pitch_mrad.value),
             "\n   roll_mrad: ", exactText(refined.roll_mrad.value), "\n");
}

FactSheet refinedCalibrationFacts(const RefinedCalibration& refined) {
  FactSheet facts("calibration refined by tissue");
  facts.add("frames", "frames", refined.frames);
  facts.add("matches", "matches", refined.matches);
  facts.add("row error",
            fixed(refined.row_error_px, 3) + " px as calibrated, " +
                fixed(refined.row_error_left_px, 3) + " px after the correction (mean)",
            "row_error_px", refined.row_error_px);
  facts.addQuietly("row_error_left_px", refined.row_error_left_px);
  addRefined("offset of rows", "offset_px", "px, right below left", refined.offset_px, &facts);
  addRefined("pitch", "pitch_mrad", "mrad, corrected", refined.pitch_mrad, &facts);
  addRefined("roll", "roll_mrad", "mrad, corrected", refined.roll_mrad, &facts);
  addRefined("yaw", "yaw_mrad", "mrad, reported alone", refined.yaw_mrad, &facts);
  addRefined("scale", "scale_percent", "% of the right rows, reported alone", refined.scale_percent,
             &facts);
  facts.add("tissue", "median depth " + fixed(refined.median_depth_mm, 1) + " mm",
            "median_depth_mm", finiteOrNull(refined.median_depth_mm));
  facts.add("view", fixed(refined.diagonal_view_deg, 1) + " degrees across the diagonal",
            "diagonal_view_deg", refined.diagonal_view_deg);
  facts.add("focal length", refined.doubts.empty() ? "plausible" : "doubtful, see the warnings",
            "focal_length_plausible", refined.doubts.empty());
  for (const std::string& doubt : refined.doubts) facts.warn(doubt);
  return facts;
}

}  // namespace softscope
