#include "pipeline/submaps.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "pipeline/options/reconstruction_options.h"

namespace softscope {
namespace {

constexpr int kLeastFrames = 5;       // of a map that is kept
constexpr std::size_t kMostMaps = 8;  // not in use
constexpr int kLeastSearches = 10;    // before a map counts as left
constexpr int kTurns = 2;             // through all views

double degreesBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() * 180 / M_PI;
}

}  // namespace

void ScopeState::remember(const Eigen::Isometry3d& view) {
  for (const Eigen::Isometry3d& known : key_views)
    if ((known.translation() - view.translation()).norm() < GateOptions::kKeyViewStepMm &&
        degreesBetween(known, view) < GateOptions::kKeyViewStepDeg)
      return;
  key_views.push_back(view);
  if (key_views.size() > static_cast<std::size_t>(GateOptions::kMaxKeyViews))
    key_views.erase(key_views.begin());
}

std::vector<Eigen::Isometry3d> ScopeState::viewpointsToTry(std::size_t count) const {
  std::vector<Eigen::Isometry3d> all{world_from_left};
  all.insert(all.end(), key_views.rbegin(), key_views.rend());
  count = std::min(count, all.size());
  const std::size_t first = static_cast<std::size_t>(searches) * count % all.size();
  std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
  all.resize(count);
  return all;
}

bool ScopeState::isSearched() const {
  const int views = 1 + static_cast<int>(key_views.size());
  return searches >=
         std::max(kLeastSearches, kTurns * views / static_cast<int>(kViewpointsPerFrame));
}

void Submaps::add(Submap left) {
  const auto isSmall = [](const Submap& map) {
    return map.scope.map != 0 && map.scope.fused_frames < kLeastFrames;
  };
  if (isSmall(left)) return;
  all_.push_back(std::move(left));
  if (all_.size() <= kMostMaps) return;
  const auto worth = [](const Submap& map) {
    return map.scope.map == 0 ? std::numeric_limits<int>::max() : map.scope.fused_frames;
  };
  all_.erase(std::min_element(all_.begin(), all_.end(), [&](const Submap& a, const Submap& b) {
    return worth(a) < worth(b);
  }));
}

Submap& Submaps::next() {
  std::rotate(all_.begin(), all_.begin() + 1, all_.end());
  return all_.back();
}

Submap Submaps::take() {
  Submap taken = std::move(all_.back());
  all_.pop_back();
  return taken;
}

const MaterialPoints* Submaps::tracked() const {
  for (const Submap& map : all_)
    if (!map.model.tracked.points.empty()) return &map.model.tracked;
  return nullptr;
}

}  // namespace softscope
