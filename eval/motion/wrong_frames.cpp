// eval/motion/wrong_frames.cpp: limits, and one pass over the tracks.
#include "eval/motion/wrong_frames.h"

#include <algorithm>

#include "core/tolerance.h"

namespace softscope {
namespace {

constexpr double kWrongMm = kTolerableErrorMm, kWrongDeg = 1;
constexpr double kToldConfidence = 0.5;
constexpr double kRigidMm = 1e-3;  // positions in files are rounded

/// Offsets of the visible points, by frame and point.
std::map<int, std::map<int, Eigen::Vector3d>> offsetsInView(const TrackErrors& tracks) {
  std::map<int, std::map<int, Eigen::Vector3d>> offsets;
  for (const TrackError& e : tracks.each)
    if (e.visible && !e.unseen) offsets[e.frame][e.id] = e.offset_mm;
  return offsets;
}

}  // namespace

bool isWrong(const JudgedFrame& judged) {  // comparisons with NaN are false
  return judged.surface_mm > kWrongMm || judged.pose_mm > kWrongMm || judged.pose_deg > kWrongDeg ||
         judged.jump_mm > kWrongMm;
}

bool isSilentlyWrong(const JudgedFrame& judged) {
  return isWrong(judged) && !(judged.confidence <= kToldConfidence);
}

std::map<int, double> largestJumps(const TrackErrors& tracks) {
  std::map<int, double> jumps_mm;
  const std::map<int, Eigen::Vector3d>* before = nullptr;
  const auto offsets = offsetsInView(tracks);
  for (const auto& [frame, points] : offsets) {
    if (before != nullptr)
      for (const auto& [id, offset_mm] : points)
        if (const auto found = before->find(id); found != before->end())
          jumps_mm[frame] = std::max(jumps_mm[frame], (offset_mm - found->second).norm());
    before = &points;
  }
  return jumps_mm;
}

bool isRigid(const TrueTracks& truth) {
  std::map<int, Eigen::Vector3d> first;
  return std::all_of(truth.begin(), truth.end(), [&](const auto& sample) {
    const auto& [key, place_mm] = sample;
    return (first.try_emplace(key.second, place_mm).first->second - place_mm).norm() < kRigidMm;
  });
}

}  // namespace softscope
