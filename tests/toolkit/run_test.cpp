// tests/toolkit/run_test.cpp: run folders: frames, held-out frames, depth files, resuming.
#include <gmock/gmock.h>

#include <algorithm>

#include "io/files/file_hash.h"
#include "io/files/file_lock.h"
#include "io/images/image_writer.h"
#include "support/in_folder.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/evaluation/evaluate_outputs.h"
#include "toolkit/evaluation/evaluate_run.h"
#include "toolkit/inspection/describe_path.h"
#include "toolkit/report/write_report.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

int linesOf(const fs::path& file) {
  const std::string bytes = textOf(file);
  return static_cast<int>(std::count(bytes.begin(), bytes.end(), '\n'));
}

class RunOfAClip : public InFolder {
 protected:
  std::string makeClip(int frames, const std::vector<std::string>& more = {}) const {
    simulateClip(at("clip"), frames, more);
    return at("clip");
  }
  ReconstructOptions options(const std::string& run = "run") const {
    return reconstruction(at("clip"), at(run));
  }
  /// Without depth.
  void paintBlack(const std::string& name) const {
    for (const char* side : {"left", "right"})
      writePng(fs::path(at("clip")) / side / name, ColourImage(160, 120), /*overwrite=*/true);
  }
  Json judged(const std::string& run = "run") const {
    EvaluateOptions options;
    options.run = at(run);
    options.reference = at("clip");
    return written(evaluateRun(options).record);
  }
};

TEST_F(RunOfAClip, HasTheFilesThatOthersRead) {
  const std::string clip = makeClip(5);
  ReconstructOptions tracked = options();
  tracked.save_every = 2;
  tracked.tracks = clip + "/track_points.csv";
  const Json done = written(reconstructSequence(tracked).record);
  EXPECT_EQ(done["frames_fused"], 5);
  EXPECT_LT(double(done["mean_backprojection_mm"]), 0.2);
  for (const char* name : {"model.ply", "models/000000.ply", "models/000002.ply",
                           "models/000004.vtp", "models.pvd", "run.json"})
    EXPECT_TRUE(fs::exists(at("run") + "/" + name)) << name;
  EXPECT_FALSE(fs::exists(at("run") + "/checkpoint.bin")) << "nothing is left to resume";
  EXPECT_EQ(linesOf(at("run/frames.csv")), 1 + 5);
  EXPECT_EQ(linesOf(at("run/trajectory.txt")), 1 + 5);
  EXPECT_EQ((linesOf(at("run/tracks.csv")) - 1) % 5, 0);
  EXPECT_THAT(textOf(at("run/model.ply")), HasSubstr("property float weight"));
  EXPECT_THAT(textOf(at("run/model.ply")), HasSubstr("property float sigma_mm"));
  const Json record = Json::parse(textOf(at("run/run.json")));
  EXPECT_EQ(done, record);
  EXPECT_EQ(record["inputs"]["calibration"]["path"], "calibration.yaml");
  EXPECT_EQ(record["inputs"]["calibration"]["sha256"], sha256Of(clip + "/calibration.yaml"));
  EXPECT_EQ(record["inputs"]["tracks"]["sha256"], sha256Of(tracked.tracks));
  EXPECT_EQ(record["configuration"]["stereo.disparity_max_px"], 63);
  const Json crate = Json::parse(textOf(at("run/ro-crate-metadata.json")));
  EXPECT_EQ(crate["@context"], "https://w3id.org/ro/crate/1.1/context");
  EXPECT_EQ(crate["@graph"][0]["conformsTo"]["@id"], "https://w3id.org/ro/crate/1.1");
  for (const auto& part : crate["@graph"][1]["hasPart"])
    EXPECT_TRUE(fs::exists(at("run/") + std::string(part["@id"]))) << part;
  EXPECT_EQ(crate["@graph"][1]["hasPart"].size(), 10u);
  EXPECT_THAT(crate.dump(), HasSubstr(std::string(record["inputs"]["calibration"]["sha256"])));
  EXPECT_THAT(crate.dump(), Not(HasSubstr(folder.string()))) << "no path of this machine";
}

TEST_F(RunOfAClip, SaysWhetherTheScopeMoved) {
  makeClip(4);
  ReconstructOptions stated = options();
  set({"pose.scope=static"}, &stated.settings);
  Told told;
  EXPECT_EQ(reconstructSequence(stated, told.listener()).record["frames_scope_static"], 3)
      << "of the three after the first";
  EXPECT_THAT(told.warnings, Contains(HasSubstr("no motion of the scope was detected")));
  ReconstructOptions moving = options("moving");
  set({"pose.scope=moving"}, &moving.settings);
  Told nothing;
  const ReconstructedRun run = reconstructSequence(moving, nothing.listener());
  EXPECT_THAT(run.facts.text(), HasSubstr("static in 0 of 3 frames"));
  EXPECT_THAT(nothing.warnings, Not(Contains(HasSubstr("no motion of the scope"))));
}

TEST_F(RunOfAClip, SaysWhichFramesHaveNoPoseOfTheirOwn) {
  makeClip(4);
  ReconstructOptions few = options();
  set({"pose.threshold_mm=1e-6"}, &few.settings);  // no inliers
  Told told;
  const ReconstructedRun run = reconstructSequence(few, told.listener());
  EXPECT_THAT(run.facts.text(), HasSubstr("4 of 4 fused"));
  EXPECT_THAT(told.warnings, Contains(HasSubstr("3 of 4 frames were fused at the last pose")));
  EXPECT_THAT(told.warnings, Not(Contains(HasSubstr("no motion of the scope"))));
}

TEST_F(RunOfAClip, SaysThatTheFirstImageCouldNotBeUsed) {
  makeClip(4);
  paintBlack("000000.png");
  Told told;
  const Json record = written(reconstructSequence(options(), told.listener()).record);
  EXPECT_EQ(record["frames_fused"], 3);
  EXPECT_THAT(told.warnings,
              Contains(HasSubstr("the model begins at frame 1, as 1 before it could not be used")));
}

TEST_F(RunOfAClip, NamesNoFileWhereNoFrameCouldBeUsed) {
  makeClip(3);
  for (const char* name : {"000000.png", "000001.png", "000002.png"}) paintBlack(name);
  Told told;
  expectError<InputError>([&] { reconstructSequence(options(), told.listener()); },
                          {"no run folder was written", "the warnings name"});
  EXPECT_THAT(told.warnings, Contains(HasSubstr("frame 0: skipped_depth: depth on 0 %")));
  EXPECT_THAT(told.warnings, Contains(HasSubstr("2 more frames, 1 to 2; the last: skipped_depth")));
  EXPECT_THAT(told.warnings, Not(Contains(HasSubstr("frames.csv"))));
  Told stopped;
  WorkListener listener = stopped.listener();
  listener.progress = [](int done, int /*total*/) { return done < 1; };
  EXPECT_THAT(reconstructSequence(options(), listener).facts.text(), Not(HasSubstr("written to")));
  EXPECT_THAT(stopped.warnings, Contains(HasSubstr("nothing is written")));
  EXPECT_THAT(stopped.warnings, Not(Contains(HasSubstr("frames.csv"))));
}

TEST_F(RunOfAClip, SaysWhatWasNotFused) {
  makeClip(4);
  ReconstructOptions doubted = options();
  set({"gate.min_confidence=1"}, &doubted.settings);
  doubted.thresholds = limits({"skipped>10%"});
  Told told;
  const ReconstructedRun run = reconstructSequence(doubted, told.listener());
  const Json record = written(run.record);
  EXPECT_EQ(record["frames_by_status"]["unconfirmed"], 3);
  EXPECT_THAT(std::string(record["warnings"].back()),
              HasSubstr("3 of 4 frames were not fused (1 started, 3 unconfirmed)"));
  EXPECT_EQ(record["outcomes"]["skipped"], 3);
  EXPECT_THAT(told.warnings, Contains(HasSubstr("frame 1: unconfirmed: ")));
  EXPECT_THAT(told.warnings, Not(Contains(HasSubstr("frame 2: ")))) << "one line per kind";
  EXPECT_THAT(told.warnings,
              Contains(HasSubstr("unconfirmed: 2 more frames, 2 to 3; reasons: frames.csv")));
  EXPECT_TRUE(run.outcomes.at(0).failed);
  EXPECT_EQ(run.outcomes.at(0).path, "outcomes.skipped_share");
  EXPECT_EQ(run.outcomes.at(0).value, 0.75);
  EXPECT_THAT(run.facts.text(), HasSubstr("1 of 4 fused, 3 skipped, 0 lost"));
  EXPECT_TRUE(fs::exists(at("run/run.json"))) << "the run stays";
  ReconstructOptions misspelt = options("other");
  misspelt.thresholds = limits({"lsot>10%"});
  expectError<OptionError>([&] { reconstructSequence(misspelt); }, {"lost"});
}

TEST_F(RunOfAClip, SaysWhereDepthIsTooInaccurateForConfidence) {
  makeClip(3, {"camera.distance_mm=85"});
  Told told;
  const Json record = written(reconstructSequence(options(), told.listener()).record);
  EXPECT_EQ(record["frames_doubtful"], 3);
  EXPECT_THAT(told.warnings,
              Contains(AllOf(HasSubstr("in 3 of 3 frames, less than half of the depth is accurate"),
                             HasSubstr("a wrong calibration"))));
  EXPECT_THAT(told.warnings, Not(Contains(HasSubstr("does not fit the image"))));
}

TEST_F(RunOfAClip, EveryStepthFrameKeepsItsNumberAndItsName) {
  const std::string clip = makeClip(7);
  for (const char* side : {"/left", "/right"})
    for (int f = 0; f < 7; ++f)
      fs::rename(clip + side + "/00000" + std::to_string(f) + ".png",
                 clip + side + "/img_00012" + std::to_string(f) + ".png");
  ReconstructOptions stepped = options();
  stepped.settings.sequence.frames = parseFrameRange("1:7:2");
  stepped.save_every = 2;
  EXPECT_EQ(reconstructSequence(stepped).record["frames"], 3);
  EXPECT_EQ(textOf(at("run/images.csv")),
            "frame,number,left,right\n"
            "1,121,\"img_000121.png\",\"img_000121.png\"\n"
            "3,123,\"img_000123.png\",\"img_000123.png\"\n"
            "5,125,\"img_000125.png\",\"img_000125.png\"\n");
  EXPECT_TRUE(fs::exists(at("run/models/000001.ply")));
  EXPECT_FALSE(fs::exists(at("run/models/000003.ply"))) << "every second of those asked for";
  EXPECT_TRUE(fs::exists(at("run/models/000005.ply")));
  EXPECT_THAT(textOf(at("run/trajectory.txt")), HasSubstr("\n0.120000 ")) << "frame 3, not 1";
  EXPECT_EQ(linesOf(at("run/trajectory_kitti.txt")), 3) << "a line per pose, no heading";
  EXPECT_EQ(textOf(at("run/trajectory_kitti.txt")).rfind("1 0 0 0 0 1 0 0 0 0 1 0\n", 0), 0u);
  const Json errors = judged();
  EXPECT_EQ(errors["outcomes"]["frames"], 3);
  EXPECT_EQ(errors["surface"]["worst_frame"], 5);
  EXPECT_LT(double(errors["surface"]["mean_mm"]), 0.5)
      << "judged by the truth of frame 5: the organ breathes";
  EXPECT_THROW(parseFrameRange("1:7:0"), OptionError);
}

TEST_F(RunOfAClip, HeldOutFramesAreNotSeenAndAreComparedWithTheModelBeforeThem) {
  makeClip(10);
  const auto holdingOut = [&](const std::string& run, int every) {
    ReconstructOptions split = options(run);
    split.settings.sequence.frames.hold_out_every = every;
    split.save_every = 0;
    return split;
  };
  const Json done = written(reconstructSequence(holdingOut("run", 4)).record);
  EXPECT_EQ(done["frames"], 7);
  EXPECT_EQ(done["hold_out_every"], 4);
  const std::string frames = textOf(at("run/frames.csv"));
  for (const char* number : {"\n0,", "\n4,", "\n6,", "\n8,"})
    EXPECT_THAT(frames, HasSubstr(number));
  for (const char* number : {"\n1,", "\n5,", "\n9,"}) EXPECT_THAT(frames, Not(HasSubstr(number)));
  for (const char* model :
       {"run/models/000000.ply", "run/models/000004.ply", "run/models/000008.ply"})
    EXPECT_TRUE(fs::exists(at(model))) << model;

  // The same with truth and without.
  const Json held_out = judged()["held_out"];
  EXPECT_EQ(held_out["every"], 4);
  ASSERT_EQ(held_out["views"], 3);
  EXPECT_EQ(held_out["frames"][1]["frame"], 5);
  EXPECT_EQ(held_out["frames"][2]["frame"], 9) << "the last of the clip";
  EXPECT_GT(held_out["psnr_db"], 25);
  EXPECT_GT(held_out["psnr_over_all_pixels_db"], held_out["psnr_db"]);
  EXPECT_TRUE(held_out["control"]["psnr_db"].is_number());
  EXPECT_EQ(held_out["control"]["judged_share"], held_out["judged_share"]) << "the same pixels";
  EXPECT_THAT(std::string(held_out["pixels"]), HasSubstr("masks"));
  fs::remove_all(at("clip/groundtruth"));
  EvaluateOptions evaluate;
  evaluate.run = at("run");
  evaluate.reference = at("clip");
  evaluate.thresholds = limits({"held_out.psnr_db<5"});
  const RunEvaluation truthless = evaluateRun(evaluate);
  EXPECT_FALSE(truthless.outcomes.at(0).failed);
  EXPECT_EQ(written(truthless.record)["held_out"]["frames"], held_out["frames"]);
  EvaluateOutputs(at("error"), false).write(truthless);
  ReportOptions report;
  report.cases = {at("error")};
  report.html = at("page.html");
  writeReport(report);
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("that the run did not use, over 3 frames"));

  // A range may begin at such a frame, and a run that was stopped goes on with the same split.
  const auto ofFrames = [&](const std::string& run, const std::string& frames) {
    ReconstructOptions split = holdingOut(run, 4);
    split.settings.sequence.frames = parseFrameRange(frames);
    split.settings.sequence.frames.hold_out_every = 4;
    return split;
  };
  EXPECT_EQ(reconstructSequence(ofFrames("later", "5:9")).record["frames"], 3);
  expectError<OptionError>([&] { reconstructSequence(ofFrames("no", "::2")); }, {});
  expectError<OptionError>([&] { reconstructSequence(ofFrames("no", "5:6")); },
                           {});  // none is left
  expectError<OptionError>([&] { reconstructSequence(holdingOut("no", 1)); }, {});
}

TEST_F(RunOfAClip, AnUnreadableFrameKeepsItsTime) {
  const std::string clip = makeClip(4);
  fs::resize_file(clip + "/left/000002.png", 200);
  reconstructSequence(options());
  EXPECT_THAT(textOf(at("run/trajectory.txt")), HasSubstr("\n0.080000 ")) << "not 2 seconds";
  EXPECT_EQ(judged()["outcomes"]["skipped"], 1);
}

TEST_F(RunOfAClip, ResumesToTheSameBytes) {
  makeClip(8);
  reconstructSequence(options("whole"));
  ReconstructOptions stopped = options("stopped");
  stopped.checkpoint_every = 1;
  WorkListener stop;
  stop.progress = [](int done, int) { return done < 3; };
  const ReconstructedRun part = reconstructSequence(stopped, stop);
  EXPECT_TRUE(part.interrupted);
  EXPECT_EQ(linesOf(at("stopped/frames.csv")), 1 + 3);
  EXPECT_TRUE(Json::parse(textOf(at("stopped/run.json")))["interrupted"]);
  stopped.resume = true;
  ReconstructOptions other = stopped;
  set({"graph.node_spacing_mm=5"}, &other.settings);
  expectError<OptionError>([&] { reconstructSequence(other); }, {"other settings"});
  EXPECT_FALSE(reconstructSequence(stopped).interrupted);
  for (const char* name : {"model.ply", "trajectory.txt", "models/000000.ply", "models.pvd"})
    EXPECT_TRUE(textOf(at(std::string("stopped/") + name)) ==
                textOf(at(std::string("whole/") + name)))
        << name;
  EXPECT_EQ(linesOf(at("stopped/frames.csv")), 1 + 8);
}

// A clip whose right video was cut a picture later: moment f is right picture f - 1.
TEST_F(RunOfAClip, PairsTheViewsOfOneMoment) {
  makeClip(9);
  fs::remove(at("clip/timestamps.txt"));
  for (int f = 0; f < 9; ++f) {
    const std::string name = "/00000" + std::to_string(f) + ".png";
    if (f > 0)
      fs::rename(at("clip") + "/right" + name,
                 at("clip") + "/right/00000" + std::to_string(f - 1) + ".png");
    if (f == 8) fs::remove(at("clip") + "/left" + name);
  }
  Told told;
  const Json done = written(reconstructSequence(options(), told.listener()).record);
  EXPECT_THAT(told.warnings, Contains(HasSubstr("right image f -1 belongs to left image f")));
  EXPECT_EQ(done["configuration"]["sequence.right_offset"], "-1");
  EXPECT_EQ(done["frames_fused"], 7);
  EXPECT_EQ(done["frames_by_status"]["unpaired"], 1) << "nothing is wrong with its files";
  EXPECT_LT(double(done["mean_backprojection_mm"]), 0.2);
  const Json described = written(describePath(at("clip")).json());
  EXPECT_EQ(described["right_offset"], -1) << "the same for every command";
  EXPECT_THAT(described["warnings"].dump(), HasSubstr("belongs to left image f"));
  MeasureOptions depth = measurement(at("clip"), at("depth"));
  depth.settings.sequence.frames = parseFrameRange("0:2");
  set({"stereo.disparity_max_px=63"}, &depth.settings);
  const Json measured = written(measureSequence(depth).record);
  EXPECT_EQ(measured["options"]["sequence.right_offset"], "-1");
  EXPECT_EQ(measured["frames_done"], 1) << "frame 0 has no partner";
  ReconstructOptions as_is = options("as_is");
  set({"sequence.right_offset=0"}, &as_is.settings);
  // Fusion follows wrong depth too; the model that was warped only knows better.
  EXPECT_GT(double(reconstructSequence(as_is).record["mean_prediction_mm"]),
            1.2 * double(done["mean_prediction_mm"]));
}

TEST_F(RunOfAClip, KnowsTheRollThatAllFramesHaveInCommon) {
  makeClip(12, {"scope.roll_error_deg=0.4"});
  const Json rows = written(reconstructSequence(options()).record)["rows"];
  const double roll = -double(rows["per_column"]) * 180 / M_PI;
  EXPECT_LT(roll, 0.42);
  EXPECT_GT(roll, 0.3) << "matches of a small image are drawn to whole rows";
  EXPECT_NEAR(double(rows["centre_px"]), 0, 0.1);
  EXPECT_NEAR(double(rows["per_row"]), 0, 0.001);
}

// Depth and colour of one camera, then depth alone: no word of stereo, and the model is as good.
TEST_F(RunOfAClip, TakesDepthWithColourAndDepthAlone) {
  makeClip(6, {"input_depth=true"});
  const Json rig = written(describePath(at("clip")).json())["calibration"]["left"];
  fs::remove_all(at("clip/right"));
  write("clip/calibration.yaml", "fx: " + rig["fx_px"].dump() + "\ncx: " + rig["cx_px"].dump() +
                                     "\ncy: " + rig["cy_px"].dump() + "\ndepth_unit_mm: 0.01\n");
  for (const bool colour : {true, false}) {
    if (!colour) fs::remove_all(at("clip/left"));
    const FactSheet described = describePath(at("clip"));
    EXPECT_FALSE(described.hasProblems()) << described.text();
    EXPECT_THAT(described.text(), Not(HasSubstr("baseline")));
    const std::string name = colour ? "colour" : "depth";
    const Json done = written(reconstructSequence(options(name)).record);
    EXPECT_EQ(done["frames_fused"], 6);
    EXPECT_TRUE(done["rectified_rig"]["baseline_mm"].is_null());
    EXPECT_LT(double(judged(name)["surface"]["mean_mm"]), 0.2) << "0.01 mm is a step of the files";
    MeasureOptions maps = measurement(at("clip"), at(name + "_maps"));
    maps.kinds = DepthOutputKinds::parse("depth");
    const std::string told = measureSequence(maps).facts.text();
    EXPECT_THAT(told, HasSubstr("depth of 6 frames from depth files"));
    EXPECT_THAT(told, Not(HasSubstr("pair")));
  }
}

TEST_F(RunOfAClip, IsNeverOverwrittenUnasked) {
  makeClip(2);
  reconstructSequence(options());
  const std::string before = textOf(at("run/model.ply"));
  expectError<OptionError>([&] { reconstructSequence(options()); }, {"`overwrite=`"});
  EXPECT_EQ(textOf(at("run/model.ply")), before);
  ReconstructOptions over = options();
  over.overwrite = true;
  over.settings.sequence.frames = parseFrameRange("0:1");
  reconstructSequence(over);
  EXPECT_EQ(linesOf(at("run/frames.csv")), 2);
  EXPECT_FALSE(fs::exists(at("run/writing.lock"))) << "the run has ended";
  const FileLock other(at("run/writing.lock"));
  ASSERT_TRUE(other.tryToHold());
  expectError<OptionError>([&] { reconstructSequence(over); },
                           {"another softscope reconstruct is writing to it"});
  EXPECT_EQ(linesOf(at("run/frames.csv")), 2) << "nothing was touched";
}

TEST_F(RunOfAClip, TellsBackEndAndTimeOfAFrame) {
  makeClip(2);
  ReconstructOptions timed = options();
  timed.backend = "cpu";
  timed.thresholds = limits({"frame_ms.p95>1000000"});
  const ReconstructedRun run = reconstructSequence(timed);
  const Json json = written(run.record);
  EXPECT_EQ(json["machine"]["backend"], "cpu");
  const Json& ms = json["frame_ms"];
  EXPECT_GT(ms["p50"].get<double>(), 0);
  EXPECT_LE(ms["p50"].get<double>(), ms["p95"].get<double>());
  EXPECT_LE(ms["p99"].get<double>(), ms["slowest"].get<double>());
  EXPECT_FALSE(run.outcomes.at(0).failed);
}

}  // namespace
}  // namespace softscope::test
