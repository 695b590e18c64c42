#include "io/files/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failStatus(const fs::path& file, const std::error_code& code) {
  if (code == std::errc::too_many_symbolic_link_levels)
    throw InputError(shown(file) +
                     ": a symbolic link that leads back to itself. Point it at a file.");
  throw InputError(
      say(shown(file), ": can't be looked at: ", code.message(), ". Check its rights."));
}

}  // namespace

void requireFile(const fs::path& file) {
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (status.type() == fs::file_type::not_found)
    throw InputError(shown(file) + ": there is no such file. Check the path.");
  if (code) failStatus(file, code);
  if (fs::is_directory(status))
    throw InputError(shown(file) + ": a folder, but a file is expected. Give the file inside it.");
  if (!fs::is_regular_file(status))
    throw InputError(shown(file) + ": a device or pipe, but a regular file is expected.");
  const std::uintmax_t size = fs::file_size(file, code);
  if (code) failStatus(file, code);
  if (size == 0) throw InputError(shown(file) + ": the file is empty. Copy or export it again.");
}

std::string readBytes(const fs::path& file, std::uintmax_t limit_bytes) {
  requireFile(file);
  const std::uintmax_t size = fs::file_size(file);
  if (size > limit_bytes)
    throw InputError(say(shown(file), ": ", size >> 20, " MB, but at most ", limit_bytes >> 20,
                         " MB are expected of such a file. Is it the right one?"));
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw InputError(say(shown(file), ": can't be read: ", std::strerror(errno), "."));
  return bytes;
}

std::string readText(const fs::path& file, std::uintmax_t limit_bytes) {
  return std::string(utf8Text(readBytes(file, limit_bytes), shown(file)));
}

}  // namespace softscope
