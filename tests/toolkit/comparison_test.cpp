// tests/toolkit/comparison_test.cpp: squares whose distances are known.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "io/geometry/ply_writer.h"
#include "support/in_folder.h"
#include "support/made_meshes.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/records.h"
#include "toolkit/comparison/compare_files.h"
#include "toolkit/comparison/compare_outputs.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Comparison : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("reference.obj", squareObj(0, 0));
    write("above.obj", squareObj(0, 0.75));
  }
  /// Of a file in the folder against the reference.
  CompareOptions options(const std::string& test) const {
    CompareOptions options;
    options.reference = at("reference.obj");
    options.test = at(test);
    return options;
  }
  Json compared(const std::string& test) const { return compared(options(test)); }
  static Json compared(const CompareOptions& options) {
    return written(compareFiles(options).record);
  }
  /// Writes the files of the comparison.
  FileComparison compareInto(const std::string& out, const CompareOptions& options,
                             const ErrorColourOptions& picture = {}) const {
    const CompareOutputs outputs(at(out), /*overwrite=*/false);
    FileComparison found = compareFiles(options);
    EXPECT_EQ(outputs.write(found.result, found.reference, found.test, picture, found.record), "");
    return found;
  }
};

TEST_F(Comparison, AShiftedSquareIsOffByItsShift) {
  CompareOptions near = options("above.obj");
  near.taus_mm = {0.5, 1};
  const Json result = compared(near);
  for (const char* part : {"accuracy", "completeness"}) {
    EXPECT_NEAR(result[part]["mean_mm"], 0.75, 1e-6) << part;
    EXPECT_NEAR(result[part]["by_area"]["p95_mm"], 0.75, 1e-6) << part;
  }
  EXPECT_NEAR(result["signed"]["mean_mm"], 0.75, 1e-6) << "above is outside";
  EXPECT_EQ(result["signed"]["border_vertices"], 80) << "the rim of 21 x 21";
  EXPECT_NEAR(result["hausdorff"]["hd95_pooled_mm"], 0.75, 1e-6);
  EXPECT_EQ(result["scores"][0]["f_score"], 0);
  EXPECT_EQ(result["scores"][1]["f_score"], 1);
  EXPECT_NEAR(result["scores"][1]["surface_dice"], 1, 1e-12);
  EXPECT_EQ(result["alignment"]["method"], "none");
}

TEST_F(Comparison, SaysThatTheTestGoesBeyondTheReference) {
  write("aside.obj", squareObj(10, 0.75));
  const std::string told = "57 % of the test's vertices lie at or beyond the border";
  EXPECT_THAT(compared("aside.obj")["warnings"].dump(), HasSubstr(told));
  CompareOptions observed = options("aside.obj");
  observed.observed = observed.reference;
  EXPECT_THAT(compared(observed)["warnings"].dump(), testing::Not(HasSubstr("beyond")));
}

TEST_F(Comparison, PointsAreComparedToo) {
  PointCloud cloud;
  for (int i = 2; i < 18; ++i) cloud.points_mm.emplace_back(float(i), 10.0f, -0.5f);
  writePly(at("points.ply"), cloud, {"world", ""});
  const Json result = compared("points.ply");
  EXPECT_NEAR(result["accuracy"]["mean_mm"], 0.5, 1e-6);
  EXPECT_NEAR(result["signed"]["mean_mm"], -0.5, 1e-6) << "below is inside";
  EXPECT_TRUE(result["accuracy"]["by_area"]["mean_mm"].is_null());
  EXPECT_TRUE(result["scores"][0]["surface_dice"].is_null());
}

TEST_F(Comparison, WithoutASideThereIsNoSignedMean) {
  PointCloud cloud;
  for (int i = 100; i < 105; ++i) cloud.points_mm.emplace_back(float(i), 10.0f, -0.5f);
  writePly(at("aside.ply"), cloud, {"world", ""});
  ErrorColourOptions picture;
  picture.kind = "signed";
  const std::string told =
      comparisonFacts(compareInto("aside", options("aside.ply"), picture).result).text();
  EXPECT_NE(told.find("5 vertices at the border of the reference have no sign"), std::string::npos);
  EXPECT_EQ(told.find("nan"), std::string::npos) << told;
  EXPECT_EQ(textOf(at("aside/error_map.svg")).find("nan"), std::string::npos);
}

TEST_F(Comparison, WhatWasObservedIsJudgedByItself) {
  // The test is 0.75 mm off where x < 10 and 3 mm off beyond; only x <= 9 was seen.
  std::string step;
  std::istringstream lines(squareObj(0, 0.75));
  for (std::string line; std::getline(lines, line);) {
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      line = "v " + std::to_string(x) + " " + std::to_string(y) + (x < 10 ? " 0.75" : " 3");
    step += line + "\n";
  }
  write("step.obj", step);
  PointCloud scan;
  for (int x = 0; x <= 9; ++x)
    for (int y = 0; y <= 20; ++y) scan.points_mm.emplace_back(float(x), float(y), 0.0f);
  writePly(at("scan.ply"), scan, {"world", ""});
  CompareOptions split = options("step.obj");
  split.observed = at("scan.ply");
  split.observed_reach_mm = 0.5;
  const Json result = written(compareInto("seen", split).record);
  const Json seen = result["observed"];
  EXPECT_NEAR(seen["test_share"], 10 / 21.0, 1e-9);
  EXPECT_NEAR(seen["reference_share"], 10 / 21.0, 1e-9);
  EXPECT_NEAR(seen["accuracy"]["max_mm"], 0.75, 1e-6);
  EXPECT_NEAR(seen["predicted"]["mean_mm"], 3, 1e-6);
  EXPECT_LE(seen["hausdorff"]["hd_mm"], 0.7501);
  EXPECT_EQ(seen["not_reconstructed_share"], 1) << "0.75 mm is beyond the reach of 0.5";
  EXPECT_THAT(textOf(at("seen/error_map.svg")), HasSubstr("not observed"));
  split.observed_reach_mm = 0;
  expectError<OptionError>([&] { compareFiles(split); }, {"observed"});
  split = options("step.obj");
  split.observed = at("none.ply");
  expectError<InputError>([&] { compareFiles(split); }, {"none.ply"});
}

TEST_F(Comparison, AnObservedPartElsewhereIsWarnedOf) {
  PointCloud scan;
  scan.points_mm.emplace_back(0.0f, 0.0f, 500.0f);
  writePly(at("scan.ply"), scan, {"world", ""});
  CompareOptions split = options("above.obj");
  split.observed = at("scan.ply");
  const FileComparison compared = compareFiles(split);
  EXPECT_THAT(written(compared.record)["warnings"].dump(),
              HasSubstr("scan.ply: nothing of the reference is within 2 mm of it"));
  EXPECT_THAT(comparisonFacts(compared.result).text(), testing::Not(HasSubstr("nan")));
  split.observed = at("reference.obj");
  EXPECT_THAT(written(compareFiles(split).record)["warnings"].dump(),
              testing::Not(HasSubstr("nothing of the reference")));
}

TEST_F(Comparison, ARunGivesItsModelOfTheFrameAskedFor) {
  fs::create_directories(at("run/models"));
  write("run/trajectory.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  write("run/frames.csv", "frame,status\n0,started\n7,lost\n");
  for (const auto& [name, z] : {std::pair("model.ply", 0.5f), std::pair("models/000000.ply", 0.25f),
                                std::pair("models/000007.ply", 0.5f)}) {
    PointCloud cloud;
    for (int i = 2; i < 18; ++i) cloud.points_mm.emplace_back(float(i), 10.0f, z);
    writePly(at(std::string("run/") + name), cloud, {"world", ""});
  }
  EXPECT_NEAR(compared("run")["accuracy"]["mean_mm"], 0.5, 1e-6) << "the last model";
  const auto ofFrame = [&](const std::string& test, int frame) {
    CompareOptions of_frame = options(test);
    of_frame.frame = frame;
    return of_frame;
  };
  const Json first = compared(ofFrame("run", 0));
  EXPECT_NEAR(first["accuracy"]["mean_mm"], 0.25, 1e-6);
  EXPECT_THAT(std::string(first["inputs"]["test"]), HasSubstr("000000.ply"));
  EXPECT_THAT(compared(ofFrame("run", 7))["warnings"].dump(), HasSubstr("was not fused"));
  expectError<OptionError>([&] { compareFiles(ofFrame("run", 3)); }, {"saved are the frames 0, 7"});
  expectError<OptionError>([&] { compareFiles(ofFrame("above.obj", 0)); },
                           {"above.obj"});  // no run
}

TEST_F(Comparison, AGivenTransformMovesTheTest) {
  write("down.txt", "# reference_from_test, mm\n1 0 0 0\n0 1 0 0\n0 0 1 -0.5\n0 0 0 1\n");
  CompareOptions given = options("above.obj");
  given.fit.transform = at("down.txt");
  const Json moved = compared(given);
  EXPECT_EQ(moved["alignment"]["method"], "given");
  EXPECT_NEAR(moved["alignment"]["before"]["mean_mm"], 0.75, 1e-6);
  EXPECT_NEAR(moved["accuracy"]["mean_mm"], 0.25, 1e-6);
  given.fit.closest_points = true;
  const Json on = compared(given);
  EXPECT_EQ(on["alignment"]["method"], "given, then icp");
  EXPECT_LT(on["accuracy"]["mean_mm"], 1e-3);
  write("scaled.txt", "2 0 0 0\n0 2 0 0\n0 0 2 0\n");
  write("short.txt", "1 0 0 0\n");
  write("words.txt", "one 0 0 0\n");
  for (const char* file : {"scaled.txt", "short.txt", "words.txt", "absent.txt"}) {
    given = options("above.obj");
    given.fit.transform = at(file);
    expectError<InputError>([&] { compareFiles(given); }, {file});
  }
}

TEST_F(Comparison, AnAlignmentIsToldWithTheErrorsBefore) {
  CompareOptions closest = options("above.obj");
  closest.fit.closest_points = true;
  const Json icp = compared(closest);
  EXPECT_NEAR(icp["alignment"]["before"]["mean_mm"], 0.75, 1e-6);
  EXPECT_LT(icp["accuracy"]["mean_mm"], 1e-3);
  write("marks.csv",
        "name,test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm\n"
        "a,0,0,0.75,0,0,0.25\nb,20,0,0.75,20,0,0.25\nc,0,20,0.75,0,20,0.25\n\"d, e\",20,20,0.75,20,"
        "20,0.25\n");
  CompareOptions marked = options("above.obj");
  marked.fit.landmarks = at("marks.csv");
  const Json marks = compared(marked);
  EXPECT_EQ(marks["alignment"]["method"], "landmarks");
  EXPECT_NEAR(marks["accuracy"]["mean_mm"], 0.25, 1e-6) << "half a millimetre down";
  EXPECT_NEAR(marks["alignment"]["fre"]["rmse_mm"], 0, 1e-6);
  const Json& tre = marks["alignment"]["tre_leave_one_out"];
  EXPECT_EQ(tre["n"], 4);
  ASSERT_EQ(tre["mean_ci_95_mm"].size(), 2u);
  EXPECT_LE(tre["mean_ci_95_mm"][0], tre["mean_mm"]);
  EXPECT_GE(tre["mean_ci_95_mm"][1], tre["mean_mm"]);
}

TEST_F(Comparison, UnitsAndSpacesAreMatchedAndTold) {
  write("metres.obj", squareObj(0, 0.75, 0.001));
  EXPECT_THAT(compared("metres.obj")["warnings"].dump(), HasSubstr("metres"));
  CompareOptions metres = options("metres.obj");
  metres.test_unit_mm = 1000;
  EXPECT_NEAR(compared(metres)["accuracy"]["mean_mm"], 0.75, 1e-5);
  write("reference.obj", squareObj(0, 0, 1, "# SPACE=LPS\n"));
  std::string ras = "# SPACE=RAS\n";
  for (const char* corner : {"0 0", "-20 0", "-20 -20", "0 -20"})
    ras += std::string("v ") + corner + " 0.75\n";
  write("ras.obj", ras + "f 1 2 3 4\n");
  const Json result = compared("ras.obj");
  EXPECT_NEAR(result["accuracy"]["mean_mm"], 0.75, 1e-6);
  EXPECT_THAT(result["space"].dump(), HasSubstr("negated"));
}

TEST_F(Comparison, AFileWithoutASpaceIsTakenForLpsBesideOneThatNamesIt) {
  std::string ras = "# SPACE=RAS\n";
  for (const char* corner : {"0 0", "-20 0", "-20 -20", "0 -20"})
    ras += std::string("v ") + corner + " 0.75\n";
  write("ras.obj", ras + "f 1 2 3 4\n");
  const Json result = compared("ras.obj");  // reference.obj names none
  EXPECT_NEAR(result["accuracy"]["mean_mm"], 0.75, 1e-6);
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("names no space"));
  EXPECT_THAT(compared("above.obj")["warnings"].dump(), testing::Not(HasSubstr("names no space")));
}

TEST_F(Comparison, WritesNumbersSurfaceAndFigure) {
  const FileComparison found = compareInto("out", options("above.obj"));
  EXPECT_EQ(written(found.record), Json::parse(textOf(at("out/comparison.json"))));
  EXPECT_EQ(countFiles(at("out")), 10);
  EXPECT_THAT(textOf(at("out/error_map.svg")), HasSubstr("distance to the surface [mm]"));
  EXPECT_THAT(textOf(at("out/metrics.csv")), HasSubstr("\nhausdorff.hd95_pooled_mm,0.75"));
  const std::string vtp = textOf(at("out/errors.vtp"));
  for (const char* array : {"\"Signed\"", "\"Absolute\"", "\"ToReference\""})
    EXPECT_THAT(vtp, HasSubstr(array));
  expectError<OptionError>([&] { CompareOutputs(at("out"), false); }, {"comparison.json"});
  EXPECT_EQ(CompareOutputs(at("out"), true)
                .write(found.result, found.reference, found.test, {}, found.record),
            "");
}

TEST_F(Comparison, LimitsFailWhereTheyHold) {
  CompareOptions limited = options("above.obj");
  limited.thresholds = limits({"p95_mm>0.8", "p95_mm>0.7"});
  const auto outcomes = compareFiles(limited).outcomes;
  EXPECT_FALSE(outcomes.at(0).failed);
  EXPECT_TRUE(outcomes.at(1).failed);
  EXPECT_EQ(outcomes.at(1).path, "accuracy.p95_mm");
  EXPECT_NEAR(outcomes.at(1).value, 0.75, 1e-6);
}

TEST_F(Comparison, EveryMetricOfTheRecordCanHaveALimit) {
  CompareOptions limited = options("above.obj");
  limited.taus_mm = {0.5, 1};
  limited.observed = at("reference.obj");
  limited.thresholds =
      limits({"observed.accuracy.p95_mm>0.7", "scores.0.5mm.recall<0.1", "1mm.surface_dice<0.9"});
  const auto outcomes = compareFiles(limited).outcomes;
  EXPECT_NEAR(outcomes.at(0).value, 0.75, 1e-6);
  EXPECT_EQ(outcomes.at(1).value, 0);
  EXPECT_EQ(outcomes.at(2).path, "scores.1mm.surface_dice");
  EXPECT_EQ(outcomes.at(2).value, 1);
  const auto refused = [&](const std::string& limit, const std::string& part) {
    limited.thresholds = limits({limit});
    expectError<OptionError>([&] { limited.validate(); }, {part});
  };
  refused("surface_dice<0.9", "write it in full");
  limited.observed.clear();
  refused("observed.accuracy.p95_mm>0.1", "no metric of this evaluation");
}

TEST_F(Comparison, BadInputIsRefusedInOneLine) {
  PointCloud cloud;
  cloud.points_mm = {{1, 2, 3}};
  writePly(at("points.ply"), cloud, {"world", ""});
  write("few.csv",
        "test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm\n"
        "0,0,0,0,0,0\n");
  write("hole.csv",
        "test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm\n"
        "0,0,,0,0,0\n0,0,1,0,0,0\n0,0,2,0,0,0\n");
  write("far.csv",
        "test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm\n"
        "0,0,1e34,0,0,0\n0,0,1,0,0,0\n0,0,2,0,0,0\n");
  CompareOptions points = options("above.obj");
  points.reference = at("points.ply");
  expectError<InputError>([&] { compareFiles(points); }, {"the reference must be a surface"});
  expectError<InputError>([&] { compareFiles(options("nothing.ply")); }, {"nothing.ply"});
  for (const char* pairs : {"few.csv", "hole.csv", "far.csv"}) {
    CompareOptions marked = options("above.obj");
    marked.fit.landmarks = at(pairs);
    expectError<InputError>([&] { compareFiles(marked); }, {pairs});
  }
  CompareOptions wrong = options("above.obj");
  wrong.taus_mm = {0};
  expectError<OptionError>([&] { compareFiles(wrong); }, {"tau"});
  for (const char* how : {"best", "landmarks"})
    EXPECT_THROW(parseFit(how, "", "--landmarks"), OptionError) << how;
}

}  // namespace
}  // namespace softscope::test
