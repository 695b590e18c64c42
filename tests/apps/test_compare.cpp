// tests/apps/test_compare.cpp: `softscope compare` on squares whose distances are known.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "io/geometry/ply_writer.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A square of 20 mm at height z, facing up, its corner at (x, 0), in steps of 1 mm.
std::string squareObj(double x_mm, double z_mm, double scale = 1, const std::string& head = "") {
  std::string text = head;
  const auto at = [](int i, int j) { return std::to_string(1 + j * 21 + i); };
  for (int j = 0; j <= 20; ++j)
    for (int i = 0; i <= 20; ++i)
      text += "v " + std::to_string((x_mm + i) * scale) + " " + std::to_string(j * scale) + " " +
              std::to_string(z_mm * scale) + "\n";
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i)
      text +=
          "f " + at(i, j) + " " + at(i + 1, j) + " " + at(i + 1, j + 1) + " " + at(i, j + 1) + "\n";
  return text;
}

class Compare : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("reference.obj", squareObj(0, 0));
    write("above.obj", squareObj(0, 0.75));
  }
  Outcome compare(const std::string& test, std::vector<std::string> more = {}) const {
    std::vector<std::string> line{"compare", "--reference", at("reference.obj"), "--test",
                                  at(test)};
    line.insert(line.end(), more.begin(), more.end());
    return softscope::test::run(line);
  }
  Json compared(const std::string& test, std::vector<std::string> more = {}) const {
    more.push_back("--json");
    const Outcome outcome = compare(test, more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.json();
  }
};

TEST_F(Compare, AShiftedSquareIsOffByItsShift) {
  const Json result = compared("above.obj", {"--tau", "0.5,1"});
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

TEST_F(Compare, PointsAreComparedToo) {
  PointCloud cloud;
  for (int i = 2; i < 18; ++i) cloud.points_mm.emplace_back(float(i), 10.0f, -0.5f);
  writePly(at("points.ply"), cloud, {"world", ""});
  const Json result = compared("points.ply");
  EXPECT_NEAR(result["accuracy"]["mean_mm"], 0.5, 1e-6);
  EXPECT_NEAR(result["signed"]["mean_mm"], -0.5, 1e-6) << "below is inside";
  EXPECT_TRUE(result["accuracy"]["by_area"]["mean_mm"].is_null());
  EXPECT_TRUE(result["scores"][0]["surface_dice"].is_null());
}

TEST_F(Compare, WithoutASideThereIsNoSignedMean) {
  PointCloud cloud;
  for (int i = 100; i < 105; ++i) cloud.points_mm.emplace_back(float(i), 10.0f, -0.5f);
  writePly(at("aside.ply"), cloud, {"world", ""});
  const Outcome told = compare("aside.ply", {"--out", at("aside"), "--errors", "signed"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_NE(told.out.find("5 vertices at the reference's border have no side"), std::string::npos);
  EXPECT_EQ(told.out.find("nan"), std::string::npos) << told.out;
  EXPECT_EQ(textOf(at("aside/error_map.svg")).find("nan"), std::string::npos);
}

TEST_F(Compare, WhatWasObservedIsJudgedByItself) {
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
  const Json result = compared("step.obj", {"--observed", at("scan.ply"), "--observed-within-mm",
                                            "0.5", "--out", at("seen")});
  const Json seen = result["observed"];
  EXPECT_NEAR(seen["test_share"], 10 / 21.0, 1e-9);
  EXPECT_NEAR(seen["reference_share"], 10 / 21.0, 1e-9);
  EXPECT_NEAR(seen["accuracy"]["max_mm"], 0.75, 1e-6);
  EXPECT_NEAR(seen["predicted"]["mean_mm"], 3, 1e-6);
  EXPECT_LE(seen["hausdorff"]["hd_mm"], 0.7501);
  EXPECT_EQ(seen["not_reconstructed_share"], 1) << "0.75 mm is beyond the reach of 0.5";
  EXPECT_THAT(textOf(at("seen/error_map.svg")), HasSubstr("not observed"));
  EXPECT_EQ(
      compare("step.obj", {"--observed", at("scan.ply"), "--observed-within-mm", "0"}).exit_code,
      2);
  EXPECT_EQ(compare("step.obj", {"--observed", at("none.ply")}).exit_code, 3);
}

TEST_F(Compare, ARunGivesItsModelOfTheFrameAskedFor) {
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
  const Json first = compared("run", {"--frame", "0"});
  EXPECT_NEAR(first["accuracy"]["mean_mm"], 0.25, 1e-6);
  EXPECT_THAT(std::string(first["inputs"]["test"]), HasSubstr("000000.ply"));
  EXPECT_THAT(compared("run", {"--frame", "7"})["warnings"].dump(), HasSubstr("was not fused"));
  const Outcome absent = compare("run", {"--frame", "3"});
  EXPECT_EQ(absent.exit_code, 2);
  EXPECT_THAT(absent.err, HasSubstr("saved are the frames 0, 7"));
  EXPECT_EQ(compare("above.obj", {"--frame", "0"}).exit_code, 2) << "no run";
}

TEST_F(Compare, AGivenTransformMovesTheTest) {
  write("down.txt", "# reference_from_test, mm\n1 0 0 0\n0 1 0 0\n0 0 1 -0.5\n0 0 0 1\n");
  const Json moved = compared("above.obj", {"--transform", at("down.txt")});
  EXPECT_EQ(moved["alignment"]["method"], "given");
  EXPECT_NEAR(moved["alignment"]["before"]["mean_mm"], 0.75, 1e-6);
  EXPECT_NEAR(moved["accuracy"]["mean_mm"], 0.25, 1e-6);
  const Json on = compared("above.obj", {"--transform", at("down.txt"), "--align", "icp"});
  EXPECT_EQ(on["alignment"]["method"], "given, then icp");
  EXPECT_LT(on["accuracy"]["mean_mm"], 1e-3);
  write("scaled.txt", "2 0 0 0\n0 2 0 0\n0 0 2 0\n");
  write("short.txt", "1 0 0 0\n");
  write("words.txt", "one 0 0 0\n");
  for (const char* file : {"scaled.txt", "short.txt", "words.txt", "absent.txt"}) {
    const Outcome refused = compare("above.obj", {"--transform", at(file)});
    EXPECT_EQ(refused.exit_code, 3) << file;
    EXPECT_THAT(refused.err, HasSubstr(file));
  }
}

TEST_F(Compare, AnAlignmentIsToldWithTheErrorsBefore) {
  const Json icp = compared("above.obj", {"--align", "icp"});
  EXPECT_NEAR(icp["alignment"]["before"]["mean_mm"], 0.75, 1e-6);
  EXPECT_LT(icp["accuracy"]["mean_mm"], 1e-3);
  write("marks.csv",
        "name,test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm\n"
        "a,0,0,0.75,0,0,0.25\nb,20,0,0.75,20,0,0.25\nc,0,20,0.75,0,20,0.25\n\"d, e\",20,20,0.75,20,"
        "20,0.25\n");
  const Json marks = compared("above.obj", {"--landmarks", at("marks.csv")});
  EXPECT_EQ(marks["alignment"]["method"], "landmarks");
  EXPECT_NEAR(marks["accuracy"]["mean_mm"], 0.25, 1e-6) << "half a millimetre down";
  EXPECT_NEAR(marks["alignment"]["fre"]["rmse_mm"], 0, 1e-6);
  EXPECT_EQ(marks["alignment"]["tre_leave_one_out"]["n"], 4);
}

TEST_F(Compare, UnitsAndSpacesAreMatchedAndTold) {
  write("metres.obj", squareObj(0, 0.75, 0.001));
  EXPECT_THAT(compared("metres.obj")["warnings"].dump(), HasSubstr("metres"));
  EXPECT_NEAR(compared("metres.obj", {"--test-unit-mm", "1000"})["accuracy"]["mean_mm"], 0.75,
              1e-5);
  write("reference.obj", squareObj(0, 0, 1, "# SPACE=LPS\n"));
  std::string ras = "# SPACE=RAS\n";
  for (const char* corner : {"0 0", "-20 0", "-20 -20", "0 -20"})
    ras += std::string("v ") + corner + " 0.75\n";
  write("ras.obj", ras + "f 1 2 3 4\n");
  const Json result = compared("ras.obj");
  EXPECT_NEAR(result["accuracy"]["mean_mm"], 0.75, 1e-6);
  EXPECT_THAT(result["space"].dump(), HasSubstr("negated"));
}

TEST_F(Compare, WritesNumbersSurfaceAndFigure) {
  const Json result = compared("above.obj", {"--out", at("out")});
  EXPECT_EQ(result, Json::parse(textOf(at("out/comparison.json"))));
  EXPECT_EQ(countFiles(at("out")), 10);
  EXPECT_THAT(textOf(at("out/error_map.svg")), HasSubstr("distance to the surface [mm]"));
  EXPECT_THAT(textOf(at("out/metrics.csv")), HasSubstr("\nhausdorff.hd95_pooled_mm,0.75"));
  const std::string vtp = textOf(at("out/errors.vtp"));
  for (const char* array : {"\"Signed\"", "\"Absolute\"", "\"ToReference\""})
    EXPECT_THAT(vtp, HasSubstr(array));
  EXPECT_EQ(compare("above.obj", {"--out", at("out")}).exit_code, 2);
  EXPECT_EQ(compare("above.obj", {"--out", at("out"), "--force"}).exit_code, 0);
}

TEST_F(Compare, LimitsSetTheExitCode) {
  EXPECT_EQ(compare("above.obj", {"--fail-if", "p95_mm>0.8"}).exit_code, 0);
  const Outcome failed = compare("above.obj", {"--fail-if", "p95_mm>0.7"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.err, HasSubstr("accuracy.p95_mm is 0.75"));
}

TEST_F(Compare, BadInputEndsInOneLine) {
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
  const Outcome cloud_reference =
      softscope::test::run({"compare", "--reference", at("points.ply"), "--test", at("above.obj")});
  EXPECT_THAT(cloud_reference.err, HasSubstr("a reference is a surface"));
  for (const Outcome& outcome : {cloud_reference, compare("nothing.ply"),
                                 compare("above.obj", {"--landmarks", at("few.csv")}),
                                 compare("above.obj", {"--landmarks", at("hole.csv")}),
                                 compare("above.obj", {"--landmarks", at("far.csv")})}) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--tau", "0"}, {"--tau", "a"}, {"--align", "best"}, {"--align", "landmarks"}})
    EXPECT_EQ(compare("above.obj", wrong).exit_code, 2) << wrong[0] << " " << wrong[1];
}

}  // namespace
}  // namespace softscope::test
