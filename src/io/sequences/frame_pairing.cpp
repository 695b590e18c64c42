#include "io/sequences/frame_pairing.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

std::set<long long> numbersOf(const Files& files) {
  std::set<long long> out;
  for (const fs::path& file : files)
    if (const auto number = frameNumber(file)) out.insert(*number);
  return out;
}

bool allNumbered(const Files& files) {
  return !files.empty() && numbersOf(files).size() == files.size();
}

/// First file whose number is missing in `others`; empty if none.
fs::path firstAlone(const Files& files, const Files& others) {
  const std::set<long long> numbers = numbersOf(others);
  const auto alone = std::find_if(files.begin(), files.end(), [&](const fs::path& file) {
    return numbers.count(*frameNumber(file)) == 0;
  });
  return alone == files.end() ? fs::path() : *alone;
}

void requireSameNumbers(const ViewFiles& view, const ViewFiles& other) {
  if (view.count == 1 && other.count == 1) return;  // two single images of any name
  fs::path alone = firstAlone(view.files, other.files);
  const bool in_view = !alone.empty();
  if (!in_view) alone = firstAlone(other.files, view.files);
  if (alone.empty()) return;
  throw InputError(say(shown(alone), ": has no partner of the same number in ",
                       shown(in_view ? other.path : view.path), " (", view.count, " files in ",
                       shown(view.path), ", ", other.count, " in ", shown(other.path),
                       "). Add it or remove this one."));
}

}  // namespace

void requirePartners(const ViewFiles& view, const ViewFiles& other) {
  if (allNumbered(view.files) && allNumbered(other.files)) requireSameNumbers(view, other);
  if (view.count != other.count)
    throw InputError(say(shown(other.path), ": has ", other.count, " frames, but ",
                         shown(view.path), " has ", view.count, ". Cut both to the same frames."));
}

std::vector<fs::path> partnersIn(const fs::path& path, const std::vector<std::string_view>& kinds,
                                 const ViewFiles& view) {
  std::error_code code;
  Files files;
  if (fs::is_directory(path, code)) {
    files = filesIn(path, kinds);
  } else {
    requireFile(path);
    files = {path};
  }
  requirePartners(view, {path, files, static_cast<int>(files.size())});
  return files;
}

}  // namespace softscope
