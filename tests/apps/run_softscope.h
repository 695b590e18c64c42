// tests/apps/run_softscope.h: the real program, as a user would run it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope::test {

struct Outcome {
  int exit_code = -1;
  std::string out, err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }  // throws if it is none
};

/// Runs softscope with these arguments to its end, in a process of its own.
Outcome run(const std::vector<std::string>& arguments);

std::string executable();

/// All bytes of a file; nothing where there is none.
std::string textOf(const std::filesystem::path& file);

/// A folder of its own for each test, gone afterwards.
class InFolder : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// Path of something in the folder.
  std::string at(const std::string& name) const { return folder / name; }
  std::string write(const std::string& name, const std::string& bytes) const;
  /// A sequence of `frames` pairs, 160 x 120, of a textured slope some 50 mm away.
  std::string makeSequence(const std::string& name, int frames) const;
  /// How many files there are, temporary ones included.
  static int countFiles(const std::string& path);

  std::filesystem::path folder;
};

/// What the sequence's calibration says.
RectifiedRig sequenceRig();

}  // namespace softscope::test
