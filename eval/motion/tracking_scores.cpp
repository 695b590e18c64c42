// eval/motion/tracking_scores.cpp: counts per threshold and their ratios.
#include "eval/motion/tracking_scores.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? Statistics::kNone : static_cast<double>(part) / static_cast<double>(whole);
}

double meanOver(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void requireThresholds(const std::vector<double>& thresholds) {
  require(!thresholds.empty(), "thresholds", thresholds.size(), "there must be one or more");
}

void requireFinite(const std::vector<Eigen::Vector3d>& points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError("end point " + std::to_string(i) + " of the " + what +
                       " is not finite; every point takes a position, also an extrapolated one");
}

void addThreshold(const std::vector<JudgedPoint>& points, double threshold,
                  TrackingScores& scores) {
  std::size_t true_positive = 0, false_positive = 0, false_negative = 0, within_visible = 0,
              visible = 0;
  for (const JudgedPoint& point : points) {
    const bool within = point.error < threshold;
    true_positive += within && point.truly_visible && point.said_visible;
    false_positive += point.said_visible && !(point.truly_visible && within);
    false_negative += point.truly_visible && !(point.said_visible && within);
    within_visible += within && point.truly_visible;
    visible += point.truly_visible;
  }
  scores.jaccard_at.push_back(
      share(true_positive, true_positive + false_positive + false_negative));
  scores.accuracy_at.push_back(share(within_visible, visible));
}

}  // namespace

std::vector<double> trackingThresholdsPx() { return {2, 4, 8, 16, 32}; }
std::vector<double> trackingThresholdsMm() { return {2, 4, 8, 16, 32}; }
std::vector<double> endPointThresholdsPx() { return {4, 8, 16, 32, 64}; }
std::vector<double> endPointThresholdsMm() { return {2, 4, 8, 16, 32}; }

TrackingScores trackingScores(const std::vector<JudgedPoint>& points,
                              const std::vector<double>& thresholds) {
  requireThresholds(thresholds);
  TrackingScores scores;
  scores.count = points.size();
  std::size_t right = 0;
  for (const JudgedPoint& point : points) {
    if (!std::isfinite(point.error))
      throw InputError(
          "the error of a tracked point is not finite; every point takes a position in every "
          "frame, also an extrapolated one");
    right += point.truly_visible == point.said_visible;
  }
  for (const double threshold : thresholds) addThreshold(points, threshold, scores);
  scores.average_jaccard = meanOver(scores.jaccard_at);
  scores.average_accuracy = meanOver(scores.accuracy_at);
  scores.occlusion_accuracy = share(right, points.size());
  return scores;
}

std::vector<double> endPointDistances(const std::vector<Eigen::Vector3d>& estimates,
                                      const std::vector<Eigen::Vector3d>& truth) {
  if (truth.empty()) throw InputError("there is no true end point; a clip has one or more");
  requireFinite(estimates, "estimate");
  requireFinite(truth, "truth");
  std::vector<double> distances;
  for (const Eigen::Vector3d& estimate : estimates) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : truth)
      nearest = std::min(nearest, (estimate - point).norm());
    distances.push_back(nearest);
  }
  return distances;
}

EndPointScores endPointScores(const std::vector<double>& distances,
                              const std::vector<double>& thresholds) {
  requireThresholds(thresholds);
  EndPointScores scores;
  scores.distance = statistics(distances);
  for (const double threshold : thresholds) {
    const auto within = std::count_if(distances.begin(), distances.end(),
                                      [&](double distance) { return distance <= threshold; });
    scores.accuracy_at.push_back(share(static_cast<std::size_t>(within), distances.size()));
  }
  scores.average_accuracy = meanOver(scores.accuracy_at);
  return scores;
}

}  // namespace softscope
