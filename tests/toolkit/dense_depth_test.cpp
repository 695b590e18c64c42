// tests/toolkit/dense_depth_test.cpp: depth of every pixel, measured or filled.
#include <gtest/gtest.h>

#include <cmath>

#include "io/geometry/depth_files.h"
#include "support/in_folder.h"
#include "support/scene.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

class DenseDepthFiles : public InFolder {};

// A third of the image has no partner or no texture: the slope is there, too.
TEST_F(DenseDepthFiles, GiveEveryPixelAValueAndAStandardError) {
  const std::string sequence = makeSequence("s", 1);
  MeasureOptions options = measurement(sequence, at("out"));
  options.dense = true;
  const Json json = written(measureSequence(options).record);
  const Raster<float> depth_mm = readDepth(at("out/000000_depth.pfm"));
  const Raster<float> dense_mm = readDepth(at("out/000000_dense.pfm"));
  const Raster<float> sigma_mm = readDepth(at("out/000000_dense_sigma.pfm"));
  const Scene scene = makeScene(sequenceRig(), plane(50, 0.2, 0.1));
  int filled = 0, within = 0;
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    ASSERT_GT(dense_mm.values[i], 0) << i;
    ASSERT_GT(sigma_mm.values[i], 0) << i;
    if (std::isfinite(depth_mm.values[i])) {
      ASSERT_EQ(dense_mm.values[i], depth_mm.values[i]);
      continue;
    }
    ++filled;
    within += std::abs(dense_mm.values[i] - scene.depth_mm.values[i]) < 2 * sigma_mm.values[i];
  }
  ASSERT_GT(filled, 1000);
  EXPECT_GT(within, 0.8 * filled);
  EXPECT_LT(double(json["mean_coverage"]), 0.95) << "of what was measured";
  EXPECT_TRUE(fs::exists(at("out/000000_dense.png")));
}

}  // namespace
}  // namespace softscope::test
