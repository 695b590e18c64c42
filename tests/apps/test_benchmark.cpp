// tests/apps/test_benchmark.cpp: `softscope benchmark` of each data set but STIR on simulated
// clips.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "io/datasets/c3vd_files.h"
#include "io/datasets/surgt_files.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class Benchmark : public InFolder {
 protected:
  void simulate(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> words{"simulate", "--out", at(out), "--set", "organ.cells_per_side=30",
                                   "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    if (std::find(more.begin(), more.end(), "--size") == more.end())
      words.insert(words.end(), {"--size", "144x108"});
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  nlohmann::json benchmark(const std::string& name, const std::string& data,
                           const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"benchmark", name,     at(data), "--out",
                                   at("b"),     "--json", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? outcome.json() : nlohmann::json();
  }
};

TEST_F(Benchmark, SurgtStartsTrackersEvery50FramesAndFollowsAsInOurOwnForm) {
  simulate("data/case/1", {"--layout", "surgt", "--frames", "52"});
  const auto json = benchmark("surgt", "data", {"--jobs", "2"});
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["clips"][0], "case_1");
  EXPECT_EQ(json["starts"], 6);  // three targets, at frames 0 and 50
  EXPECT_EQ(json["missing_starts"], 0);
  EXPECT_TRUE(json["scores"]["eao"].is_null());  // no track has 150 frames
  // Every visible frame is a hit; the others count as excess where there is an estimate.
  int visible = 0;
  for (int target = 0; target < 3; ++target) {
    const auto truth =
        readSurgtTruth(at("data/case/1/gt_rectified_" + std::to_string(target) + ".yaml"));
    for (int start : {0, 50})
      for (std::size_t f = std::size_t(start) + 1; f < truth.size(); ++f)
        visible += truth[f].visible_in_both;
  }
  EXPECT_NEAR(
      json["scores"]["robustness_2d"].get<double>() * json["scores"]["frames"].get<double>(),
      visible, 1e-6);
  EXPECT_GE(json["scores"]["frames"], visible);
  EXPECT_GT(json["scores"]["accuracy"], 0.9);
  EXPECT_LT(json["scores"]["accuracy"].get<double>() - 1, 1e-9);
  EXPECT_GT(json["scores"]["accuracy"], json["control"]["accuracy"]);
  EXPECT_LT(json["scores"]["error_px"], 1.5);  // centres are truncated to whole pixels
  EXPECT_TRUE(json["latency_ms"]["p95"].is_number());

  // The same frames and pixels in our own form, of which the calibration alone is its own.
  simulate("own", {"--set", "pictures=mp4", "--frames", "1"});
  for (const char* name : {"left.mp4", "right.mp4"}) fs::remove(at("own/") + name);
  fs::copy_file(at("data/case/1/video.mp4"), at("own/stereo.mp4"));
  ASSERT_EQ(run({"reconstruct", at("own"), "--track", at("b/clips/case_1/000000/points.csv"),
                 "--out", at("run"), "--frames", ":16", "--quiet"})
                .exit_code,
            0);
  const std::string first_frames = textOf(at("run/tracks.csv"));
  EXPECT_GT(first_frames.size(), 1000U);
  EXPECT_THAT(textOf(at("b/clips/case_1/000000/run/tracks.csv")), StartsWith(first_frames));

  // Nothing is run again; truth that is broken excludes its video.
  const auto before = fs::last_write_time(at("b/clips/case_1/000050/run/run.json"));
  fs::copy(at("data/case/1"), at("data/case/2"));
  std::ofstream(at("data/case/2/gt_rectified_1.yaml")) << "- [true, false, null]\n";
  const auto again = benchmark("surgt", "data");
  EXPECT_EQ(fs::last_write_time(at("b/clips/case_1/000050/run/run.json")), before);
  EXPECT_EQ(again["excluded"][0]["clip"], "case_2");
  EXPECT_THAT(again["excluded"][0]["why"], HasSubstr("gt_rectified_1.yaml: frame 0"));
}

TEST_F(Benchmark, ScaredEqualsEvaluateOnOurOwnForm) {
  simulate("data/dataset_8/keyframe_1", {"--layout", "scared", "--seed", "3"});
  simulate("own", {"--frames", "1", "--seed", "3"});
  const auto json = benchmark("scared", "data");
  ASSERT_TRUE(json.is_object());
  ASSERT_EQ(json["pairs"].size(), 1u);
  EXPECT_EQ(json["pairs"][0]["group"], "dataset_8");
  EXPECT_EQ(json["dense"]["coverage_percent"], 100);
  EXPECT_GT(json["control"]["mae_mm"], json["dense"]["mae_mm"]);

  ASSERT_EQ(run({"depth", at("own"), "--out", at("d"), "--write", "depth", "--quiet"}).exit_code,
            0);
  const Outcome evaluated = run({"evaluate", at("d/000000_depth.pfm"), "--reference",
                                 at("own/groundtruth/depth/000000.png"), "--json"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto own = evaluated.json()["depth"];
  // Our own form's depth is rounded to 0.01 mm.
  EXPECT_NEAR(json["measured"]["mae_mm"].get<double>(), own["mae_mm"].get<double>(), 0.005) << own;
  EXPECT_NEAR(json["measured"]["coverage_percent"].get<double>(),
              own["depth_coverage_percent"].get<double>(), 1e-9);
}

TEST_F(Benchmark, ScaredKeyframesWithoutTruthAreExcludedAndDataSet5IsDoubted) {
  simulate("data/dataset_5/keyframe_1", {"--layout", "scared"});
  fs::create_directories(at("data/dataset_6"));
  fs::copy(at("data/dataset_5/keyframe_1"), at("data/dataset_6/keyframe_1"));
  fs::resize_file(at("data/dataset_6/keyframe_1/left_depth_map.tiff"), 2000);
  const auto json = benchmark("scared", "data", {"--jobs", "2"});
  EXPECT_EQ(json["excluded"][0]["clip"], "dataset_6_keyframe_1");
  EXPECT_THAT(json["excluded"][0]["why"], HasSubstr("left_depth_map.tiff"));
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("data sets 4 and 5"));
  fs::remove_all(at("data/dataset_5"));
  const Outcome none = run({"benchmark", "scared", at("data"), "--out", at("b"), "--quiet"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("none of 1 clips could be evaluated"));
  EXPECT_EQ(run({"benchmark", "scared", at("data"), "--out", at("b"), "--jobs", "0"}).exit_code, 2);
}

TEST_F(Benchmark, ServCtEqualsEvaluateOnOurOwnFormPairByPair) {
  simulate("data/Experiment_1", {"--layout", "servct", "--frames", "2"});
  simulate("own", {"--frames", "2", "--set", "truth_every=1"});
  const auto json = benchmark("servct", "data", {"--jobs", "2"});
  ASSERT_TRUE(json.is_object());
  ASSERT_EQ(json["pairs"].size(), 2u);
  EXPECT_EQ(json["pairs"][1]["pair"], "Experiment_1_002");
  ASSERT_EQ(run({"depth", at("own"), "--out", at("d"), "--write", "depth", "--quiet"}).exit_code,
            0);
  const Outcome evaluated = run({"evaluate", at("d/000001_depth.pfm"), "--reference",
                                 at("own/groundtruth/depth/000001.png"), "--json"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  // Steps of 1/256 and of 0.01 mm.
  EXPECT_NEAR(json["pairs"][1]["mae_mm"].get<double>(),
              evaluated.json()["depth"]["mae_mm"].get<double>(), 0.006);
  fs::remove(at("data/Experiment_1/Reference_CT/DepthL/001.png"));
  const auto again = benchmark("servct", "data");
  EXPECT_EQ(again["excluded"][0]["clip"], "Experiment_1_001");
}

TEST_F(Benchmark, StereoMisJudgesEachRangeOfTheSplit) {
  simulate("data/P1", {"--layout", "stereomis", "--frames", "7"});
  std::ofstream(at("data/P1/test_split.csv")) << "start,end\n0,3\n3,7\n";
  const auto json = benchmark("stereomis", "data");
  ASSERT_TRUE(json.is_object());
  ASSERT_EQ(json["ranges"].size(), 2u);
  EXPECT_EQ(json["ranges"][1]["clip"], "P1_000003");
  EXPECT_EQ(json["ranges"][1]["frames"], 4);
  EXPECT_EQ(json["coverage"], 1);
  EXPECT_LT(json["path"]["ate_rmse_mm"], json["control"]["ate_rmse_mm"]);

  // The first range in our own form: the same frames of the same film, judged by `evaluate`.
  simulate("own", {"--set", "pictures=mp4", "--frames", "7"});
  for (const char* name : {"left.mp4", "right.mp4"}) fs::remove(at("own/") + name);
  fs::copy_file(at("data/P1/video.mp4"), at("own/stereo.mp4"));
  ASSERT_EQ(
      run({"reconstruct", at("own"), "--frames", "0:3", "--out", at("run"), "--quiet"}).exit_code,
      0);
  const Outcome evaluated =
      run({"evaluate", at("run"), "--reference", at("own"), "--out", at("e"), "--json", "--quiet"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto camera = evaluated.json()["camera"];
  const auto& range = json["ranges"][0];  // poses on disk have 6 digits after the point
  EXPECT_NEAR(range["ate_rmse_mm"].get<double>(), camera["ate"]["rmse_mm"].get<double>(), 1e-5);
  EXPECT_NEAR(range["rpe_rmse_mm"].get<double>(), camera["rpe"]["rmse_mm"].get<double>(), 1e-5);

  std::ofstream(at("data/P1/test_split.csv")) << "start,end\n4,4\n";
  const Outcome none = run({"benchmark", "stereomis", at("data"), "--out", at("b2"), "--quiet"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("test_split.csv: line 2"));
}

TEST_F(Benchmark, C3vdJudgesThePathAndTheDepthOfHeldOutFrames) {
  const std::vector<std::string> rigid{"--frames", "11",
                                       "--set",    "breathing.amplitude_mm=0",
                                       "--set",    "heartbeat.amplitude_mm=0",
                                       "--set",    "push.amplitude_mm=0",
                                       "--set",    "camera.amplitude_mm=10"};
  std::vector<std::string> words = rigid;
  words.insert(words.end(), {"--layout", "c3vd"});
  simulate("data/cecum", words);
  const auto json = benchmark("c3vd", "data");
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["clips"][0], "cecum");
  EXPECT_EQ(json["held_out_frames"]["drawn"], 2);  // 1 and 9
  EXPECT_EQ(json["ranges"][0]["frames"], 9);
  EXPECT_EQ(json["coverage"], 1);
  EXPECT_LT(json["path"]["ate_rmse_mm"].get<double>(),
            json["control"]["ate_rmse_mm"].get<double>() / 3);
  // The model is that of exact depths; the control lacks the motion of one frame.
  EXPECT_LT(json["depth"]["median_mm"].get<double>(),
            json["depth_control"]["median_mm"].get<double>() / 3);
  EXPECT_GT(json["depth"]["coverage_percent"], 60);
  EXPECT_EQ(json["depth_dense"]["coverage_percent"], 100);

  // The same poses in the matrix order of other tools.
  const auto path = readC3vdPath(at("data/cecum/pose.txt"));
  std::ofstream by_rows(at("data/cecum/pose.txt"));
  for (const Eigen::Isometry3d& pose : path) {
    by_rows.precision(17);
    for (int i = 0; i < 16; ++i) by_rows << pose.matrix()(i / 4, i % 4) << (i < 15 ? ' ' : '\n');
  }
  by_rows.close();
  EXPECT_NEAR(benchmark("c3vd", "data")["path"]["ate_rmse_mm"].get<double>(),
              json["path"]["ate_rmse_mm"].get<double>(), 1e-9);

  // The same run, judged by `evaluate` with the truth of our own form.
  simulate("own", rigid);
  fs::copy(at("own/groundtruth"), at("data/cecum/groundtruth"), fs::copy_options::recursive);
  const Outcome evaluated = run({"evaluate", at("b/clips/cecum/run"), "--reference",
                                 at("data/cecum"), "--out", at("e"), "--json", "--quiet"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto camera = evaluated.json()["camera"];  // poses on disk have 6 digits after the point
  EXPECT_NEAR(json["path"]["ate_rmse_mm"].get<double>(), camera["ate"]["rmse_mm"].get<double>(),
              1e-5);

  fs::remove(at("data/cecum/0010_color.png"));
  const Outcome none = run({"benchmark", "c3vd", at("data"), "--out", at("b"), "--quiet"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("pose.txt: has 11 poses, but there are 10 images"));
}

TEST_F(Benchmark, StirFollowsTattoosToTheLastImage) {
  simulate("data/p1", {"--layout", "stir", "--frames", "6", "--size", "240x180", "--set",
                       "camera.amplitude_mm=10"});
  const auto json = benchmark("stir", "data");
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["clips"][0], "p1_left_seq01");
  EXPECT_EQ(json["excluded"].size(), 0u) << "the right view is no clip";
  EXPECT_GT(json["scores_2d"]["points"], 5);
  EXPECT_LT(json["scores_2d"]["median_px"], json["control_2d"]["median_px"]);
  EXPECT_LT(json["scores_2d"]["median_px"], 1.5);  // marks are bounded by whole pixels
  EXPECT_GT(json["coverage"], 0.8);
  // One pixel of disparity, the step of the truth, is 3 mm.
  EXPECT_EQ(json["without_3d"].size(), 0u);
  EXPECT_GT(json["scores_3d"]["points"], 5);
  EXPECT_LE(json["scores_3d"]["points"], json["scores_2d"]["points"]);
  EXPECT_LT(json["scores_3d"]["median_mm"], 3);
  EXPECT_GT(json["scores_3d"]["delta_avg"], json["control_3d"]["delta_avg"]);

  // The same film and points in our own form give the same paths.
  simulate("own", {"--set", "pictures=mp4", "--frames", "1", "--size", "240x180"});
  for (const char* side : {"left", "right"})
    for (const auto& film : fs::directory_iterator(at("data/p1/") + side + "/seq01/frames"))
      fs::copy_file(film.path(), at("own/") + side + ".mp4", fs::copy_options::overwrite_existing);
  const std::string home = at("b/clips/p1_left_seq01/");
  ASSERT_EQ(
      run({"reconstruct", at("own"), "--track", home + "points.csv", "--out", at("run"), "--quiet"})
          .exit_code,
      0);
  EXPECT_EQ(textOf(at("run/tracks.csv")), textOf(home + "run/tracks.csv"));

  // Without tattoos in the right image there is no 3-D score; the others remain.
  const fs::path right = at("data/p1/right/seq01/segmentation/icgendseg.png");
  fs::resize_file(right, 100);
  const auto damaged = benchmark("stir", "data");
  EXPECT_EQ(damaged["scores_2d"], json["scores_2d"]);
  EXPECT_FALSE(damaged.contains("scores_3d"));
  EXPECT_THAT(damaged["without_3d"][0]["why"], HasSubstr("icgendseg.png"));
  fs::remove(at("data/p1/left/seq01/0ms_icgstart.png"));
  EXPECT_THAT(benchmark("stir", "data")["without_3d"][0]["why"],
              HasSubstr("_icgstart.png: is miss"));
}

}  // namespace
}  // namespace softscope::test
