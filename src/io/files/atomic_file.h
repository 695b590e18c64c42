// src/io/files/atomic_file.h: a file that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace softscope {

/// Throws OptionError naming --force where `target` exists and `overwrite` is false.
void requireWritable(const std::filesystem::path& target, bool overwrite);

/// Gathers bytes under a temporary name beside the target; commit() gives the file its name in one
/// step. Without commit() the target stays as it was. Guards against a stopped program and a full
/// disk, not against a power cut (nothing is flushed to the medium).
class AtomicFile {
 public:
  /// Throws OptionError as requireWritable does, Error where the folder can't be written to.
  AtomicFile(std::filesystem::path target, bool overwrite);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Throws Error where the disk is full.
  void write(std::string_view bytes);

  /// Throws Error, or OptionError where the target appeared meanwhile.
  void commit();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool overwrite_;
  int descriptor_ = -1;
};

/// Removes what an AtomicFile of a process that was killed left in `folder`; does nothing where
/// there is no such folder. For a folder that no other process writes to.
void removeTemporaries(const std::filesystem::path& folder);

/// The same of processes that no longer run on this machine: for a folder that others may write to
/// at the same time. A process on another machine that shares the folder counts as one that no
/// longer runs.
void removeAbandoned(const std::filesystem::path& folder);

/// All of it at once.
void writeFile(const std::filesystem::path& target, std::string_view bytes, bool overwrite);

}  // namespace softscope
