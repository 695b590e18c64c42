// eval/surfaces/error_pool.h: errors of a complete series, with equal weight of all frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "eval/surfaces/model_errors.h"

namespace softscope {

/// Keeps at most a fixed number of points per model, evenly distributed over its order,
/// so that the last and largest models do not dominate a series, and memory is bounded.
class ErrorPool {
 public:
  /// `moments`: number of models to be added; at most 20 000 points
  /// of each are kept, and fewer if the total would exceed 8 million.
  explicit ErrorPool(std::size_t moments);

  /// `sigmas_mm`: predicted, one per point of the model, or empty.
  void add(const ModelErrors& errors, const std::vector<float>& sigmas_mm = {});

  const std::vector<double>& all_mm() const { return all_mm_; }
  const std::vector<double>& signed_mm() const { return signed_mm_; }
  /// Empty if no frame has a known depth.
  const std::vector<double>& observed_mm() const { return observed_mm_; }
  const std::vector<double>& predicted_mm() const { return predicted_mm_; }
  /// Predicted standard errors in the same order; NaN if unknown.
  const std::vector<double>& all_sigma_mm() const { return all_sigma_mm_; }
  const std::vector<double>& observed_sigma_mm() const { return observed_sigma_mm_; }
  const std::vector<double>& predicted_sigma_mm() const { return predicted_sigma_mm_; }

 private:
  std::size_t kept_a_moment_;
  std::vector<double> all_mm_, signed_mm_, observed_mm_, predicted_mm_;
  std::vector<double> all_sigma_mm_, observed_sigma_mm_, predicted_sigma_mm_;
};

}  // namespace softscope
