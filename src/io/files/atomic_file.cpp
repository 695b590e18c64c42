#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <regex>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target) {
  throw OptionError(
      shown(target) +
      ": exists already and is not overwritten. Choose another name or give `overwrite=`.");
}

/// Unique over all threads and processes.
fs::path temporaryBeside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() /
         say(".", target.filename().string(), ".", ::getpid(), "-", counter++, ".part");
}

/// Renames; fails with EEXIST if the target exists and `overwrite` is false.
int renameTo(const fs::path& from, const fs::path& to, bool overwrite) {
  if (overwrite) return ::rename(from.c_str(), to.c_str());
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return -1;
  // Fallback for file systems without this operation.
  if (fs::exists(fs::symlink_status(to))) {
    errno = EEXIST;
    return -1;
  }
  return ::rename(from.c_str(), to.c_str());
}

/// Process id in ".NAME.PROCESS-NUMBER.part", as created by temporaryBeside(),
/// or in ".NAME.PROCESS.part.END" of a video; 0 for other names.
pid_t writerOf(const std::string& name) {
  static const std::regex kTemporary(R"(\..+\.(\d{1,9})(-\d+\.part|\.part\.\w+))");
  std::smatch parts;
  return std::regex_match(name, parts, kTemporary) ? std::stoi(parts[1]) : 0;
}

bool runsHere(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

std::vector<fs::path> temporariesIn(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored))
    if (entry->is_regular_file(ignored) && writerOf(entry->path().filename().string()) > 0)
      found.push_back(entry->path());
  return found;
}

}  // namespace

void removeTemporaries(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : temporariesIn(folder)) fs::remove(file, ignored);
}

void removeAbandoned(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : temporariesIn(folder))
    if (!runsHere(writerOf(file.filename().string()))) fs::remove(file, ignored);
}

void requireWritable(const fs::path& target, bool overwrite) {
  std::error_code code;
  const fs::file_status status = fs::status(target, code);
  if (fs::is_directory(status))
    throw OptionError(shown(target) + ": is a folder, but a file is to be written there.");
  if (!overwrite && fs::exists(fs::symlink_status(target, code))) refuse(target);
}

AtomicFile::AtomicFile(fs::path target, bool overwrite)
    : target_(std::move(target)), temporary_(temporaryBeside(target_)), overwrite_(overwrite) {
  requireWritable(target_, overwrite);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("can't be written");
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("can't be written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("can't be written");
  if (renameTo(temporary_, target_, overwrite_) != 0) {
    if (errno == EEXIST) refuse(target_);
    fail("can't be given its name");
  }
  temporary_.clear();
}

void AtomicFile::fail(const char* what) const {
  const int code = errno;
  throw Error(say(shown(target_), ": ", what, ": ", std::strerror(code), ". ",
                  code == ENOSPC  ? "Free some space."
                  : code == EFBIG ? "Raise the limit of file sizes (ulimit -f)."
                                  : "Check the folder and its rights."));
}

void writeFile(const fs::path& target, std::string_view bytes, bool overwrite) {
  AtomicFile file(target, overwrite);
  file.write(bytes);
  file.commit();
}

}  // namespace softscope
