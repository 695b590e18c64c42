// src/io/files/new_files.h: files of one result, removed after a failure.
#pragma once

#include <filesystem>
#include <mutex>
#include <vector>

namespace softscope {

/// Without keep() the destructor removes every file and folder
/// created through it, so that a failed command leaves no
/// incomplete series. Replaced files are kept. Thread-safe.
class NewFiles {
 public:
  NewFiles() = default;
  ~NewFiles();
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;

  /// Calls `write`, which writes `file`.
  template <class Write>
  void make(const std::filesystem::path& file, const Write& write);
  /// Creates the folder with missing parents. Throws Error: the folder, the reason of the system.
  void makeFolder(const std::filesystem::path& folder);
  void keep();

 private:
  static bool isThere(const std::filesystem::path& file);
  void add(const std::filesystem::path& file);

  std::mutex mutex_;
  std::vector<std::filesystem::path> files_, folders_;
};

template <class Write>
void NewFiles::make(const std::filesystem::path& file, const Write& write) {
  const bool replaces = isThere(file);
  write();
  if (!replaces) add(file);
}

}  // namespace softscope
