// tests/toolkit/learned_depth_test.cpp: depth by a network of the user.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/geometry/depth_files.h"
#include "support/data_folder.h"
#include "support/in_folder.h"
#include "support/onnx_network.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

class LearnedDepth : public InFolder {
 protected:
  MeasureOptions options(const std::string& sequence) const {
    return measurement(sequence, at("out"));
  }
};

// A fraction of a pixel at 14 px of disparity: 50 mm to a millimetre.
TEST_F(LearnedDepth, ANetworkMeasuresWhatElasDoes) {
  const std::string sequence = makeSequence("s", 1);
  PlaneSweep sweep;
  sweep.disparities = 24;
  sweep.window_px = 7;
  sweep.sharpness = 1;
  const std::string model = write("private/net.onnx", sweep.model());
  MeasureOptions learned = options(sequence);
  set({"stereo.method=onnx", "stereo.model=" + model}, &learned.settings);
  const Json json = written(measureSequence(learned).record);
  EXPECT_EQ(json["method"], "onnx");
  EXPECT_EQ(json["inputs"]["stereo_model"], "net.onnx");
  EXPECT_EQ(json["options"]["stereo.model"], "net.onnx") << "no path";
  EXPECT_GT(json["mean_coverage"], 0.7);
  EXPECT_NEAR(json["frames"][0]["depth_mm"]["median"], 50, 1);
}

TEST_F(LearnedDepth, ANetworkMeasuresTheRenderedHeart) {
  SOFTSCOPE_DATA_OR_SKIP(heart, "openhelp_heart");
  PlaneSweep sweep;
  sweep.disparities = 64;
  sweep.window_px = 11;
  sweep.channels = 1;
  const std::string model = write("net.onnx", sweep.model());
  MeasureOptions learned = options(heart);
  learned.settings.sequence.frames = parseFrameRange("0:1");
  learned.kinds = DepthOutputKinds::parse("depth");
  set({"stereo.method=onnx", "stereo.model=" + model}, &learned.settings);
  measureSequence(learned);
  const Raster<float> found = readDepth(at("out/000000_depth.pfm"));
  const Raster<float> truth = readDepth(heart / "groundtruth/depth/000000.png");
  std::vector<double> errors_mm;
  std::size_t known = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    known += std::isfinite(truth.values[i]);
    const double error_mm = std::abs(found.values[i] - truth.values[i]);
    if (std::isfinite(error_mm)) errors_mm.push_back(error_mm);
  }
  EXPECT_GT(errors_mm.size(), 0.6 * known);
  const auto middle = errors_mm.begin() + long(errors_mm.size() / 2);
  std::nth_element(errors_mm.begin(), middle, errors_mm.end());
  RecordProperty("median_mm", std::to_string(*middle));
  RecordProperty("coverage", std::to_string(double(errors_mm.size()) / double(known)));
  EXPECT_LT(*middle, 0.4);  // a quarter of a pixel at 65 mm here
}

TEST_F(LearnedDepth, ABadNetworkIsRefused) {
  const std::string sequence = makeSequence("s", 2);
  const auto expect = [&](const std::string& model, const std::string& part) {
    const std::vector<std::string> network{"stereo.method=onnx", "stereo.model=" + model};
    MeasureOptions depth = options(sequence);
    set(network, &depth.settings);
    expectError<InputError>([&] { measureSequence(depth); }, {part});
    EXPECT_FALSE(fs::exists(at("out")));
    ReconstructOptions run = reconstruction(sequence, at("out"));
    set(network, &run.settings);
    expectError<InputError>([&] { reconstructSequence(run); }, {part});
    EXPECT_FALSE(fs::exists(at("out")));
  };
  expect(at("none.onnx"), "none.onnx");
  expect(write("text.onnx", "a network"), "text.onnx: isn't an ONNX model");
  PlaneSweep lacking, zero;
  lacking.more = {"GridSample"};
  zero.output_factor = 0;
  expect(write("lacking.onnx", lacking.model()), "lacks operators of this network: GridSample");
  expect(write("zero.onnx", zero.model()), "its output disparity is 0 to 0");
  MeasureOptions alone = options(sequence);
  set({"stereo.method=onnx"}, &alone.settings);
  expectError<OptionError>([&] { measureSequence(alone); }, {"stereo.model=FILE.onnx"});
}

}  // namespace
}  // namespace softscope::test
