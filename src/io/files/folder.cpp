#include "io/files/folder.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <system_error>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Run of digits at `begin` without leading zeros; advances `begin`.
std::string_view takeNumber(std::string_view text, std::size_t& begin) {
  std::size_t end = begin;
  while (end < text.size() && isDigit(text[end])) ++end;
  std::string_view run = text.substr(begin, end - begin);
  begin = end;
  while (run.size() > 1 && run.front() == '0') run.remove_prefix(1);
  return run;
}

}  // namespace

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool isFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

void requireFolder(const fs::path& folder) {
  std::error_code code;
  const fs::file_status status = fs::status(folder, code);
  if (code == std::errc::too_many_symbolic_link_levels)
    throw InputError(shown(folder) +
                     ": a symbolic link that leads back to itself. Point it at a folder.");
  if (status.type() == fs::file_type::not_found)
    throw InputError(shown(folder) + ": there is no such folder. Check the path.");
  if (!fs::is_directory(status))
    throw InputError(shown(folder) + ": a file, but a folder is expected.");
}

bool naturallyBefore(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (isDigit(a[i]) && isDigit(b[j])) {
      const std::string_view left = takeNumber(a, i), right = takeNumber(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // equal except for leading zeros
}

std::vector<fs::path> existingIn(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> found;
  for (const std::string& name : names)
    if (isThere(folder / name)) found.push_back(folder / name);
  return found;
}

std::vector<fs::path> filesIn(const fs::path& folder,
                              const std::vector<std::string_view>& extensions) {
  requireFolder(folder);
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const fs::path& path = it->path();
    if (path.filename().string().front() == '.') continue;
    const std::string kind = lowerCase(path.extension().string());
    if (std::find(extensions.begin(), extensions.end(), kind) == extensions.end()) continue;
    std::error_code status_code;
    const fs::file_status status = fs::status(path, status_code);
    if (fs::is_directory(status)) continue;
    if (!fs::is_regular_file(status)) requireFile(path);  // throws with the reason
    files.push_back(path);
  }
  if (code) throw InputError(say(shown(folder), ": can't be listed: ", code.message(), "."));
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturallyBefore(a.filename().string(), b.filename().string());
  });
  return files;
}

std::string numberedName(int frame, const std::string& end) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%06d", frame);
  return digits + end;
}

std::optional<long long> frameNumber(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::size_t end = stem.size();
  while (end > 0 && !isDigit(stem[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && isDigit(stem[begin - 1])) --begin;
  long long value = 0;
  const auto result = std::from_chars(stem.data() + begin, stem.data() + end, value);
  if (begin == end || result.ec != std::errc()) return std::nullopt;
  return value;
}

}  // namespace softscope
