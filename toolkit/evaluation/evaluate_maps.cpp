// toolkit/evaluation/evaluate_maps.cpp: even sampling of models and points for error maps.
#include "toolkit/evaluation/evaluate_maps.h"

#include <algorithm>

namespace softscope {
namespace {

constexpr std::size_t kMostMoments = 24, kMostPoints = 20000, kMostOfReference = 3000;

/// Deterministic hash (finaliser of MurmurHash3).
std::uint64_t scrambled(std::uint64_t value) {
  value = (value ^ (value >> 33)) * 0xff51afd7ed558ccdULL;
  value = (value ^ (value >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return value ^ (value >> 33);
}

/// One index per `kept` equal intervals of [0, count). Points are in pixel
/// order: a constant position within each interval would appear as stripes.
std::vector<std::size_t> spreadIndices(std::size_t count, std::size_t kept) {
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < kept; ++k) {
    const std::size_t begin = k * count / kept, end = (k + 1) * count / kept;
    indices.push_back(begin + scrambled(k) % (end - begin));
  }
  return indices;
}

}  // namespace

std::vector<std::size_t> indicesOfMap(std::size_t count) {
  return spreadIndices(count, std::min(count, kMostPoints));
}

bool ErrorMaps::keepsNext() const {
  if (next_ >= moments_) return false;
  const std::size_t wanted = std::min(moments_, kMostMoments);
  const auto keptUpTo = [&](std::size_t count) { return count * wanted / moments_; };
  return keptUpTo(next_ + 1) != keptUpTo(next_);  // the last model is always kept
}

void ErrorMaps::add(int frame, double time_s, const std::vector<Eigen::Vector3f>& points_mm,
                    const ModelErrors& errors, const TriangleMesh& truth,
                    const Eigen::Isometry3d& world_from_left) {
  const bool keep = keepsNext();
  ++next_;
  if (!keep) return;
  ErrorMap map;
  map.frame = frame;
  map.time_s = time_s;
  map.look = world_from_left.linear().col(2).cast<float>();
  map.up = -world_from_left.linear().col(1).cast<float>();
  for (const std::size_t i : indicesOfMap(points_mm.size())) {
    map.surface.vertices_mm.push_back(points_mm[i]);
    map.absolute_mm.push_back(static_cast<float>(errors.each_mm[i]));
    map.signed_mm.push_back(static_cast<float>(errors.each_signed_mm[i]));
    if (!errors.each_observed.empty()) map.observed.push_back(errors.each_observed[i]);
  }
  map.reference = coarse(truth);
  map.surface.space = map.reference.space = truth.space;
  kept_.push_back(std::move(map));
}

TriangleMesh ErrorMaps::coarse(const TriangleMesh& truth) {
  if (coarse_.vertices.empty() || truth.triangles != first_truth_.triangles ||
      truth.vertices_mm.size() != first_truth_.vertices_mm.size()) {
    coarse_ = coarsen(truth, kMostOfReference);
    first_truth_ = truth;
  }
  return coarse_.at(truth.vertices_mm);
}

}  // namespace softscope
