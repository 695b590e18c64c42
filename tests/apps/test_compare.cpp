// tests/apps/test_compare.cpp: `softscope compare`: its options, its lines and its exit codes.
#include <algorithm>

#include "support/made_meshes.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

using testing::HasSubstr;

class Compare : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("reference.obj", squareObj(0, 0));
    write("above.obj", squareObj(0, 0.75));
  }
  Outcome compare(const std::string& test, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"compare", "--reference", at("reference.obj"), "--test", at(test)});
    return run(more);
  }
};

TEST_F(Compare, OptionsReachTheComparison) {
  write("down.txt", "1 0 0 0\n0 1 0 0\n0 0 1 -0.5\n0 0 0 1\n");
  const Outcome outcome =
      compare("above.obj",
              {"--tau", "0.1,0.3", "--transform", at("down.txt"), "--observed", at("reference.obj"),
               "--observed-within-mm", "0.5", "--errors", "signed", "--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json record = outcome.json();
  EXPECT_EQ(record, Json::parse(textOf(at("out/comparison.json"))));
  EXPECT_EQ(record["alignment"]["method"], "given");
  EXPECT_NEAR(record["accuracy"]["mean_mm"], 0.25, 1e-6);
  EXPECT_EQ(record["scores"][0]["f_score"], 0);
  EXPECT_EQ(record["scores"][1]["f_score"], 1);
  EXPECT_EQ(record["observed"]["test_share"], 1);
  EXPECT_LT(compare("above.obj", {"--align", "icp", "--json"}).json()["accuracy"]["mean_mm"], 1e-3);
  write("metres.obj", squareObj(0, 0.75, 0.001));
  EXPECT_NEAR(
      compare("metres.obj", {"--test-unit-mm", "1000", "--json"}).json()["accuracy"]["mean_mm"],
      0.75, 1e-5);
}

TEST_F(Compare, WarningsOfARecordAreOnStderrToo) {
  write("small.obj", squareObj(0, 0.75, 0.001));
  const Outcome outcome = compare("small.obj", {"--json", "--quiet"});
  const Json warnings = outcome.json()["warnings"];
  ASSERT_GE(warnings.size(), 1u);
  EXPECT_THAT(outcome.err, HasSubstr("in metres? Then give 1000 as --test-unit-mm"));
  for (const Json& warning : warnings)
    EXPECT_THAT(outcome.err, HasSubstr(warning.get<std::string>()));
}

TEST_F(Compare, NothingIsOverwrittenWithoutForce) {
  write("out/comparison.json", "mine");
  const Outcome refused = compare("above.obj", {"--out", at("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(compare("above.obj", {"--out", at("out"), "--force"}).exit_code, 0);
}

TEST_F(Compare, LimitsSetTheExitCode) {
  EXPECT_EQ(compare("above.obj", {"--fail-if", "p95_mm>0.8"}).exit_code, 0);
  const Outcome failed = compare("above.obj", {"--fail-if", "p95_mm>0.7"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.err, HasSubstr("accuracy.p95_mm is 0.75"));
}

TEST_F(Compare, BadInputEndsInOneLine) {
  write("few.csv",
        "test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm\n"
        "0,0,0,0,0,0\n");
  for (const Outcome& outcome :
       {compare("nothing.ply"), compare("above.obj", {"--landmarks", at("few.csv")})}) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--tau", "0"},
                                             {"--tau", "a"},
                                             {"--align", "best"},
                                             {"--align", "landmarks"},
                                             {"--frame", "0"},
                                             {"--errors", "none"}})
    EXPECT_EQ(compare("above.obj", wrong).exit_code, 2) << wrong[0] << " " << wrong[1];
}

}  // namespace
}  // namespace softscope::test
