// tests/toolkit/evaluation_parts_test.cpp: models from bytes, limits from texts.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "io/geometry/ply_writer.h"
#include "support/made_run.h"
#include "toolkit/evaluation/held_out_views.h"
#include "toolkit/evaluation/thresholds.h"
#include "toolkit/run/frame_clock.h"
#include "toolkit/run/frame_outcomes.h"
#include "toolkit/run/model_file.h"

namespace softscope::test {
namespace {

TEST(EvaluatePoints, AreReadAsTheyWereWritten) {
  const PointCloud model = wallModel(1);
  const ModelFile file = parseModel(plyBytes(model, {"world", ""}), "model");
  EXPECT_EQ(file.model.positions_mm, model.points_mm);
  EXPECT_EQ(file.model.normals, model.normals);
  EXPECT_EQ(file.model.colours, model.colours);
  EXPECT_TRUE(file.coloured);
}

TEST(EvaluatePoints, HeadersOfOtherFilesAreRefused) {
  const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  for (const std::string& bytes :
       {std::string("obj"),
        head + "0\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
        head + "1\nproperty double x\nproperty float y\nproperty float z\nend_header\n" +
            std::string(16, '\0'),
        head + "1\nproperty float y\nproperty float x\nproperty float z\nend_header\n" +
            std::string(12, '\0'),
        std::string("ply\nformat binary_little_endian 1.0\nend_header\n")})
    EXPECT_THROW(parseModel(bytes, "model"), InputError) << bytes;
}

TEST(EvaluateThresholds, CompareAsWritten) {
  EXPECT_TRUE(parseThreshold("a>2").fails(2.1));
  EXPECT_FALSE(parseThreshold("a>2").fails(2));
  EXPECT_TRUE(parseThreshold("a >= 2").fails(2));
  EXPECT_TRUE(parseThreshold("a<-1e-3").fails(-1));
  EXPECT_TRUE(parseThreshold("a<=0").fails(0));
  EXPECT_TRUE(parseThreshold("a<=0").fails(std::nan(""))) << "not measured isn't good";
}

TEST(EvaluateThresholds, PerCentAsksForAShare) {
  const FactSheet::Json result{{"outcomes", {{"lost", 3}, {"lost_share", 0.25}}}};
  const auto check = [&](const char* text) {
    return checkThresholds({parseThreshold(text)}, result, "outcomes")[0];
  };
  EXPECT_TRUE(check("lost>10%").failed);
  EXPECT_FALSE(check("lost > 30 %").failed);
  EXPECT_TRUE(check("lost_share>=25%").failed);
  EXPECT_EQ(check("lost>10%").path, "outcomes.lost_share");
  EXPECT_EQ(check("lost>10%").threshold.text(), "lost>10%");
  EXPECT_EQ(check("lost>2").path, "outcomes.lost") << "a count";
  EXPECT_THROW(parseThreshold("lost>%"), OptionError);
}

TEST(HeldOutFacts, NameTheShareOfTheFrames) {
  HeldOutResult result;
  result.every = 3;
  result.views.emplace_back();
  FactSheet facts("run");
  addHeldOutFacts(result, facts);
  EXPECT_NE(facts.text().find("over 1 frames (one in every 3)"), std::string::npos) << facts.text();
}

TEST(FrameOutcomes, AreCountedAndShownFrameByFrame) {
  FrameOutcomes outcomes;
  EXPECT_TRUE(outcomes.fused(3)) << "nothing is known against it";
  EXPECT_TRUE(outcomes.json()["lost_share"].is_number() &&
              std::isnan(outcomes.json()["lost_share"].get<double>()));
  for (int frame = 0; frame < 33; ++frame)
    outcomes.set(frame, frame == 0   ? FusionOutcome::kFused
                        : frame == 4 ? FusionOutcome::kSkipped
                                     : FusionOutcome::kLost);
  EXPECT_EQ(outcomes.text(), "1 of 33 fused, 1 skipped, 31 lost");
  EXPECT_EQ(outcomes.strip(), "#LLLs" + std::string(28, 'L'));
  EXPECT_FALSE(outcomes.fused(3));
  FrameOutcomes many;
  for (int frame = 0; frame < 1000; ++frame)
    many.set(frame, frame == 500 ? FusionOutcome::kLost : FusionOutcome::kFused);
  EXPECT_EQ(many.strip().size(), 72u);
  EXPECT_EQ(many.strip().find('L'), 36u) << "a single lost frame of a long run is still seen";
}

TEST(FrameClock, FrameNumbersAreNoTimes) {
  EXPECT_FALSE(hasClock({0, 1, 2}, std::vector<double>{0, 1, 2}));
  EXPECT_TRUE(hasClock({0, 1, 2}, std::vector<double>{0, 0.04, 0.08}));
  EXPECT_FALSE(hasClock({0, 1, 2}, std::vector<double>{0, 0.04, std::nan("")}));
  EXPECT_FALSE(hasClock({0, 1}, std::vector<double>{0.04, 0.04}));
}

TEST(EvaluateThresholds, AmbiguousNamesMustBeWrittenInFull) {
  const FactSheet::Json result{{"a", {{"x_mm", 1}}}, {"b", {{"x_mm", 2}, {"y_mm", nullptr}}}};
  EXPECT_THROW(checkThresholds({parseThreshold("x_mm>0")}, result, "c"), OptionError);
  EXPECT_EQ(checkThresholds({parseThreshold("x_mm>0")}, result, "a")[0].path, "a.x_mm");
  EXPECT_EQ(checkThresholds({parseThreshold("b.x_mm>1")}, result, "a")[0].path, "b.x_mm");
  EXPECT_TRUE(checkThresholds({parseThreshold("y_mm>1")}, result, "a")[0].failed);
}

}  // namespace
}  // namespace softscope::test
