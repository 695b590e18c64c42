// tests/cuda/upload_passes_test.cpp: frames copied ahead are those at hand, and no others are.
#include <gtest/gtest.h>

#include "comparison_cases.h"
#include "core/error.h"
#include "cuda/frame/upload_run.h"
#include "host_machine.h"

namespace softscope::test {
namespace {

class Uploads : public testing::Test {
 protected:
  void upload(const ComparisonScene& scene) {
    uploader_.upload(scene.observation(), scene.states(), gray_, {});
  }
  void expectAtHand(const ComparisonScene& scene) const {
    const DepthMap& depth = scene.observation().depth;
    ASSERT_TRUE(rasters_->holds(depth.depth_mm.values.data()));
    const std::size_t pixels = depth.depth_mm.size();
    EXPECT_EQ(std::memcmp(rasters_->depth_mm, depth.depth_mm.values.data(), 4 * pixels), 0);
    EXPECT_EQ(std::memcmp(rasters_->states, scene.states().values.data(), pixels), 0);
    EXPECT_EQ(std::memcmp(rasters_->match_gray, gray_.values.data(), pixels), 0);
    EXPECT_EQ(rasters_->sigma_mm == nullptr, depth.sigma_mm.empty());
    EXPECT_EQ(rasters_->ignore, nullptr);
  }

  const ComparisonScene first_{comparisonCases()[0]}, second_{comparisonCases()[1]};
  const GrayImage gray_{241, 178, 77};
  std::shared_ptr<cuda::SharedRasters> rasters_ = std::make_shared<cuda::SharedRasters>();
  cuda::UploadRun<HostMachine> uploader_{ComparisonScene::camera(), rasters_, 1U};
};

TEST_F(Uploads, LieBesideTheFrameAtHandUntilTheyAreUsed) {
  upload(first_);
  uploader_.use(first_.observation().depth);
  expectAtHand(first_);
  upload(second_);
  expectAtHand(first_);
  uploader_.use(second_.observation().depth);
  expectAtHand(second_);
}

TEST_F(Uploads, AreUsedOnceAndForTheirFrameAlone) {
  upload(first_);
  uploader_.use(second_.observation().depth);
  EXPECT_FALSE(rasters_->holds(first_.observation().depth.depth_mm.values.data()));
  EXPECT_FALSE(rasters_->holds(second_.observation().depth.depth_mm.values.data()));
  uploader_.use(first_.observation().depth);
  EXPECT_FALSE(rasters_->holds(first_.observation().depth.depth_mm.values.data()));
}

TEST_F(Uploads, OfAnotherCameraAreRefused) {
  PinholeCamera small = ComparisonScene::camera();
  --small.width_px;
  cuda::UploadRun<HostMachine> uploader(small, rasters_, 1U);
  EXPECT_THROW(uploader.upload(first_.observation(), first_.states(), gray_, {}), Error);
}

}  // namespace
}  // namespace softscope::test
