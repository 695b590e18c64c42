// tests/stereo/onnx_matcher_test.cpp: disparity by networks that the tests write.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/networks/disparity_network.h"
#include "stereo/networks/onnx_model.h"
#include "support/folder_test.h"
#include "support/onnx_network.h"
#include "support/scene.h"

namespace softscope::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Coarse noise of all levels from 40 on, the right image shifted by `shift_px` columns.
StereoPair shiftedPair(int width_px, int height_px, int shift_px) {
  std::mt19937 random(1);
  ColourImage wide(width_px + shift_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < wide.width_px; ++u) {
      const auto level = [&] { return static_cast<std::uint8_t>(40 + random() % 216); };
      const bool repeats = u % 2 == 1 || v % 2 == 1;  // squares of 2 x 2 pixels
      wide.at(u, v) = repeats ? wide.at(u - u % 2, v - v % 2) : Rgb8{level(), level(), level()};
    }
  StereoPair pair{ColourImage(width_px, height_px), ColourImage(width_px, height_px)};
  for (int v = 0; v < height_px; ++v) {
    std::copy_n(wide.row(v), width_px, pair.left.row(v));
    std::copy_n(wide.row(v) + shift_px, width_px, pair.right.row(v));
  }
  return pair;
}

class OnnxNetwork : public FolderTest {
 protected:
  std::unique_ptr<StereoMatcher> matcher(const std::string& bytes,
                                         const std::string& input = "levels") const {
    StereoOptions options;
    options.method = "onnx";
    options.model = write("net.onnx", bytes);
    options.model_input = input;
    options.disparity_max_px = 63;
    return makeStereoMatcher(options);
  }

  /// Error for these bytes; empty if there is none.
  std::string complaintOf(const std::string& bytes) const {
    try {
      matcher(bytes)->prepare(96, 64);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  /// Inside, beyond what the network's window and the shift take, all have this disparity.
  static void expectEverywhere(const DisparityMap& map, int truth_px, float tolerance_px) {
    constexpr int kRim = 8;
    int measured = 0, inside = 0;
    for (int v = kRim; v < map.disparity_px.height_px - kRim; ++v)
      for (int u = truth_px + kRim; u < map.disparity_px.width_px - kRim; ++u) {
        ++inside;
        const float d = map.disparity_px.at(u, v), sigma = map.sigma_px.at(u, v);
        ASSERT_EQ(std::isnan(d), std::isnan(sigma));
        if (std::isnan(d)) continue;
        ++measured;
        ASSERT_NEAR(d, static_cast<float>(truth_px), tolerance_px) << u << ", " << v;
        ASSERT_GE(sigma, 0.1f);
      }
    EXPECT_GT(measured, 0.9 * inside);
  }
};

// Whole shifts have an exact answer: the cost of the true disparity is 0.
TEST_F(OnnxNetwork, FindsAWholeShiftExactly) {
  for (const int shift_px : {4, 10}) {
    const StereoPair pair = shiftedPair(160, 96, shift_px);
    const auto stereo = matcher(PlaneSweep{}.model());
    EXPECT_EQ(stereo->name(), "onnx");
    expectEverywhere(stereo->matchColour(pair, {}), shift_px, 1e-3f);
    EXPECT_FALSE(stereo->times().empty());
  }
}

TEST_F(OnnxNetwork, TakesEveryConventionOfNamesSignSizeAndChannels) {
  const StereoPair pair = shiftedPair(160, 96, 6);
  PlaneSweep plain, negative, named, gray, tall;
  negative.output_factor = -1;
  named.right_first = true;
  named.left = "Left_Image", named.right = "RIGHT.image";
  gray.channels = 1;
  tall.height = 128, tall.width = 192;  // larger than the pair
  for (const PlaneSweep& sweep : {plain, negative, named, gray, tall})
    expectEverywhere(matcher(sweep.model())->matchColour(pair, {}), 6, 1e-3f);
  PlaneSweep first, second;  // without the words, the first is left
  first.left = "a", first.right = "b";
  second = first, second.right_first = true;
  expectEverywhere(matcher(first.model())->matchColour(pair, {}), 6, 1e-3f);
  const DisparityMap exchanged = matcher(second.model())->matchColour(pair, {});
  const auto& found = exchanged.disparity_px.values;
  const auto is_number = [](float d) { return !std::isnan(d); };
  EXPECT_LT(std::count_if(found.begin(), found.end(), is_number), 160 * 96 / 10);
}

TEST_F(OnnxNetwork, TakesTheScaleOfLevelsThatItIsTold) {
  const StereoPair pair = shiftedPair(160, 96, 6);
  PlaneSweep unit, image_net;
  unit.sharpness *= 255;  // per unit as per level
  image_net.sharpness *= 255 * 0.225f;
  expectEverywhere(matcher(unit.model(), "unit")->matchColour(pair, {}), 6, 1e-3f);
  expectEverywhere(matcher(image_net.model(), "imagenet")->matchColour(pair, {}), 6, 1e-3f);
}

// 80 x 48 holds half of the pair: a shift of 8 is one of 4 there.
TEST_F(OnnxNetwork, ScalesThePairDownToAFixedSize) {
  PlaneSweep small;
  small.height = 48, small.width = 80;
  expectEverywhere(matcher(small.model())->matchColour(shiftedPair(160, 96, 8), {}), 8, 0.1f);
}

TEST_F(OnnxNetwork, AFlowIsItsFirstChannel) {
  PlaneSweep sweep;
  OnnxGraph flow = sweep.graph();
  flow.weights("twice", {2, 1, 1, 1}, {1, 0.5f});
  flow.node("Conv", {"disparity", "twice"}, "disp_flow");
  flow.output("disp_flow", {1, 2, "height", "width"});
  EXPECT_THAT(complaintOf(flow.model()), HasSubstr("one is expected")) << "two outputs of a name";
  PlaneSweep other;
  other.result = "d";
  OnnxGraph named = other.graph();
  named.weights("twice", {2, 1, 1, 1}, {1, 0.5f});
  named.node("Conv", {"d", "twice"}, "disp_flow", OnnxGraph::integers("kernel_shape", {1, 1}));
  named.output("disp_flow", {1, 2, "height", "width"});
  expectEverywhere(matcher(named.model())->matchColour(shiftedPair(160, 96, 6), {}), 6, 1e-3f);
}

TEST_F(OnnxNetwork, LeavesMaskedPixelsOfEitherViewOut) {
  const StereoPair pair = shiftedPair(160, 96, 6);
  ViewMasks ignored{Mask(160, 96), Mask(160, 96)};
  for (int v = 40; v < 60; ++v)
    for (int u = 60; u < 90; ++u) ignored.left.at(u, v) = 1, ignored.right.at(u + 30, v) = 1;
  const DisparityMap map = matcher(PlaneSweep{}.model())->matchColour(pair, ignored);
  for (int v = 40; v < 60; ++v)
    for (int u = 60; u < 126; ++u)
      ASSERT_TRUE(std::isnan(map.disparity_px.at(u, v)) || (u >= 90 && u < 96)) << u;
  EXPECT_NEAR(map.disparity_px.at(50, 20), 6, 1e-3);
}

TEST_F(OnnxNetwork, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto scene = makeScene(endoscope(), plane(80, 0.3, 0.1), 2.0);
  PlaneSweep sweep;
  sweep.disparities = 28;
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return matcher(sweep.model())->match(scene.left, scene.right);
  };
  const DisparityMap one = run(1), two = run(2);
  const auto same = [](const Raster<float>& a, const Raster<float>& b) {
    return std::memcmp(a.values.data(), b.values.data(), a.size() * sizeof(float)) == 0;
  };
  EXPECT_TRUE(same(one.disparity_px, two.disparity_px));
  EXPECT_TRUE(same(one.sigma_px, two.sigma_px));
}

// On slanted tissue with noise; the mean of the weighted disparities is a rough estimate.
TEST_F(OnnxNetwork, PredictsItsErrorOnRenderedTissue) {
  for (const double noise : {1.0, 4.0}) {
    const auto scene = makeScene(endoscope(), plane(80, 0.3, 0.1), noise);
    PlaneSweep sweep;
    sweep.disparities = 28;
    sweep.window_px = 9;
    sweep.sharpness = 1;  // fractions between whole disparities
    const DisparityMap map = matcher(sweep.model())->match(scene.left, scene.right);
    std::vector<double> errors, ratios;
    for (std::size_t i = 0; i < map.disparity_px.size(); ++i) {
      const double error = std::abs(map.disparity_px.values[i] - scene.disparity_px.values[i]);
      if (std::isnan(error)) continue;
      errors.push_back(error);
      ratios.push_back(error / map.sigma_px.values[i]);
    }
    ASSERT_GT(errors.size(), 320u * 240u / 2);
    const auto median = [](std::vector<double>& values) {
      std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
      return values[values.size() / 2];
    };
    EXPECT_LT(median(errors), 0.2);
    EXPECT_LT(median(ratios), 1.0);  // 0.67 for normal errors of a perfect prediction
    EXPECT_GT(median(ratios), 0.2);
  }
}

TEST_F(OnnxNetwork, ABadFileIsNamedInOneLine) {
  StereoOptions options;
  options.method = "onnx";
  const auto complaint = [&](const std::string& path) -> std::string {
    options.model = path;
    try {
      makeStereoMatcher(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(complaint(folder / "none.onnx"), HasSubstr("none.onnx: does not exist"));
  EXPECT_THAT(complaint(folder), HasSubstr("is a folder"));
  const std::string sound = PlaneSweep{}.model();
  for (const std::string& bytes :
       {std::string(), std::string("left: right"), std::string(2000, '\xff'), sound.substr(0, 900),
        sound.substr(5), std::string("\x08\x07", 2)})
    EXPECT_THAT(complaint(write("bad.onnx", bytes)),
                AllOf(HasSubstr("bad.onnx: isn't an ONNX model"), Not(HasSubstr("\n"))));
}

TEST_F(OnnxNetwork, OtherInputsAreToldAsFoundAndExpected) {
  const auto inputs = [](const std::vector<OnnxShape>& shapes, int type = 1) {
    OnnxGraph graph;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      graph.input("in" + std::to_string(i), shapes[i], type);
    graph.node("Sub", {"in0", "in1"}, "disparity");
    graph.output("disparity", {1, 1, 64, 96});
    return graph.model();
  };
  const OnnxShape image{1, 3, 64, 96};
  const auto expect = [&](const std::string& bytes, const std::string& found,
                          const std::string& expected) {
    EXPECT_THAT(complaintOf(bytes), AllOf(HasSubstr("net.onnx: its inputs are "), HasSubstr(found),
                                          HasSubstr(expected), Not(HasSubstr("\n"))));
  };
  expect(inputs({image}), "in0: 1 x 3 x 64 x 96 float32, but", "two are expected");
  expect(inputs({image, image, image}), "in2: 1 x 3 x 64 x 96", "two are expected");
  expect(inputs({image, {1, 3, 64, 95}}), "in1: 1 x 3 x 64 x 95", "two of one shape");
  expect(inputs({{1, 6, 64, 96}, {1, 6, 64, 96}}), "1 x 6 x", "1 or 3 channels");
  expect(inputs({{2, 3, 64, 96}, {2, 3, 64, 96}}), "2 x 3 x", "a batch of 1");
  expect(inputs({{64, 96}, {64, 96}}), "in0: 64 x 96 float32", "1 x 3 x height x width float32");
  expect(inputs({image, image}, 10), "of ONNX's type 10", "float32 are expected");
  expect(inputs({{1, "c", 64, 96}, {1, "c", 64, 96}}), "1 x ? x 64", "1 or 3 channels");
}

TEST_F(OnnxNetwork, OtherOutputsAreToldAsFoundAndExpected) {
  PlaneSweep sweep;
  OnnxGraph several = sweep.graph();
  several.output("share", {1, 16, "height", "width"});
  EXPECT_EQ(complaintOf(several.model()), "") << "the one with disp in its name";
  PlaneSweep unnamed;
  unnamed.result = "d";
  several = unnamed.graph();
  several.output("share", {1, 16, "height", "width"});
  EXPECT_THAT(complaintOf(several.model()),
              AllOf(HasSubstr("its outputs are d: 1 x 1 x ? x ? float32, share: 1 x 16"),
                    HasSubstr("`disp` in its name")));
  OnnxGraph quarter = PlaneSweep{}.graph();
  quarter.node(
      "AveragePool", {"disparity"}, "disp_4",
      OnnxGraph::integers("kernel_shape", {4, 4}) + OnnxGraph::integers("strides", {4, 4}));
  EXPECT_EQ(complaintOf(quarter.model()), "");
  PlaneSweep small;
  small.result = "d";
  quarter = small.graph();
  quarter.node(
      "AveragePool", {"d"}, "disp_4",
      OnnxGraph::integers("kernel_shape", {4, 4}) + OnnxGraph::integers("strides", {4, 4}));
  quarter.output("disp_4", {1, 1, 16, 24});
  EXPECT_THAT(complaintOf(quarter.model()),
              AllOf(HasSubstr("its output disp_4 is 1 x 1 x 16 x 24, but 1 x 1 x 64 x 96"),
                    Not(HasSubstr("\n"))));
}

TEST_F(OnnxNetwork, OperatorsThatOpenCvLacksAreNamed) {
  PlaneSweep sweep;
  sweep.more = {"GridSample", "Relu", "Frobnicate"};
  EXPECT_THAT(complaintOf(sweep.model()),
              AllOf(HasSubstr("net.onnx: OpenCV "),
                    HasSubstr("lacks operators of this network: GridSample, Frobnicate."),
                    Not(HasSubstr("Relu")), Not(HasSubstr("\n"))));
  OnnxGraph foreign = PlaneSweep{}.graph();
  foreign.node("Warp", {"disparity"}, "w", "", "com.maker");
  EXPECT_THAT(complaintOf(foreign.model()), HasSubstr("this network: com.maker.Warp."));
}

TEST_F(OnnxNetwork, OutputsWithoutDisparityAreTold) {
  PlaneSweep infinite, zero, far;
  infinite.more = {"Log", "Sqrt", "Log"};  // Log(0) at the rim alone: some pixels stay finite
  infinite.output_factor = -1;
  EXPECT_THAT(complaintOf(infinite.model()),
              AllOf(HasSubstr("has no finite value"), HasSubstr("96 x 64")));
  zero.output_factor = 0;
  EXPECT_THAT(complaintOf(zero.model()), HasSubstr("its output disparity is 0 to 0 on a trial"));
  far.output_factor = 1e6f;
  EXPECT_THAT(complaintOf(far.model()), HasSubstr("up to stereo.disparity_max_px, are expected"));
}

TEST_F(OnnxNetwork, WeightsInOtherFilesAreRefused) {
  OnnxGraph graph = PlaneSweep{}.graph();
  graph.weights("far", {1}, {}, protobuf::number(14, 1));
  EXPECT_THAT(complaintOf(graph.model()), HasSubstr("keeps its weights in other files"));
}

TEST(StereoOptions, MethodAndModelBelongTogether) {
  StereoOptions options;
  options.method = "onnx";
  EXPECT_THROW(options.validate(), OptionError);
  options.model = "net.onnx";
  EXPECT_NO_THROW(options.validate());
  options.method = "elas";
  EXPECT_THROW(options.validate(), OptionError);
}

TEST(OnnxModel, AnInputShapeIsDeclaredAndTheRestStays) {
  const std::string bytes = PlaneSweep{}.model();
  const OnnxModel before = parseOnnx(bytes, "n");
  EXPECT_EQ(before.inputs[0].shape, (std::vector<std::int64_t>{1, 3, -1, -1}));
  const std::string sized = withInputShape(bytes, "n", {1, 3, 64, 96});
  const OnnxModel after = parseOnnx(sized, "n");
  ASSERT_EQ(after.inputs.size(), 2u);
  EXPECT_EQ(after.inputs[1].text(), "right: 1 x 3 x 64 x 96 float32");
  EXPECT_EQ(after.operators.size(), before.operators.size());
  EXPECT_EQ(after.outputs[0].name, "disparity");
}

}  // namespace
}  // namespace softscope::test
