// tests/apps/run_softscope.h: the real program, as a user would run it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "support/folder_test.h"

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

class InFolder : public FolderTest {
 protected:
  /// Path of something in the folder.
  std::string at(const std::string& name) const { return folder / name; }
  /// A sequence of `frames` pairs, 160 x 120, of a textured slope some 50 mm away.
  std::string makeSequence(const std::string& name, int frames) const;
  /// How many files there are, temporary ones included.
  static int countFiles(const std::string& path);
};

/// What the sequence's calibration says.
RectifiedRig sequenceRig();

}  // namespace softscope::test
