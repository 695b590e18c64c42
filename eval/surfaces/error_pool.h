// eval/surfaces/error_pool.h: the errors of a whole series, every moment counting the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "eval/surfaces/model_errors.h"

namespace softscope {

/// Keeps at most a fixed number of a model's points, evenly spread over its order, so that a series
/// is not judged by its last and largest models alone, and memory stays flat.
class ErrorPool {
 public:
  /// `moments`: how many models will be added; of each at most 20 000 points are kept, and fewer
  /// where more than 8 million would come together.
  explicit ErrorPool(std::size_t moments);

  /// `sigmas_mm`: predicted, one a point of the model, or empty.
  void add(const ModelErrors& errors, const std::vector<float>& sigmas_mm = {});

  const std::vector<double>& all_mm() const { return all_mm_; }
  const std::vector<double>& signed_mm() const { return signed_mm_; }
  /// Empty where no moment's depth was known.
  const std::vector<double>& observed_mm() const { return observed_mm_; }
  const std::vector<double>& predicted_mm() const { return predicted_mm_; }
  /// Predicted standard errors in the same order; NaN where unknown.
  const std::vector<double>& all_sigma_mm() const { return all_sigma_mm_; }
  const std::vector<double>& observed_sigma_mm() const { return observed_sigma_mm_; }
  const std::vector<double>& predicted_sigma_mm() const { return predicted_sigma_mm_; }

 private:
  std::size_t kept_a_moment_;
  std::vector<double> all_mm_, signed_mm_, observed_mm_, predicted_mm_;
  std::vector<double> all_sigma_mm_, observed_sigma_mm_, predicted_sigma_mm_;
};

}  // namespace softscope
