// src/io/files/file_lock.cpp: open file description locks of Linux, whose state can be queried.
#include "io/files/file_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace softscope {
namespace {

struct flock wholeFile() {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return whole;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file)
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool FileLock::tryToHold() const {
  struct flock whole = wholeFile();
  return descriptor_ < 0 || fcntl(descriptor_, F_OFD_SETLK, &whole) == 0 ||
         (errno != EAGAIN && errno != EACCES);
}

bool isHeld(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock whole = wholeFile();
  const bool told = fcntl(descriptor, F_OFD_GETLK, &whole) == 0;
  close(descriptor);
  return told && whole.l_type != F_UNLCK;
}

}  // namespace softscope
