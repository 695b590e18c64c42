// tests/toolkit/simulation_test.cpp: sequence folders with their truth, read, run and judged.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "core/parallel.h"
#include "eval/simulation/tissue/organ_mesh.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "support/in_folder.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/evaluation/evaluate_run.h"
#include "toolkit/export/export_files.h"
#include "toolkit/inspection/describe_path.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

/// Frames of 64 x 48 of a coarse organ: a tenth of a second in all.
class SimulatedFolder : public InFolder {
 protected:
  static SimulateOptions options(const std::vector<std::string>& more = {}) {
    SimulateOptions options;
    set({"frames=3", "truth_every=2", "scope.width_px=64", "scope.height_px=48",
         "organ.cells_per_side=10"},
        &options);
    set(more, &options);
    return options;
  }
  SimulatedSequence simulate(const std::string& name, const SimulateOptions& options,
                             const TruthKinds& truth = {}) const {
    return simulateSequence(options, truth, at(name), /*overwrite=*/false);
  }
  SimulatedSequence simulate(const std::string& name,
                             const std::vector<std::string>& more = {}) const {
    return simulate(name, options(more));
  }
  /// Expects an error of that type, and no folder.
  template <class Expected>
  void expectRefused(const std::vector<std::string>& parts, const SimulateOptions& wrong) const {
    expectError<Expected>([&] { simulate("refused", wrong); }, parts);
    EXPECT_FALSE(fs::exists(at("refused")));
  }

  /// Every file's bytes by its path in the folder.
  std::map<std::string, std::string> contentOf(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(at(name)))
      if (!entry.is_directory())
        files[fs::relative(entry.path(), at(name)).string()] = textOf(entry.path());
    return files;
  }

  /// The clip's run, every model of which is saved, against its truth.
  Json reconstructedAndJudged(const std::string& name) const {
    const std::string run = at(name + "_run");
    ReconstructOptions reconstruct = reconstruction(at(name), run);
    reconstruct.save_every = 1;
    reconstructSequence(reconstruct);
    EvaluateOptions evaluate;
    evaluate.run = run;
    evaluate.reference = at(name);
    return written(evaluateRun(evaluate).record);
  }
};

TEST_F(SimulatedFolder, WritesASequenceFolderWithItsTruth) {
  EXPECT_EQ(simulate("s").frames, 3);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : contentOf("s")) {
    names.push_back(name);
    EXPECT_FALSE(bytes.empty()) << name;
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre(
                         "left/000000.png", "left/000001.png", "left/000002.png",
                         "right/000000.png", "right/000001.png", "right/000002.png",
                         "calibration.yaml", "timestamps.txt", "track_points.csv",
                         "simulation.json", "groundtruth/trajectory.txt", "groundtruth/tracks.csv",
                         "groundtruth/mesh/000000.ply", "groundtruth/mesh/000002.ply",
                         "groundtruth/depth/000000.png", "groundtruth/depth/000002.png"));

  const Json info = written(describePath(at("s")).json());  // a reader finds nothing wrong
  EXPECT_EQ(info["kind"], "sequence");
  EXPECT_EQ(info["frames"], 3);
  EXPECT_EQ(info["width_px"], 64);
  EXPECT_TRUE(info["problems"].empty()) << info["problems"];
}

TEST_F(SimulatedFolder, OneThreadGivesTheSameBytes) {
  {
    const ThreadLimit limit(1);
    simulate("one");
  }
  {
    const ThreadLimit limit(2);
    simulate("two");
  }
  const auto one = contentOf("one"), two = contentOf("two");
  ASSERT_EQ(one.size(), 16u);
  for (const auto& [name, bytes] : one) EXPECT_TRUE(two.at(name) == bytes) << name;
}

TEST_F(SimulatedFolder, AnotherSeedGivesOtherPictures) {
  simulate("one", {"seed=1"});
  simulate("two", {"seed=2"});
  EXPECT_FALSE(contentOf("one").at("left/000000.png") == contentOf("two").at("left/000000.png"));
}

TEST_F(SimulatedFolder, OnlyTheTruthThatIsAskedForIsWritten) {
  simulate("s", options(), TruthKinds::parse("tracks"));
  EXPECT_TRUE(fs::exists(at("s/groundtruth/tracks.csv")));
  EXPECT_EQ(countFiles(at("s/groundtruth")), 1);
  simulate("none", options(), TruthKinds::parse("none"));
  EXPECT_FALSE(fs::exists(at("none/groundtruth")));
}

TEST_F(SimulatedFolder, MasksDepthNormalsAndFlowAreWrittenWhereTheyAreAskedFor) {
  simulate("s", options({"instrument.radius_mm=4", "input_depth=true", "pictures=jpg"}),
           TruthKinds::parse("depth,normals,flow"));
  const auto files = contentOf("s");
  for (const char* name :
       {"mask/000001.png", "depth/000001.png", "left/000001.jpg", "groundtruth/depth/000002.png"})
    EXPECT_EQ(files.count(name), 1u) << name;
  EXPECT_EQ(files.at("groundtruth/normals/000002.pfm").size(), 3u + 6 + 5 + 64 * 48 * 12);
  EXPECT_EQ(files.at("groundtruth/flow/000002.flo").size(), 12u + 64 * 48 * 8);
  EXPECT_EQ(files.at("depth/000002.png"), files.at("groundtruth/depth/000002.png"));
  simulate("bare", {"instrument.radius_mm=4", "masks=false"});
  EXPECT_FALSE(fs::exists(at("bare/mask")));
}

TEST_F(SimulatedFolder, VideosAreReconstructedAndJudgedAsPicturesAre) {
  std::map<std::string, Json> view;
  for (const std::string kind : {"png", "mp4"}) {
    simulate(kind,
             {"scope.width_px=160", "scope.height_px=120", "truth_every=1", "pictures=" + kind});
    view[kind] = reconstructedAndJudged(kind)["view"];
  }
  EXPECT_TRUE(fs::exists(at("mp4/left.mp4")));
  EXPECT_FALSE(fs::exists(at("mp4/left")));
  // Compression takes noise away, from the judged picture and from the model: a video may look
  // better by what the noise was (about 4 dB here), and hardly worse. A wrong frame costs 10 dB.
  const double gain_db =
      static_cast<double>(view["mp4"]["psnr_db"]) - static_cast<double>(view["png"]["psnr_db"]);
  EXPECT_GT(gain_db, -3);
  EXPECT_LT(gain_db, 6);
  EXPECT_GT(view["mp4"]["ssim"], 0.5);
}

// Raw pictures and their calibration carry the same truth as rectified ones. Half a pixel of wrong
// rectification would add 0.5 mm here; resampling adds noise, hence a quarter.
TEST_F(SimulatedFolder, PicturesOfABentLensAreReconstructedAsWell) {
  std::map<std::string, Json> judged;
  for (const std::string lens : {"straight", "bent"}) {
    std::vector<std::string> more{"scope.width_px=240", "scope.height_px=180", "truth_every=1"};
    if (lens == "bent") more.insert(more.end(), {"scope.k1=-0.3", "scope.k2=0.1"});
    simulate(lens, more);
    judged[lens] = reconstructedAndJudged(lens);
  }
  const auto mean = [&](const char* lens, const char* what) {
    return judged[lens][what]["mean_mm"].get<double>();
  };
  EXPECT_LT(mean("bent", "surface"), 1.25 * mean("straight", "surface"));
  EXPECT_LT(mean("bent", "depth"), 1.25 * mean("straight", "depth"));
  EXPECT_THAT(textOf(at("bent/calibration.yaml")), HasSubstr("rectified: 0"));
  expectRefused<OptionError>({"input_depth"}, options({"scope.k1=-0.1", "input_depth=true"}));
  expectRefused<OptionError>({"scope.k1"}, options({"scope.k1=-0.4"}));
}

TEST_F(SimulatedFolder, APhotographIsLaidOnTheTissue) {
  ColourImage blue(64, 48, Rgb8{20, 40, 220});
  writePng(at("blue.png"), blue, false);
  SimulateOptions textured = options();
  textured.texture = at("blue.png");
  simulate("s", textured);
  const Rgb8 seen = readColourImage(at("s/left/000000.png")).at(32, 24);
  EXPECT_GT(seen.blue, 2 * seen.red);
  const Json record = Json::parse(textOf(at("s/simulation.json")));
  EXPECT_EQ(record["options"]["texture.picture"], at("blue.png"));
  simulate("t", {"texture.picture=" + at("blue.png"), "texture.picture_mm=50"});
  EXPECT_EQ(contentOf("s/left"), contentOf("t/left"));
}

TEST_F(SimulatedFolder, APictureThatIsNoTextureIsOneLine) {
  writePng(at("tiny.png"), ColourImage(5, 4), false);
  writePng(at("good.png"), ColourImage(64, 64), false);
  for (const std::string& name : {at("absent.png"), at("tiny.png"), write("torn.png", "\x89PNG")}) {
    SimulateOptions wrong = options();
    wrong.texture = name;
    expectRefused<InputError>({name}, wrong);
  }
  SimulateOptions wide = options({"texture.picture_mm=900"});
  wide.texture = at("good.png");
  expectRefused<OptionError>({"texture.picture_mm"}, wide);
}

TEST_F(SimulatedFolder, EveryKindOfMeshFileGivesTheSameSequence) {
  const TriangleMesh organ = makeOrganMesh({60, 10, 3, 1.4}, 1);
  ModelSurface surface;
  surface.vertices.points_mm = organ.vertices_mm;
  surface.triangles = organ.triangles;
  std::map<std::string, std::string> depth;
  for (const std::string kind : {".stl", ".ply", ".obj", ".vtp"}) {
    write("organ" + kind,
          modelBytes(surface, formatOf("organ" + kind), unitOf("mm", formatOf("organ" + kind))));
    SimulateOptions given = options();
    given.organ = at("organ" + kind);
    simulate(kind, given);
    depth[kind] = contentOf(kind).at("groundtruth/depth/000000.png");
    EXPECT_EQ(depth[kind], depth[".stl"]) << kind;
  }
}

/// Every number of a record is one; JSON has no other way to say NaN than null.
void expectNumbers(const Json& json, const std::string& name) {
  EXPECT_FALSE(json.is_null()) << name;
  if (json.is_object())
    for (const auto& [key, value] : json.items()) expectNumbers(value, name + "." + key);
}

TEST_F(SimulatedFolder, ACutIsReconstructedAndJudged) {
  simulate("s", {"truth_every=1", "organ.cells_per_side=30", "cut.length_mm=15", "cut.start_s=0.04",
                 "cut.duration_s=0.04", "scope.width_px=160", "scope.height_px=120"});
  const MeshCheck before = checkMesh(readMesh(at("s/groundtruth/mesh/000000.ply"))),
                  after = checkMesh(readMesh(at("s/groundtruth/mesh/000002.ply")));
  EXPECT_THAT(meshWarnings(before), testing::IsEmpty());
  EXPECT_THAT(meshWarnings(after), testing::IsEmpty());
  EXPECT_EQ(before.triangle_count, after.triangle_count);
  EXPECT_LT(after.volume_mm3, before.volume_mm3 - 50) << "the wound is open";
  const Json judged = reconstructedAndJudged("s");
  expectNumbers(judged["surface"], "surface");
  EXPECT_LT(judged["surface"]["mean_mm"], 1.0);  // at 160 px a disparity of 0.2 px is 0.6 mm
}

TEST_F(SimulatedFolder, ACutThatDoesNotFitIsOneLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> lines{
      {{"cut.length_mm=15", "cut.x_mm=80"}, "misses the organ"},
      {{"cut.length_mm=150"}, "turns away"},
      {{"cut.length_mm=15", "cut.depth_mm=60"}, "thick"},
      {{"cut.length_mm=15", "cut.opening_mm=9"}, "cut.opening_mm"},
      {{"cut.lenght_mm=15"}, "cut.length_mm"},
      {{"cut.length_mm=long"}, "number"}};
  for (const auto& [settings, expected] : lines)
    expectError<OptionError>([&, more = settings] { simulate("s", more); }, {expected});
  EXPECT_FALSE(fs::exists(at("s")));
}

TEST_F(SimulatedFolder, AFlawedOrganIsRepairedOrRefusedAndSaysWhy) {
  const TriangleMesh organ = makeOrganMesh({60, 10, 3, 1.4}, 1);
  const auto asPly = [&](const std::string& name, std::vector<Triangle> triangles) {
    ModelSurface surface;
    surface.vertices.points_mm = organ.vertices_mm;
    surface.triangles = std::move(triangles);
    return write(name, modelBytes(surface, ModelFormat::kPly, unitOf("mm", ModelFormat::kPly)));
  };
  std::vector<Triangle> flawed(organ.triangles.begin() + 1, organ.triangles.end());
  for (const int i : {40, 90}) std::swap(flawed[i][0], flawed[i][1]);
  SimulateOptions given = options();
  given.organ = asPly("flawed.ply", flawed);
  Told told;
  simulateSequence(given, {}, at("s"), false, told.listener());
  EXPECT_THAT(told.warnings, Contains(HasSubstr("flawed.ply: turned 2 triangles")));
  EXPECT_THAT(told.warnings, Contains(HasSubstr("flawed.ply: closed 1 holes of 3 edges")));
  EXPECT_THAT(meshWarnings(checkMesh(readMesh(at("s/groundtruth/mesh/000000.ply")))),
              testing::IsEmpty());
  std::vector<Triangle> crowded = organ.triangles;
  crowded.push_back({organ.triangles[5][0], organ.triangles[5][1], organ.triangles[300][0]});
  given.organ = asPly("crowded.ply", crowded);
  expectRefused<InputError>({"edges belong to more than two triangles"}, given);
}

TEST_F(SimulatedFolder, NothingIsOverwrittenUnlessAskedTo) {
  simulate("s");
  const auto before = contentOf("s");
  const SimulateOptions other = options({"frames=1", "seed=2"});
  expectError<OptionError>([&] { simulate("s", other); }, {"`overwrite=`"});
  EXPECT_TRUE(contentOf("s") == before);
  simulateSequence(other, {}, at("s"), /*overwrite=*/true);
  EXPECT_FALSE(fs::exists(at("s/left/000001.png"))) << "a frame of the earlier simulation stayed";
}

TEST_F(SimulatedFolder, AnotherOneInItsPlaceHasNoMaskOfTheEarlier) {
  simulateSequence(options({"frames=2", "instrument.radius_mm=2"}), {}, at("s"), false);
  ASSERT_TRUE(fs::exists(at("s/mask/000001.png")));
  simulateSequence(options({"frames=1"}), {}, at("s"), /*overwrite=*/true);
  EXPECT_FALSE(fs::exists(at("s/mask"))) << "a folder without masks is one of too few";
}

TEST_F(SimulatedFolder, AFolderThatIsNoSimulationIsLeftAlone) {
  write("mine/left/000000.png", "a photograph");
  expectError<OptionError>([&] { simulateSequence(options(), {}, at("mine"), true); },
                           {at("mine")});
  EXPECT_EQ(countFiles(at("mine")), 1);
}

TEST_F(SimulatedFolder, AFileIsNoFolder) {
  write("file", "bytes");
  expectError<OptionError>([&] { simulate("file"); }, {at("file")});
}

TEST_F(SimulatedFolder, MisspeltKeysGetTheNearestName) {
  expectError<OptionError>([] { options({"organ.lenght_mm=50"}); }, {"organ.length_mm"});
  expectError<OptionError>([] { options({"scope.baselin=4"}); }, {"baseline_mm"});
  expectError<OptionError>([] { TruthKinds::parse("msh"); }, {"mesh"});
}

TEST_F(SimulatedFolder, WhatCannotBeSimulatedIsRefused) {
  ScopeOptions scope;
  expectError<OptionError>([&] { setPictureSize("640", scope); }, {"640"});
  for (const char* setting : {"scope.width_px=9", "frames=0", "scope.baseline_mm=0",
                              "camera.path=zigzag", "pictures=gif"})
    expectError<OptionError>([&] { simulate("refused", {setting}); }, {});
  EXPECT_FALSE(fs::exists(at("refused")));
  for (const std::string& file : {at("absent.stl"), write("o.stl", "no mesh")}) {
    SimulateOptions wrong = options();
    wrong.organ = file;
    expectRefused<InputError>({file}, wrong);
  }
}

}  // namespace
}  // namespace softscope::test
