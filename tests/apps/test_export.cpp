// tests/apps/test_export.cpp: `softscope export`: its options, its lines and its exit codes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

#include "support/made_meshes.h"
#include "support/made_run.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Export : public InFolder {
 protected:
  /// Of a square in the folder.
  Outcome exported(const std::string& out, std::vector<std::string> more = {}) const {
    write("square.obj", squareObj(0, 0));
    more.insert(more.begin(), {"export", at("square.obj"), "--out", at(out)});
    return run(more);
  }
};

TEST_F(Export, OptionsReachTheFile) {
  makeWallRun(at("run"), 4);  // its walls are too coarse for a surface, not for points
  const Outcome series =
      run({"export", at("run"), "--out", at("all.pvd"), "--points", "--every", "2", "--json"});
  ASSERT_EQ(series.exit_code, 0) << series.err;
  EXPECT_EQ(series.json().at("models"), 2);
  EXPECT_TRUE(fs::exists(at("all/000002.vtp")));
  EXPECT_THAT(run({"export", at("run"), "--frame", "9", "--out", at("c.ply")}).err,
              HasSubstr("saved are the frames 0, 1, 2, 3"));
  const Outcome metres = exported("m.ply", {"--input-unit-mm", "1000", "--unit", "m", "--json"});
  ASSERT_EQ(metres.exit_code, 0) << metres.err;
  EXPECT_EQ(metres.json().at("unit"), "m");
  EXPECT_NEAR(metres.json().at("area_mm2"), 400e6, 1e3);
}

TEST_F(Export, OverwritesNothingWithoutForce) {
  write("a.ply", "mine");
  const Outcome refused = exported("a.ply");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(textOf(at("a.ply")), "mine");
  EXPECT_EQ(exported("a.ply", {"--force"}).exit_code, 0);
}

TEST_F(Export, RefusesInOneLineAndLeavesNothing) {
  const Outcome missing = run({"export", at("missing.ply"), "--out", at("a.ply")});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
  EXPECT_THAT(exported("a.stl", {"--points"}).err, HasSubstr("--points takes .ply"));
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--unit", "inch"},
                                             {"--frame", "3"},
                                             {"--gap-mm", "-1"},
                                             {"--island-mm2", "-1"},
                                             {"--patient-id", "7"},
                                             {"--patient-name", "Doe"},
                                             {"--title", "wave"}})
    EXPECT_EQ(exported("a.ply", wrong).exit_code, 2) << wrong[0];
  EXPECT_EQ(countFiles(folder), 1) << "the square alone";
}

TEST_F(Export, WithoutDcmtkSaysWhatToInstall) {
  write("report.pdf", "%PDF-1.4\n%%EOF\n");
  const std::string line = "PATH=/nonexistent '" + executable() + "' export '" + at("report.pdf") +
                           "' --out '" + at("r.dcm") + "' 2> '" + at("err.txt") + "'";
  EXPECT_EQ(std::system(line.c_str()) / 256, 4);
  EXPECT_THAT(textOf(at("err.txt")), HasSubstr("apt install dcmtk"));
}

}  // namespace
}  // namespace softscope::test
