// tests/features/real_data_test.cpp: matches of rendered organs against the truth, and of real
// tissue against SIFT.
#include <gtest/gtest.h>

#include "features/lift_matches.h"
#include "features/sequence_truth.h"
#include "support/data_folder.h"

namespace softscope {
namespace {

using Eigen::Vector2f;

TEST(RenderedOrgans, FrameToFrameIsATenthOfAPixel) {
  for (const auto& [name, limit_px] : {std::pair{"openhelp_heart", 0.1},
                                       // Half the resolution, steeper sides, motions to 21 px.
                                       std::pair{"openhelp_kidney_small", 0.12}}) {
    SOFTSCOPE_DATA_OR_SKIP(folder, name);
    const test::SequenceTruth truth(folder);
    const auto matcher = makeFeatureMatcher({});
    test::FlowErrors errors;
    for (const int frame : {0, 15, 30})
      errors.add(matcher->match(test::pictureOf(test::readLeft(folder, frame)),
                                test::pictureOf(test::readLeft(folder, frame + 1))),
                 test::TrueFlow(truth, frame, frame + 1));
    EXPECT_GT(errors.matches, 2000u) << name;
    EXPECT_LT(test::FlowErrors::quantile(errors.error_px, 0.5), limit_px) << name;
    EXPECT_LT(errors.outlierShare(), 0.04) << name;
  }
}

TEST(RenderedOrgans, ModelViewIsTheFrameItWasMadeOf) {
  SOFTSCOPE_DATA_OR_SKIP(folder, "openhelp_heart");
  const test::SequenceTruth truth(folder);
  const int frame = 10;
  const Eigen::Isometry3d pose = truth.poses[frame].world_from_left;
  const Raster<float> depth_mm =
      readDepth(folder / "groundtruth" / "depth" / (test::frameName(frame) + ".png"));
  const PointModel model =
      test::modelOfFrame(test::readLeft(folder, frame), depth_mm, truth.camera, pose);
  const ModelView view = renderModelView(model, truth.camera, pose, {});
  std::vector<double> errors_mm;
  double missing = 0, measured = 0;
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    if (!(depth_mm.values[i] > 0)) continue;
    ++measured;
    const double error = std::abs(view.depth_mm.values[i] - depth_mm.values[i]);
    if (std::isnan(error))
      ++missing;
    else
      errors_mm.push_back(error);
  }
  EXPECT_LT(missing / measured, 0.01);  // rims, seen too obliquely for a point of the model
  EXPECT_LT(test::FlowErrors::quantile(errors_mm, 0.5), 0.01);  // one step of the depth file
  EXPECT_LT(test::FlowErrors::quantile(errors_mm, 0.99), 0.1);

  test::FlowErrors flow;
  const auto matches = makeFeatureMatcher({})->match(
      test::pictureOf(view), test::pictureOf(test::readLeft(folder, frame + 1)));
  flow.add(matches, test::TrueFlow(truth, frame, frame + 1));
  // Points every 0.2 mm are every second pixel: a little less sharp than the picture itself.
  EXPECT_LT(test::FlowErrors::quantile(flow.error_px, 0.5), 0.14);
  EXPECT_LT(flow.outlierShare(), 0.005);
}

TEST(RealTissue, DenseSurfGivesMoreThanSift) {
  SOFTSCOPE_DATA_OR_SKIP(folder, "endonerf_pulling");
  MatcherOptions sift;
  sift.method = "sift";
  for (int frame = 0; frame < 60; frame += 20) {
    const auto read = [&](int f) {
      return test::pictureOf(test::readLeft(folder, f),
                             readMask(folder / "mask" / (test::frameName(f) + ".png")));
    };
    const MatchPicture before = read(frame), after = read(frame + 1);
    const auto dense = makeFeatureMatcher({})->match(before, after);
    const auto sparse = makeFeatureMatcher(sift)->match(before, after);
    EXPECT_GT(dense.size(), 2 * sparse.size()) << frame;
    EXPECT_GT(dense.size(), 1000u) << frame;  // the paper has 100 to 1000
  }
}

}  // namespace
}  // namespace softscope
