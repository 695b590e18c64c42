// tests/support/in_folder.h: a test with a folder of its own for sequences and results.
#pragma once

#include <filesystem>
#include <string>

#include "core/stereo_rig.h"
#include "support/folder_test.h"

namespace softscope::test {

/// All bytes of a file; nothing where there is none.
std::string textOf(const std::filesystem::path& file);

/// How many files there are, temporary ones included.
int countFiles(const std::filesystem::path& folder);

/// Writes `frames` pairs, 160 x 120, of a textured slope some 50 mm away, with their calibration.
void writeSequence(const std::filesystem::path& folder, int frames);

/// Text of that calibration.
RectifiedRig sequenceRig();

class InFolder : public FolderTest {
 protected:
  /// Path of something in the folder.
  std::string at(const std::string& name) const { return folder / name; }
  /// writeSequence() of this name; its path.
  std::string makeSequence(const std::string& name, int frames) const {
    writeSequence(folder / name, frames);
    return at(name);
  }
};

}  // namespace softscope::test
