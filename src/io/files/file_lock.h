// src/io/files/file_lock.h: lock of a folder by one process, and whether it is held.
#pragma once

#include <filesystem>

namespace softscope {

/// A lock that ends with its process, however that ends. It is advisory.
class FileLock {
 public:
  /// Makes the file where it is missing; holds nothing yet.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// False while another holds it. True also where nothing can be locked: a lock is no guarantee.
  bool tryToHold() const;

 private:
  int descriptor_;
};

/// Whether somebody holds a lock on `file` at this moment; false where there is no such file.
bool isHeld(const std::filesystem::path& file);

}  // namespace softscope
