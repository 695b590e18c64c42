// toolkit/export/dicom_tools.h: dcmtk's tools, started without a shell.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace softscope {

/// A folder that is gone with its scope.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws Error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const char* name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

/// The bytes of the DICOM file that `tool` makes of `source`. `words`: its options; nothing of them
/// is ever read by a shell. Throws BackendError where the tool isn't installed, InputError that
/// begins with `name` where it refuses. `interrupted` stops it.
std::string dicomBytes(const std::string& tool, std::vector<std::string> words,
                       const std::filesystem::path& source, const std::filesystem::path& name,
                       const std::function<bool()>& interrupted);

}  // namespace softscope
