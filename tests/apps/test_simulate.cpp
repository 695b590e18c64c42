// tests/apps/test_simulate.cpp: `softscope simulate` from a scenario to a sequence folder.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "eval/simulation/tissue/organ_mesh.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "tests/apps/run_softscope.h"
#include "toolkit/export/export_files.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Frames of 64 x 48 of a coarse organ: a tenth of a second in all.
class Simulate : public InFolder {
 protected:
  Outcome simulate(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> line{"simulate", "--out", out};
    for (const char* setting : {"frames=3", "truth_every=2", "scope.width_px=64",
                                "scope.height_px=48", "organ.cells_per_side=10"})
      line.insert(line.end(), {"--set", setting});
    line.insert(line.end(), more.begin(), more.end());
    return run(line);
  }

  /// Every file's bytes by its path in the folder.
  static std::map<std::string, std::string> contentOf(const fs::path& root) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (entry.is_directory()) continue;
      std::ostringstream bytes;
      bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      files[fs::relative(entry.path(), root).string()] = bytes.str();
    }
    return files;
  }

  static void expectOneLine(const Outcome& outcome, int exit_code) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("error: "));
    EXPECT_EQ(outcome.out, "");
  }
};

TEST_F(Simulate, WritesASequenceFolderWithItsTruth) {
  const Outcome outcome = simulate(at("s"), {"--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["frames"], 3);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : contentOf(at("s"))) {
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

  const auto info = run({"info", at("s"), "--json"}).json();  // a reader finds nothing wrong
  EXPECT_EQ(info["kind"], "sequence");
  EXPECT_EQ(info["frames"], 3);
  EXPECT_EQ(info["width_px"], 64);
  EXPECT_TRUE(info["problems"].empty()) << info["problems"];
}

TEST_F(Simulate, OneThreadGivesTheSameBytes) {
  ASSERT_EQ(simulate(at("one"), {"--threads", "1"}).exit_code, 0);
  ASSERT_EQ(simulate(at("two"), {"--threads", "2"}).exit_code, 0);
  const auto one = contentOf(at("one")), two = contentOf(at("two"));
  ASSERT_EQ(one.size(), 16u);
  for (const auto& [name, bytes] : one) EXPECT_TRUE(two.at(name) == bytes) << name;
}

TEST_F(Simulate, AnotherSeedGivesOtherPictures) {
  ASSERT_EQ(simulate(at("one"), {"--seed", "1"}).exit_code, 0);
  ASSERT_EQ(simulate(at("two"), {"--seed", "2"}).exit_code, 0);
  EXPECT_FALSE(contentOf(at("one")).at("left/000000.png") ==
               contentOf(at("two")).at("left/000000.png"));
}

TEST_F(Simulate, OnlyTheTruthThatIsAskedForIsWritten) {
  ASSERT_EQ(simulate(at("s"), {"--truth", "tracks"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(at("s/groundtruth/tracks.csv")));
  EXPECT_EQ(countFiles(at("s/groundtruth")), 1);
  ASSERT_EQ(simulate(at("none"), {"--truth", "none"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(at("none/groundtruth")));
}

TEST_F(Simulate, MasksDepthNormalsAndFlowAreWrittenWhereTheyAreAskedFor) {
  const Outcome done =
      simulate(at("s"), {"--truth", "depth,normals,flow", "--set", "instrument.radius_mm=4",
                         "--set", "input_depth=true", "--set", "pictures=jpg"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto files = contentOf(at("s"));
  for (const char* name :
       {"mask/000001.png", "depth/000001.png", "left/000001.jpg", "groundtruth/depth/000002.png"})
    EXPECT_EQ(files.count(name), 1u) << name;
  EXPECT_EQ(files.at("groundtruth/normals/000002.pfm").size(), 3u + 6 + 5 + 64 * 48 * 12);
  EXPECT_EQ(files.at("groundtruth/flow/000002.flo").size(), 12u + 64 * 48 * 8);
  EXPECT_EQ(files.at("depth/000002.png"), files.at("groundtruth/depth/000002.png"));
  simulate(at("bare"), {"--set", "instrument.radius_mm=4", "--set", "masks=false"});
  EXPECT_FALSE(fs::exists(at("bare/mask")));
}

TEST_F(Simulate, VideosAreReconstructedAndJudgedAsPicturesAre) {
  const std::vector<std::string> size{"--size", "160x120", "--set", "truth_every=1"};
  std::map<std::string, nlohmann::json> view;
  for (const std::string kind : {"png", "mp4"}) {
    std::vector<std::string> more = size;
    more.insert(more.end(), {"--set", "pictures=" + kind});
    ASSERT_EQ(simulate(at(kind), more).exit_code, 0);
    const Outcome run_made = run({"reconstruct", at(kind), "--out", at(kind + "_run"),
                                  "--save-every", "1", "--set", "stereo.disparity_max_px=63"});
    ASSERT_EQ(run_made.exit_code, 0) << run_made.err;
    view[kind] =
        run({"evaluate", at(kind + "_run"), "--reference", at(kind), "--json"}).json()["view"];
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
TEST_F(Simulate, PicturesOfABentLensAreReconstructedAsWell) {
  std::map<std::string, nlohmann::json> judged;
  for (const std::string lens : {"straight", "bent"}) {
    std::vector<std::string> more{"--size", "240x180", "--set", "truth_every=1"};
    if (lens == "bent")
      more.insert(more.end(), {"--set", "scope.k1=-0.3", "--set", "scope.k2=0.1"});
    ASSERT_EQ(simulate(at(lens), more).exit_code, 0);
    const Outcome made = run({"reconstruct", at(lens), "--out", at(lens + "_run"), "--save-every",
                              "1", "--set", "stereo.disparity_max_px=63"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    judged[lens] = run({"evaluate", at(lens + "_run"), "--reference", at(lens), "--json"}).json();
  }
  const auto mean = [&](const char* lens, const char* what) {
    return judged[lens][what]["mean_mm"].get<double>();
  };
  EXPECT_LT(mean("bent", "surface"), 1.25 * mean("straight", "surface"));
  EXPECT_LT(mean("bent", "depth"), 1.25 * mean("straight", "depth"));
  std::ifstream calibration(at("bent/calibration.yaml"));
  const std::string text((std::istreambuf_iterator<char>(calibration)), {});
  EXPECT_THAT(text, HasSubstr("rectified: 0"));
  const Outcome refused =
      simulate(at("depth"), {"--set", "scope.k1=-0.1", "--set", "input_depth=true"});
  expectOneLine(refused, 2);
  EXPECT_THAT(refused.err, HasSubstr("input_depth"));
  const Outcome folded = simulate(at("folded"), {"--set", "scope.k1=-0.4"});
  expectOneLine(folded, 2);
  EXPECT_THAT(folded.err, HasSubstr("scope.k1"));
}

TEST_F(Simulate, AScenarioIsWeakerThanTheLine) {
  const std::string scenario = write("scenario.toml", "frames = 9\n[scope]\nbaseline_mm = 4.5\n");
  ASSERT_EQ(simulate(at("s"), {"--scenario", scenario}).exit_code, 0);
  const auto options = nlohmann::json::parse(std::ifstream(at("s/simulation.json")))["options"];
  EXPECT_EQ(options["frames"], 3);
  EXPECT_EQ(options["scope.baseline_mm"], 4.5);
}

TEST_F(Simulate, APhotographIsLaidOnTheTissue) {
  ColourImage blue(64, 48, Rgb8{20, 40, 220});
  writePng(at("blue.png"), blue, false);
  ASSERT_EQ(simulate(at("s"), {"--texture", at("blue.png")}).exit_code, 0);
  const Rgb8 seen = readColourImage(at("s/left/000000.png")).at(32, 24);
  EXPECT_GT(seen.blue, 2 * seen.red);
  const auto options = nlohmann::json::parse(std::ifstream(at("s/simulation.json")))["options"];
  EXPECT_EQ(options["texture.picture"], at("blue.png"));
  // A scenario names it as well.
  const std::string scenario =
      write("s.toml", "[texture]\npicture = \"" + at("blue.png") + "\"\npicture_mm = 50\n");
  ASSERT_EQ(simulate(at("t"), {"--scenario", scenario}).exit_code, 0);
  EXPECT_EQ(contentOf(at("s/left")), contentOf(at("t/left")));
}

TEST_F(Simulate, APictureThatIsNoTextureIsOneLine) {
  writePng(at("tiny.png"), ColourImage(5, 4), false);
  writePng(at("good.png"), ColourImage(64, 64), false);
  for (const std::string& name : {at("absent.png"), at("tiny.png"), write("torn.png", "\x89PNG")}) {
    const Outcome refused = simulate(at("s"), {"--texture", name});
    expectOneLine(refused, 3);
    EXPECT_THAT(refused.err, HasSubstr(name));
  }
  const Outcome wide =
      simulate(at("s"), {"--texture", at("good.png"), "--set", "texture.picture_mm=900"});
  expectOneLine(wide, 2);
  EXPECT_THAT(wide.err, HasSubstr("texture.picture_mm"));
  EXPECT_FALSE(fs::exists(at("s")));
}

TEST_F(Simulate, EveryKindOfMeshFileGivesTheSameSequence) {
  const TriangleMesh organ = makeOrganMesh({60, 10, 3, 1.4}, 1);
  ModelSurface surface;
  surface.vertices.points_mm = organ.vertices_mm;
  surface.triangles = organ.triangles;
  std::map<std::string, std::string> depth;
  for (const std::string kind : {".stl", ".ply", ".obj", ".vtp"}) {
    write("organ" + kind,
          modelBytes(surface, formatOf("organ" + kind), unitOf("mm", formatOf("organ" + kind))));
    ASSERT_EQ(simulate(at(kind), {"--organ", at("organ" + kind)}).exit_code, 0) << kind;
    depth[kind] = contentOf(at(kind)).at("groundtruth/depth/000000.png");
    EXPECT_EQ(depth[kind], depth[".stl"]) << kind;
  }
}

/// Every number of a record is one; JSON has no other way to say NaN than null.
void expectNumbers(const nlohmann::json& json, const std::string& name) {
  EXPECT_FALSE(json.is_null()) << name;
  if (json.is_object())
    for (const auto& [key, value] : json.items()) expectNumbers(value, name + "." + key);
}

TEST_F(Simulate, ACutIsReconstructedAndJudged) {
  const std::string scenario = write("cut.toml",
                                     "truth_every = 1\n[organ]\ncells_per_side = 30\n[cut]\n"
                                     "length_mm = 15\nstart_s = 0.04\nduration_s = 0.04\n");
  ASSERT_EQ(run({"simulate", "--out", at("s"), "--scenario", scenario, "--frames", "3", "--size",
                 "160x120"})
                .exit_code,
            0);
  const MeshCheck before = checkMesh(readMesh(at("s/groundtruth/mesh/000000.ply"))),
                  after = checkMesh(readMesh(at("s/groundtruth/mesh/000002.ply")));
  EXPECT_THAT(meshWarnings(before), testing::IsEmpty());
  EXPECT_THAT(meshWarnings(after), testing::IsEmpty());
  EXPECT_EQ(before.triangle_count, after.triangle_count);
  EXPECT_LT(after.volume_mm3, before.volume_mm3 - 50) << "the wound is open";
  const Outcome made = run({"reconstruct", at("s"), "--out", at("r"), "--save-every", "1", "--set",
                            "stereo.disparity_max_px=63"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome judged = run({"evaluate", at("r"), "--reference", at("s"), "--json"});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  expectNumbers(judged.json()["surface"], "surface");
  EXPECT_LT(judged.json()["surface"]["mean_mm"], 1.0);  // at 160 px a disparity of 0.2 px is 0.6 mm
}

TEST_F(Simulate, ACutThatDoesNotFitIsOneLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> lines{
      {{"cut.length_mm=15", "cut.x_mm=80"}, "past the organ"},
      {{"cut.length_mm=150"}, "turns away"},
      {{"cut.length_mm=15", "cut.depth_mm=60"}, "thick"},
      {{"cut.length_mm=15", "cut.opening_mm=9"}, "cut.opening_mm"},
      {{"cut.lenght_mm=15"}, "cut.length_mm"},
      {{"cut.length_mm=long"}, "number"}};
  for (const auto& [settings, expected] : lines) {
    std::vector<std::string> line;
    for (const std::string& setting : settings) line.insert(line.end(), {"--set", setting});
    const Outcome refused = simulate(at("s"), line);
    expectOneLine(refused, 2);
    EXPECT_THAT(refused.err, HasSubstr(expected));
    EXPECT_FALSE(fs::exists(at("s")));
  }
}

TEST_F(Simulate, AFlawedOrganIsRepairedOrRefusedAndSaysWhy) {
  const TriangleMesh organ = makeOrganMesh({60, 10, 3, 1.4}, 1);
  const auto asPly = [&](const std::string& name, std::vector<Triangle> triangles) {
    ModelSurface surface;
    surface.vertices.points_mm = organ.vertices_mm;
    surface.triangles = std::move(triangles);
    return write(name, modelBytes(surface, ModelFormat::kPly, unitOf("mm", ModelFormat::kPly)));
  };
  std::vector<Triangle> flawed(organ.triangles.begin() + 1, organ.triangles.end());
  for (const int i : {40, 90}) std::swap(flawed[i][0], flawed[i][1]);
  const Outcome repaired = simulate(at("s"), {"--organ", asPly("flawed.ply", flawed)});
  ASSERT_EQ(repaired.exit_code, 0) << repaired.err;
  EXPECT_THAT(repaired.err, HasSubstr("flawed.ply: turned 2 triangles"));
  EXPECT_THAT(repaired.err, HasSubstr("flawed.ply: closed 1 holes of 3 edges"));
  EXPECT_THAT(meshWarnings(checkMesh(readMesh(at("s/groundtruth/mesh/000000.ply")))),
              testing::IsEmpty());
  std::vector<Triangle> crowded = organ.triangles;
  crowded.push_back({organ.triangles[5][0], organ.triangles[5][1], organ.triangles[300][0]});
  const Outcome refused = simulate(at("t"), {"--organ", asPly("crowded.ply", crowded)});
  expectOneLine(refused, 3);
  EXPECT_THAT(refused.err, HasSubstr("edges belong to more than two triangles"));
}

TEST_F(Simulate, NothingIsOverwrittenWithoutForce) {
  ASSERT_EQ(simulate(at("s")).exit_code, 0);
  const auto before = contentOf(at("s"));
  const Outcome refused = simulate(at("s"), {"--frames", "1", "--seed", "2"});
  expectOneLine(refused, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_TRUE(contentOf(at("s")) == before);
  ASSERT_EQ(simulate(at("s"), {"--frames", "1", "--force"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(at("s/left/000001.png"))) << "a frame of the earlier simulation stayed";
}

TEST_F(Simulate, ForceLeavesAFolderAloneThatIsNoSimulation) {
  write("mine/left/000000.png", "a photograph");
  expectOneLine(simulate(at("mine"), {"--force"}), 2);
  EXPECT_EQ(countFiles(at("mine")), 1);
}

TEST_F(Simulate, AFolderThatCannotBeIsOneLine) {
  write("file", "bytes");
  expectOneLine(simulate(at("file")), 2);
  const Outcome below = simulate(at("file/s"));
  expectOneLine(below, 3);
  EXPECT_THAT(below.err, HasSubstr(at("file/s")));
  EXPECT_THAT(below.err, HasSubstr("Check the path"));
  EXPECT_THAT(below.err, testing::Not(HasSubstr("filesystem")));
}

TEST_F(Simulate, MisspeltKeysGetTheNearestName) {
  const Outcome line = simulate(at("s"), {"--set", "organ.lenght_mm=50"});
  expectOneLine(line, 2);
  EXPECT_THAT(line.err, HasSubstr("organ.length_mm"));
  const Outcome file = simulate(at("s"), {"--scenario", write("s.toml", "[scope]\nbaselin = 4\n")});
  expectOneLine(file, 2);
  EXPECT_THAT(file.err, HasSubstr("baseline_mm"));
  expectOneLine(simulate(at("s"), {"--truth", "msh"}), 2);
  EXPECT_FALSE(fs::exists(at("s")));
}

TEST_F(Simulate, WhatCannotBeSimulatedIsOneLine) {
  const std::vector<std::vector<std::string>> lines{{"--size", "640"},
                                                    {"--size", "9x9"},
                                                    {"--frames", "0"},
                                                    {"--set", "scope.baseline_mm=0"},
                                                    {"--set", "camera.path=zigzag"},
                                                    {"--set", "pictures=gif"}};
  for (const auto& line : lines) {
    SCOPED_TRACE(testing::PrintToString(line));
    expectOneLine(simulate(at("s"), line), 2);
    EXPECT_FALSE(fs::exists(at("s")));
  }
  expectOneLine(simulate(at("s"), {"--organ", at("absent.stl")}), 3);
  expectOneLine(simulate(at("s"), {"--organ", write("o.stl", "no mesh")}), 3);
  EXPECT_FALSE(fs::exists(at("s")));
}

}  // namespace
}  // namespace softscope::test
