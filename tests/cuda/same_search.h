// tests/cuda/same_search.h: two searches for a warp took the same way.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "deform/solver/deform_summary.h"

namespace softscope::test {

inline void expectSameSearch(const DeformSummary& found, const DeformSummary& expected) {
  constexpr double kShare = 1e-6;  // sums in another order, contracted otherwise
  EXPECT_EQ(toString(found.reason), std::string(toString(expected.reason)));
  EXPECT_EQ(found.iterations, expected.iterations);
  EXPECT_EQ(found.rejections, expected.rejections);
  EXPECT_NEAR(found.before.total(), expected.before.total(), kShare * expected.before.total());
  EXPECT_NEAR(found.after.total(), expected.after.total(), kShare * expected.after.total());
  EXPECT_NEAR(found.after.data, expected.after.data, kShare * expected.after.total());
  EXPECT_EQ(found.points_before, expected.points_before);
  EXPECT_EQ(found.points_after, expected.points_after);
  EXPECT_NEAR(found.data_mean_mm_after, expected.data_mean_mm_after,
              kShare * expected.data_mean_mm_after);
  EXPECT_EQ(found.matches, expected.matches);
  EXPECT_EQ(found.matches_dropped, expected.matches_dropped);
  EXPECT_EQ(found.nodes_without_data, expected.nodes_without_data);
  EXPECT_EQ(found.components_without_data, expected.components_without_data);
  EXPECT_NEAR(found.damping, expected.damping, kShare * expected.damping);
  EXPECT_NEAR(found.last_step_mm, expected.last_step_mm, kShare);
  EXPECT_EQ(found.warnings.size(), expected.warnings.size());
}

}  // namespace softscope::test
