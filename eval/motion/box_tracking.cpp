// eval/motion/box_tracking.cpp: hits and misses per frame, failures, weighted means.
#include "eval/motion/box_tracking.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

/// Centre of a box; SurgT truncates it to integer pixels.
Eigen::Vector2d centreOf(const PixelBox& box) {
  return {std::trunc(box.u_px + box.width_px / 2), std::trunc(box.v_px + box.height_px / 2)};
}

/// 3-D position of the centres of both boxes, mm; none unless the disparity is positive.
std::optional<Eigen::Vector3d> positionOf(const StereoBoxes& boxes, const RectifiedRig& rig) {
  const Eigen::Vector2d left = centreOf(boxes.left);
  const double disparity_px = left.x() - centreOf(boxes.right).x();
  if (disparity_px <= 0) return std::nullopt;
  return liftPixel(rig.left, left.x(), left.y(), rig.depthMm(disparity_px));
}

/// History of one score until its failure.
struct Run {
  std::vector<double> values;  // one per evaluated frame; NaN without a value
  std::size_t hits = 0;
  int misses_in_succession = 0;
  bool failed = false;

  void add(double value, bool hit) {
    values.push_back(value);
    hits += hit;
    misses_in_succession = hit ? 0 : misses_in_succession + 1;
  }

  /// The misses that cause the failure do not count.
  void failAfter(int misses_allowed) {
    if (failed || misses_in_succession <= misses_allowed) return;
    failed = true;
    const std::size_t dropped =
        std::min(values.size(), static_cast<std::size_t>(misses_allowed) + 1);
    values.resize(values.size() - dropped);
  }
};

class BoxJudge {
 public:
  BoxJudge(const RectifiedRig& rig, const BoxTrackingOptions& options, int last_frame)
      : rig_(rig), options_(options), last_frame_(last_frame) {}

  void addFrame(int frame, const BoxTruth& truth, const std::optional<StereoBoxes>& estimate) {
    const bool judged = truth.visible && !truth.difficult;
    if (!judged) {
      addOverlap(frame, Statistics::kNone);
    } else {
      ++visible_frames_;
      if (plane_.failed) addOverlap(frame, 0);
    }
    if (plane_.failed && space_.failed) return;
    if (judged)
      addOverlap(frame, judge(*truth.boxes, estimate));
    else if (!truth.difficult && estimate && !truth.boxes)
      ++excess_frames_;
  }

  JudgedBoxTrack result() const {
    JudgedBoxTrack result;
    result.overlaps = overlaps_;
    BoxScores& scores = result.scores;
    const Statistics plane = statistics(plane_.values), space = statistics(space_.values);
    scores.frames_judged = visible_frames_ + excess_frames_;
    scores.accuracy = plane.count == 0 ? 0 : statistics(accuracy()).mean;
    scores.error_px = plane.mean;
    scores.error_sd_px = plane.sd;
    scores.error_mm = space.mean;
    scores.error_sd_mm = space.sd;
    scores.frames_2d = plane.count;
    scores.frames_3d = space.count;
    scores.robustness_2d = robustness(plane_.hits);
    scores.robustness_3d = robustness(space_.hits);
    return result;
  }

 private:
  std::vector<double> accuracy() const {
    const auto kept = static_cast<std::ptrdiff_t>(plane_.values.size());
    return {plane_overlaps_.begin(), plane_overlaps_.begin() + kept};
  }

  double robustness(std::size_t hits) const {
    if (visible_frames_ + excess_frames_ == 0) return 1;
    return static_cast<double>(hits) / static_cast<double>(visible_frames_ + excess_frames_);
  }

  void addOverlap(int frame, double overlap) {
    if (frame <= last_frame_) overlaps_.push_back(overlap);
  }

  /// Returns the overlap of the frame, 0 after the 2-D failure.
  double judge(const StereoBoxes& truth, const std::optional<StereoBoxes>& estimate) {
    double overlap = 0;
    if (!plane_.failed) overlap = judgePlane(truth, estimate);
    if (!space_.failed) judgeSpace(truth, estimate);
    plane_.failAfter(options_.misses_allowed);
    space_.failAfter(options_.misses_allowed);
    return overlap;
  }

  double judgePlane(const StereoBoxes& truth, const std::optional<StereoBoxes>& estimate) {
    if (!estimate) {
      plane_overlaps_.push_back(Statistics::kNone);
      plane_.add(Statistics::kNone, false);
      return 0;
    }
    const double left = boxOverlap(truth.left, estimate->left);
    const double right = boxOverlap(truth.right, estimate->right);
    const double error_px = ((centreOf(truth.left) - centreOf(estimate->left)).norm() +
                             (centreOf(truth.right) - centreOf(estimate->right)).norm()) /
                            2;
    plane_overlaps_.push_back((left + right) / 2);
    plane_.add(error_px, left > options_.overlap_limit && right > options_.overlap_limit);
    return (left + right) / 2;
  }

  void judgeSpace(const StereoBoxes& truth, const std::optional<StereoBoxes>& estimate) {
    const auto expected = positionOf(truth, rig_);
    const auto found = estimate ? positionOf(*estimate, rig_) : std::nullopt;
    if (!expected || !found) return space_.add(Statistics::kNone, false);
    const double error_mm = (*found - *expected).norm();
    space_.add(error_mm, error_mm <= options_.error_limit_mm);
  }

  const RectifiedRig& rig_;
  const BoxTrackingOptions& options_;
  int last_frame_;
  Run plane_, space_;  // errors in px, in mm
  std::vector<double> plane_overlaps_;
  std::vector<double> overlaps_;
  std::size_t visible_frames_ = 0, excess_frames_ = 0;
};

int lastJudgedFrame(const std::vector<BoxTruth>& truth) {
  for (int frame = static_cast<int>(truth.size()) - 1; frame >= 0; --frame) {
    const BoxTruth& one = truth[static_cast<std::size_t>(frame)];
    if (one.visible && !one.difficult) return frame;
  }
  return 0;
}

void requireBoxes(const std::vector<BoxTruth>& truth, int first_frame) {
  const auto usable = [&](int frame) {
    return frame >= 0 && frame < static_cast<int>(truth.size()) &&
           truth[static_cast<std::size_t>(frame)].visible &&
           !truth[static_cast<std::size_t>(frame)].difficult;
  };
  if (!usable(first_frame))
    throw InputError("a track begins in frame " + std::to_string(first_frame) +
                     ", where the target is not visible in both views or difficult; begin at a "
                     "frame with a usable true box");
  for (std::size_t frame = 0; frame < truth.size(); ++frame)
    if (truth[frame].visible && !truth[frame].boxes)
      throw InputError("true boxes: frame " + std::to_string(frame) +
                       " is visible, but has no box; give both boxes or call it not visible");
}

double weighted(double sum, double value, std::size_t weight) {
  return weight == 0 ? sum : sum + value * static_cast<double>(weight);
}

}  // namespace

void BoxTrackingOptions::validate() const {
  require(misses_allowed >= 0, "misses_allowed", misses_allowed, "can't be negative");
  require(overlap_limit >= 0 && overlap_limit < 1, "overlap_limit", overlap_limit,
          "must be 0 or more and below 1");
  require(error_limit_mm > 0, "error_limit_mm", error_limit_mm, "must be above 0");
  require(first_rank >= 0, "first_rank", first_rank, "can't be negative");
  require(last_rank > first_rank, "last_rank", last_rank, "must be above first_rank");
}

double boxOverlap(const PixelBox& a, const PixelBox& b) {
  const double width =
      std::min(a.u_px + a.width_px, b.u_px + b.width_px) - std::max(a.u_px, b.u_px);
  const double height =
      std::min(a.v_px + a.height_px, b.v_px + b.height_px) - std::max(a.v_px, b.v_px);
  const double shared = std::max(0.0, width) * std::max(0.0, height);
  const double all = a.width_px * a.height_px + b.width_px * b.height_px - shared;
  return all > 0 ? shared / all : 0;
}

JudgedBoxTrack judgeBoxTrack(const std::vector<BoxTruth>& truth, const BoxTrack& track,
                             const RectifiedRig& rig, const BoxTrackingOptions& options) {
  options.validate();
  requireBoxes(truth, track.first_frame);
  BoxJudge judge(rig, options, lastJudgedFrame(truth));
  for (std::size_t i = 0; static_cast<std::size_t>(track.first_frame) + 1 + i < truth.size(); ++i) {
    const std::size_t frame = static_cast<std::size_t>(track.first_frame) + 1 + i;
    judge.addFrame(static_cast<int>(frame), truth[frame],
                   i < track.boxes.size() ? track.boxes[i] : std::nullopt);
  }
  return judge.result();
}

BoxScores mergeBoxScores(const std::vector<BoxScores>& scores) {
  BoxScores sum;
  double accuracy = 0, error_px = 0, error_sd_px = 0, error_mm = 0, error_sd_mm = 0,
         robustness_2d = 0, robustness_3d = 0;
  for (const BoxScores& one : scores) {
    accuracy = weighted(accuracy, one.accuracy, one.frames_2d);
    error_px = weighted(error_px, one.error_px, one.frames_2d);
    error_sd_px = weighted(error_sd_px, one.error_sd_px, one.frames_2d);
    error_mm = weighted(error_mm, one.error_mm, one.frames_3d);
    error_sd_mm = weighted(error_sd_mm, one.error_sd_mm, one.frames_3d);
    robustness_2d = weighted(robustness_2d, one.robustness_2d, one.frames_judged);
    robustness_3d = weighted(robustness_3d, one.robustness_3d, one.frames_judged);
    sum.frames_2d += one.frames_2d;
    sum.frames_3d += one.frames_3d;
    sum.frames_judged += one.frames_judged;
  }
  const auto mean = [](double total, std::size_t weight) {
    return weight == 0 ? Statistics::kNone : total / static_cast<double>(weight);
  };
  sum.accuracy = mean(accuracy, sum.frames_2d);
  sum.error_px = mean(error_px, sum.frames_2d);
  sum.error_sd_px = mean(error_sd_px, sum.frames_2d);
  sum.error_mm = mean(error_mm, sum.frames_3d);
  sum.error_sd_mm = mean(error_sd_mm, sum.frames_3d);
  sum.robustness_2d = mean(robustness_2d, sum.frames_judged);
  sum.robustness_3d = mean(robustness_3d, sum.frames_judged);
  return sum;
}

std::vector<double> overlapCurve(const std::vector<std::vector<double>>& sequences) {
  std::size_t longest = 0;
  for (const auto& sequence : sequences) longest = std::max(longest, sequence.size());
  std::vector<double> curve;
  for (std::size_t rank = 0; rank < longest; ++rank) {
    std::vector<double> values;
    for (const auto& sequence : sequences)
      if (rank < sequence.size()) values.push_back(sequence[rank]);
    curve.push_back(statistics(values).mean);
  }
  return curve;
}

double expectedAverageOverlap(const std::vector<std::vector<double>>& target_curves,
                              const BoxTrackingOptions& options) {
  options.validate();
  const std::vector<double> curve = overlapCurve(target_curves);
  const std::size_t begin = std::min(curve.size(), static_cast<std::size_t>(options.first_rank));
  const std::size_t end = std::min(curve.size(), static_cast<std::size_t>(options.last_rank));
  return statistics({curve.begin() + static_cast<std::ptrdiff_t>(begin),
                     curve.begin() + static_cast<std::ptrdiff_t>(end)})
      .mean;
}

}  // namespace softscope
