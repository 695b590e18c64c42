// tests/apps/run_softscope.h: the real program, as a user would run it.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/in_folder.h"

namespace softscope::test {

struct Outcome {
  int exit_code = -1;
  std::string out, err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }  // throws if it is none
};

/// Runs softscope with these arguments to its end, in another process: with some commands a new
/// one, with others the one that ran the calls before (program_server.h).
Outcome run(const std::vector<std::string>& arguments);

std::string executable();

}  // namespace softscope::test
