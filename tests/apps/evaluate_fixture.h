// tests/apps/evaluate_fixture.h: a run, its truth, and the command on them.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/made_run.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {

using Json = nlohmann::json;

class Evaluate : public WallTest {
 protected:
  Outcome evaluate(std::vector<std::string> more = {}) const {
    std::vector<std::string> line{"evaluate", at("run"), "--reference", at("truth")};
    line.insert(line.end(), more.begin(), more.end());
    return softscope::test::run(line);
  }
  Json evaluated() const {
    const Outcome outcome = evaluate({"--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.json();
  }
  /// Expects exit code 3 and one line that holds all of `parts`.
  static void expectRefused(const std::vector<std::string>& parts, const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, testing::HasSubstr(part));
    const std::string last = outcome.err.substr(outcome.err.find("error: "));  // after the progress
    EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  }
};

}  // namespace softscope::test
