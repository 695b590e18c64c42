// toolkit/export/dicom_tools.h: tools of dcmtk, started without a shell.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace softscope {

/// Folder that the destructor removes.
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

/// DICOM file made by `tool` from `source`. `words`: its arguments, never
/// interpreted by a shell. Throws BackendError if the tool is not installed,
/// InputError that begins with `name` if it fails. `interrupted` stops it.
std::string dicomBytes(const std::string& tool, std::vector<std::string> words,
                       const std::filesystem::path& source, const std::filesystem::path& name,
                       const std::function<bool()>& interrupted);

}  // namespace softscope
