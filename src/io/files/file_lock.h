// src/io/files/file_lock.h: lock of a folder by one process, with a query of its state.
#pragma once

#include <filesystem>

namespace softscope {

/// Advisory lock that ends with its process in all cases.
class FileLock {
 public:
  /// Creates the file if it is missing; does not lock.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// False while another process holds the lock. True if the file system does not support locks.
  bool tryToHold() const;

 private:
  int descriptor_;
};

/// True if a process currently holds a lock on `file`; false for a missing file.
bool isHeld(const std::filesystem::path& file);

}  // namespace softscope
