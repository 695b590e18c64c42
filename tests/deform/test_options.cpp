// tests/deform/test_options.cpp: options that contradict themselves are named before work starts.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "deform/solver/lm_solver.h"

namespace softscope {
namespace {

void expectRefused(const DeformOptions& options, const std::string& field) {
  try {
    makeDeformSolver(options);
    FAIL() << field << " was accepted";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
  }
}

TEST(DeformOptions, DefaultsAndThePapersAreValid) {
  EXPECT_NO_THROW(DeformOptions().validate());
  EXPECT_NO_THROW(DeformOptions::paper().validate());
  EXPECT_NO_THROW(GraphOptions().validate());
}

TEST(DeformOptions, ThePapersWeights) {
  const DeformOptions paper = DeformOptions::paper();
  EXPECT_EQ(paper.node_model, NodeModel::kAffine);
  EXPECT_EQ(paper.rotation_weight, 1000);
  EXPECT_EQ(paper.regularisation_weight, 10000);
  EXPECT_EQ(paper.data_weight, 1);
  EXPECT_EQ(paper.correspondence_weight, 1);
}

TEST(DeformOptions, NamesWhatIsWrong) {
  DeformOptions options;
  options.data_weight = -1;
  expectRefused(options, "deform.data_weight");
  options = {};
  options.regularisation_weight = std::numeric_limits<double>::quiet_NaN();
  expectRefused(options, "deform.regularisation_weight");
}

TEST(DeformSolver, SaysWhichNodesItSolvesFor) {
  EXPECT_EQ(makeDeformSolver(DeformOptions())->nodeModel(), DeformOptions().node_model);
  EXPECT_EQ(makeDeformSolver(DeformOptions::paper())->nodeModel(), NodeModel::kAffine);
}

}  // namespace
}  // namespace softscope
