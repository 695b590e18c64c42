// src/io/files/atomic_file.h: atomic writing of files.
#pragma once

#include <filesystem>
#include <string_view>

namespace softscope {

/// Throws OptionError with --force if `target` exists and `overwrite` is false.
void requireWritable(const std::filesystem::path& target, bool overwrite);

/// Writes to a temporary file next to the target; commit() renames it atomically.
/// Without commit() the target is unchanged. Protects against a stopped program and
/// a full disk, not against a power failure (data are not flushed to the medium).
class AtomicFile {
 public:
  /// Throws OptionError as requireWritable does, Error for a folder without write access.
  AtomicFile(std::filesystem::path target, bool overwrite);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Throws Error for a full disk.
  void write(std::string_view bytes);

  /// Throws Error, or OptionError if the target was created in the meantime.
  void commit();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool overwrite_;
  int descriptor_ = -1;
};

/// Removes temporary files of killed processes in `folder`; does nothing for
/// a missing folder. Requires that no other process writes to the folder.
void removeTemporaries(const std::filesystem::path& folder);

/// Removes temporary files of processes that no longer run on
/// this machine: for a folder with several writers. A process on
/// another machine with the same folder counts as not running.
void removeAbandoned(const std::filesystem::path& folder);

/// Writes all bytes at once.
void writeFile(const std::filesystem::path& target, std::string_view bytes, bool overwrite);

}  // namespace softscope
