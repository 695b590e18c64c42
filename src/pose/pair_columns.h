// src/pose/pair_columns.h: matched points by coordinate, several of them at a time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "pose/rigid_fit.h"

namespace softscope {

/// The usable pairs: finite, with a weight above 0.
class PairColumns {
 public:
  explicit PairColumns(const PointPairs& pairs);

  int size() const { return static_cast<int>(pairs_.size()); }
  /// Which of the given pairs.
  std::size_t pair(int i) const { return pairs_[static_cast<std::size_t>(i)]; }
  Eigen::Vector3f source(int i) const { return {source_[0][i], source_[1][i], source_[2][i]}; }
  Eigen::Vector3f target(int i) const { return {target_[0][i], target_[1][i], target_[2][i]}; }
  float weight(int i) const { return weights_[i]; }

  /// Squared distance of each, mm².
  Eigen::ArrayXf squaredDistances(const Eigen::Isometry3f& target_from_source) const;
  /// Sum of squared distances of at most `limit` each; stops once it exceeds `best`.
  double truncatedScore(const Eigen::Isometry3f& target_from_source, float limit,
                        double best) const;
  /// Of those with a squared distance up to `limit`.
  PairSums sumsWithin(const Eigen::ArrayXf& squares, float limit) const;

 private:
  /// Of the block that begins there, without the upper half of the squares.
  PairSums sumsInBlock(const Eigen::ArrayXf& squares, float limit, int begin) const;
  void squaresIn(const Eigen::Isometry3f& target_from_source, int begin, int count,
                 float* squares) const;

  std::array<Eigen::ArrayXf, 3> source_, target_;
  Eigen::ArrayXf weights_;
  std::vector<std::size_t> pairs_;
};

}  // namespace softscope
