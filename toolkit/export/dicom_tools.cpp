// toolkit/export/dicom_tools.cpp: search in PATH, one child process per file.
#include "toolkit/export/dicom_tools.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "toolkit/record/child_process.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// In PATH. Throws BackendError.
fs::path findTool(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    struct stat facts {};
    if (!folder.empty() && stat(file.c_str(), &facts) == 0 && S_ISREG(facts.st_mode) &&
        access(file.c_str(), X_OK) == 0)
      return fs::absolute(file);
  }
  throw BackendError(name + " isn't there, which makes DICOM files; install the package dcmtk (" +
                     "Debian: apt install dcmtk)");
}

std::string firstComplaint(const fs::path& log) {
  std::error_code ignored;
  if (fs::file_size(log, ignored) == 0 || ignored) return "without a message";
  const std::string text = readBytes(log, kTextLimitBytes);
  const auto at = std::min(text.find("E: "), text.find("F: "));
  const std::string rest = text.substr(at == text.npos ? 0 : at + 3);
  return excerpt(rest.substr(0, rest.find('\n')));
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string form = (fs::temp_directory_path() / "softscope_dicom_XXXXXX").string();
  if (mkdtemp(form.data()) == nullptr)
    throw Error(shown(fs::temp_directory_path()) + ": a temporary folder could not be created");
  folder_ = form;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string dicomBytes(const std::string& tool, std::vector<std::string> words,
                       const fs::path& source, const fs::path& name,
                       const std::function<bool()>& interrupted) {
  words.insert(words.begin(), findTool(tool).string());
  const TemporaryFolder folder;
  const fs::path made = folder / "made.dcm", log = folder / "log.txt";
  words.push_back(source.string());
  words.push_back(made.string());
  const int code = runToEnd(ChildProcess(words, log), interrupted);
  if (code != 0 || !fs::exists(made))
    throw InputError(shown(name) + ": " + tool + " refuses it: " + firstComplaint(log));
  return readBytes(made, std::uintmax_t{2} << 30);
}

}  // namespace softscope
