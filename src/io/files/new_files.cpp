#include "io/files/new_files.h"

#include <system_error>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {

namespace fs = std::filesystem;

NewFiles::~NewFiles() {
  std::error_code ignored;
  for (const fs::path& file : files_) fs::remove(file, ignored);
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
    if (fs::is_empty(*folder, ignored)) fs::remove(*folder, ignored);
}

bool NewFiles::isThere(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

void NewFiles::add(const fs::path& file) {
  const std::lock_guard<std::mutex> lock(mutex_);
  files_.push_back(file);
}

void NewFiles::makeFolder(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code problem;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, problem); at = at.parent_path())
    missing.push_back(at);
  fs::create_directories(folder, problem);
  if (problem)
    throw Error(say(shown(folder), ": ", problem.message(),
                    ". Check the path and the rights of its folders."));
  const std::lock_guard<std::mutex> lock(mutex_);
  folders_.insert(folders_.end(), missing.rbegin(), missing.rend());
}

void NewFiles::keep() {
  const std::lock_guard<std::mutex> lock(mutex_);
  files_.clear();
  folders_.clear();
}

}  // namespace softscope
