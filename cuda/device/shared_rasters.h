// cuda/device/shared_rasters.h: rasters of the frame at hand that lie on the device already.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <mutex>
#include <vector>

#include "core/image.h"
#include "fusion/observation.h"

namespace softscope::cuda {

/// Known by their place in the host's memory. Whoever copies them sets this once they are there,
/// and clears it before that memory changes; no stage may look at the same time.
struct SharedRasters {
  const float* host_depth_mm = nullptr;
  const float *depth_mm = nullptr, *sigma_mm = nullptr;  // on the device; without sigmas null
  const Eigen::Vector3f* normals = nullptr;
  const PixelState* states = nullptr;
  const Rgb8* colour = nullptr;                                 // null without
  const std::uint8_t *match_gray = nullptr, *ignore = nullptr;  // as it is matched; null: nothing

  bool holds(const float* depth) const { return depth != nullptr && depth == host_depth_mm; }
};

/// Rasters of the frames on the device: of one where stereo left it, of those that are surveyed and
/// wait for their turn, and of the one that the stages work on. Frames are surveyed on one thread
/// while another works on the frame at hand.
class SharedFrames {
 public:
  static constexpr int kWaiting = 2;

  SharedRasters measured;  // for the thread that surveys
  SharedRasters at_hand;   // for the stages; use() sets it

  /// What is known of that memory by now is forgotten.
  void add(const SharedRasters& surveyed) {
    const std::lock_guard lock(mutex_);
    const auto is_old = [&](const SharedRasters& one) { return one.holds(surveyed.host_depth_mm); };
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), is_old), waiting_.end());
    waiting_.push_back(surveyed);
  }
  /// Those before it are of no use then; without it, none of them is, and nothing is at hand.
  void use(const float* host_depth_mm) {
    const std::lock_guard lock(mutex_);
    const auto found = whereIs(host_depth_mm);
    const bool is_there = found != waiting_.end();
    at_hand = is_there ? *found : SharedRasters();
    waiting_.erase(waiting_.begin(), is_there ? found + 1 : found);
  }
  /// Waiting; empty if it is not.
  SharedRasters find(const float* host_depth_mm) const {
    const std::lock_guard lock(mutex_);
    const auto found = whereIs(host_depth_mm);
    return found != waiting_.end() ? *found : SharedRasters();
  }
  /// For one more: the first of too many, which never had its turn, is given up.
  void makeRoom() {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() == kWaiting) waiting_.erase(waiting_.begin());
  }
  /// Whether a frame lies there.
  bool holds(const PixelState* states) const {
    const std::lock_guard lock(mutex_);
    const auto lies = [&](const SharedRasters& one) { return one.states == states; };
    return lies(at_hand) || std::any_of(waiting_.begin(), waiting_.end(), lies);
  }

 private:
  std::vector<SharedRasters>::const_iterator whereIs(const float* host_depth_mm) const {
    return std::find_if(waiting_.begin(), waiting_.end(),
                        [&](const SharedRasters& one) { return one.holds(host_depth_mm); });
  }

  mutable std::mutex mutex_;
  std::vector<SharedRasters> waiting_;  // in the order of their turns
};

}  // namespace softscope::cuda
