// tests/deform/test_block_cholesky.cpp: the sparse solve against a dense one.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "deform/cholesky/block_cholesky.h"
#include "deform/kernels/deform_kernels.h"

namespace softscope {
namespace {

struct System {
  BlockPattern pattern;
  int block_size = 0;
  std::vector<double> values;
  Eigen::MatrixXd dense;
  Eigen::VectorXd rhs;
};

/// A jittered grid of nodes, each tied to its neighbours up to two steps away.
BlockPattern gridPattern(int columns, int rows) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          const int i = y * columns + x, j = (y + dy) * columns + x + dx;
          const bool inside = x + dx >= 0 && x + dx < columns && y + dy >= 0 && y + dy < rows;
          if (inside && i > j && (i * 7 + j * 3) % 5 != 0) pairs.emplace_back(i, j);
        }
  return makeBlockPattern(columns * rows, std::move(pairs));
}

System randomSystem(const BlockPattern& pattern, int block_size) {
  System system{pattern, block_size, {}, {}, {}};
  const int n = block_size, size = n * pattern.nodes();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  system.dense = Eigen::MatrixXd::Zero(size, size);
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b) {
      const int i = pattern.row[b];
      Eigen::MatrixXd block = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return value(random); });
      if (i == j) block = (block + block.transpose()).eval();
      if (i == j) block.diagonal().array() += 15 * n;  // dominant: positive definite
      system.dense.block(i * n, j * n, n, n) = block;
      system.dense.block(j * n, i * n, n, n) = block.transpose();
      system.values.insert(system.values.end(), block.data(), block.data() + n * n);
    }
  system.rhs = Eigen::VectorXd::NullaryExpr(size, [&] { return value(random); });
  return system;
}

class BlockSizes : public ::testing::TestWithParam<int> {};

TEST_P(BlockSizes, SolvesAsADenseSolverDoes) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 1}, {7, 5}, {12, 11}}) {
    const System system = randomSystem(gridPattern(columns, rows), GetParam());
    BlockCholesky cholesky;
    cholesky.analyse(system.pattern, system.block_size);
    ASSERT_TRUE(cholesky.factor(system.values, {}));

    const Eigen::VectorXd found = cholesky.solve(system.rhs);

    const Eigen::VectorXd truth = system.dense.llt().solve(system.rhs);
    EXPECT_LT((found - truth).norm(), 1e-12 * truth.norm());  // condition number is below 100
  }
}

TEST_P(BlockSizes, DampsTheBlockDiagonal) {
  System system = randomSystem(gridPattern(6, 4), GetParam());
  BlockCholesky cholesky;
  cholesky.analyse(system.pattern, system.block_size);
  ASSERT_TRUE(cholesky.factor(system.values, {0.5, 2.0}));

  const Eigen::VectorXd found = cholesky.solve(system.rhs);

  const int n = system.block_size;
  for (int j = 0; j < system.pattern.nodes(); ++j) system.dense.block(j * n, j * n, n, n) *= 1.5;
  system.dense.diagonal().array() += 2.0;
  const Eigen::VectorXd truth = system.dense.llt().solve(system.rhs);
  EXPECT_LT((found - truth).norm(), 1e-12 * truth.norm());
}

TEST_P(BlockSizes, GivesTheSameBytesOnOneThreadAndOnTwo) {
  const System system = randomSystem(gridPattern(20, 18), GetParam());  // large enough for two
  std::vector<Eigen::VectorXd> found;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    BlockCholesky cholesky;
    cholesky.analyse(system.pattern, system.block_size);
    ASSERT_TRUE(cholesky.factor(system.values, {}));
    found.push_back(cholesky.solve(system.rhs));
  }
  EXPECT_TRUE(found[0] == found[1]);
  EXPECT_TRUE(found[0] == found[2]);
}

TEST_P(BlockSizes, FactorsAgainWithoutNewAnalysis) {
  System system = randomSystem(gridPattern(8, 8), GetParam());
  BlockCholesky cholesky;
  cholesky.analyse(system.pattern, system.block_size);
  ASSERT_TRUE(cholesky.factor(system.values, {}));
  const Eigen::VectorXd first = cholesky.solve(system.rhs);
  for (double& value : system.values) value *= 4;
  ASSERT_TRUE(cholesky.factor(system.values, {}));
  EXPECT_TRUE(cholesky.solve(system.rhs) == first / 4);  // powers of two: exact
}

TEST_P(BlockSizes, SaysSoWhereTheMatrixIsNotPositiveDefinite) {
  System system = randomSystem(gridPattern(5, 5), GetParam());
  BlockCholesky cholesky;
  cholesky.analyse(system.pattern, system.block_size);
  const std::size_t block = static_cast<std::size_t>(GetParam()) * GetParam();
  const std::vector<double> good = system.values;
  system.values[system.pattern.column_start[12] * block] = -1;
  EXPECT_FALSE(cholesky.factor(system.values, {}));
  EXPECT_THROW(cholesky.solve(system.rhs), Error);
  system.values = good;
  system.values[system.pattern.column_start[12] * block] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.factor(system.values, {}));
  EXPECT_TRUE(cholesky.factor(good, {}));  // a failure leaves nothing behind
}

INSTANTIATE_TEST_SUITE_P(RigidAndAffine, BlockSizes, ::testing::Values(6, 12));

TEST(BlockCholesky, TakesUnconnectedNodesAndNone) {
  const System apart = randomSystem(makeBlockPattern(4, {}), 6);
  BlockCholesky cholesky;
  cholesky.analyse(apart.pattern, 6);
  ASSERT_TRUE(cholesky.factor(apart.values, {}));
  EXPECT_LT((apart.dense * cholesky.solve(apart.rhs) - apart.rhs).norm(), 1e-12);
  cholesky.analyse(makeBlockPattern(0, {}), 6);
  EXPECT_TRUE(cholesky.factor({}, {}));
  EXPECT_EQ(cholesky.solve(Eigen::VectorXd()).size(), 0);
}

TEST(BlockCholesky, RefusesBlocksThatItsTilesDoNotDivide) {
  BlockCholesky cholesky;
  EXPECT_THROW(cholesky.analyse(makeBlockPattern(2, {}), 5), OptionError);
}

/// Every instruction set, on numbers that are exact in binary: no rounding, so the same results.
TEST(DeformKernels, AllSetsAgreeOnExactNumbers) {
  constexpr int kRows = 17, kLeading = 24, kInner = 9;
  std::vector<double> a(kLeading * kInner), c(kLeading * 6);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = static_cast<double>(i * 7 % 11) - 5;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = static_cast<double>(i * 5 % 13) - 6;
  const auto list = allDeformKernels();
  for (int set = 0; set < list.count; ++set) {
    std::vector<double> found = c;
    list.sets[set]->updateColumns(found.data(), kLeading, a.data(), a.data() + 2, kLeading, kRows,
                                  kInner);
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < kRows; ++i) {
        double truth = c[i + j * kLeading];
        for (int k = 0; k < kInner; ++k) truth -= a[i + k * kLeading] * a[2 + j + k * kLeading];
        EXPECT_EQ(found[i + j * kLeading], truth) << list.sets[set]->instruction_set;
      }
  }
}

}  // namespace
}  // namespace softscope
