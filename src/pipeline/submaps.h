// src/pipeline/submaps.h: models of several places, one of them in use.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "pipeline/reconstruction_backend.h"

namespace softscope {

/// The scope in the world of a map.
struct ScopeState {
  int map = 0;  // number of the map, in the order of their beginnings
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d reference_pose = Eigen::Isometry3d::Identity();  // of the last reliable motion
  std::vector<Eigen::Isometry3d> key_views;
  bool lost = false;
  bool scope_moves = false;  // in the last fused frame
  int fused_frames = 0;
  int unfused_frames = 0;  // since the last fused one
  int searches = 0;        // searches over the whole image among them

  /// That a lost frame is compared with.
  static constexpr std::size_t kViewpointsPerFrame = 3;

  /// A key view, unless one is near.
  void remember(const Eigen::Isometry3d& view);
  /// `count` of the last pose and the key views, latest first. Each search continues where the
  /// previous one stopped.
  std::vector<Eigen::Isometry3d> viewpointsToTry(std::size_t count) const;
  /// True once every view was tried twice in vain.
  bool isSearched() const;
};

/// A map that the scope left.
struct Submap {
  ModelState model;
  ScopeState scope;
};

/// The maps that are not in use. The first map is never forgotten.
class Submaps {
 public:
  bool empty() const { return all_.empty(); }
  const std::vector<Submap>& all() const { return all_; }
  void restore(std::vector<Submap> all) { all_ = std::move(all); }

  /// Sets a map aside, unless it is of a few frames only. The smallest is forgotten where they are
  /// too many.
  void add(Submap left);
  /// Each in turn.
  Submap& next();
  /// The one that next() returned last.
  Submap take();
  /// The tracked points of the map that has them; null if it is the one in use.
  const MaterialPoints* tracked() const;

 private:
  std::vector<Submap> all_;  // in the order of their turns
};

}  // namespace softscope
