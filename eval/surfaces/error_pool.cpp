// eval/surfaces/error_pool.cpp: one point in n, at equal distances in the list.
#include "eval/surfaces/error_pool.h"

#include <algorithm>

namespace softscope {
namespace {

constexpr std::size_t kMostOfAMoment = 20000;
constexpr std::size_t kMostTogether = 8000000;

}  // namespace

ErrorPool::ErrorPool(std::size_t moments)
    : kept_a_moment_(std::clamp(kMostTogether / std::max<std::size_t>(moments, 1), std::size_t{1},
                                kMostOfAMoment)) {}

void ErrorPool::add(const ModelErrors& errors, const std::vector<float>& sigmas_mm) {
  const std::size_t count = errors.each_mm.size(), kept = std::min(count, kept_a_moment_);
  for (std::size_t k = 0; k < kept; ++k) {
    const std::size_t i = k * count / kept;
    const double sigma_mm = sigmas_mm.empty() ? Statistics::kNone : sigmas_mm.at(i);
    all_mm_.push_back(errors.each_mm[i]);
    all_sigma_mm_.push_back(sigma_mm);
    signed_mm_.push_back(errors.each_signed_mm[i]);
    if (errors.each_observed.empty()) continue;
    if (errors.each_observed[i] != 0) {
      observed_mm_.push_back(errors.each_mm[i]);
      observed_sigma_mm_.push_back(sigma_mm);
    } else if (errors.each_beyond.empty() || errors.each_beyond[i] == 0) {
      predicted_mm_.push_back(errors.each_mm[i]);
      predicted_sigma_mm_.push_back(sigma_mm);
    }
  }
}

}  // namespace softscope
