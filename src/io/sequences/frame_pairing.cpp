#include "io/sequences/frame_pairing.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>

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

/// A file whose name is unlike the others, and why.
struct OddFile {
  fs::path file;
  std::string why;
};

/// Of files most of which have numbers: the first without one, or with that of an earlier one.
std::optional<OddFile> firstOdd(const Files& files) {
  std::map<long long, fs::path> numbered;
  if (2 * numbersOf(files).size() <= files.size()) return std::nullopt;
  for (const fs::path& file : files) {
    const auto number = frameNumber(file);
    if (!number) return OddFile{file, "has no number in its name, unlike the others"};
    const auto [earlier, is_new] = numbered.emplace(*number, file);
    if (!is_new)
      return OddFile{file, "has the number of " + earlier->second.filename().string() + ", " +
                               std::to_string(*number)};
  }
  return std::nullopt;
}

/// Throws for one odd file in either view.
void requireNoOddFile(const ViewFiles& view, const ViewFiles& other) {
  for (const ViewFiles* each : {&view, &other}) {
    const auto odd = firstOdd(each->files);
    if (!odd) continue;
    throw InputError(say(shown(odd->file), ": ", odd->why, ", and the counts differ (", view.count,
                         " files in ", shown(view.path), ", ", other.count, " in ",
                         shown(other.path), "). Move it to another folder."));
  }
}

/// "Convert ..." for videos of different rates, else "Cut ...".
std::string adviceFor(const ViewFiles& view, const ViewFiles& other) {
  if (view.rate_hz <= 0 || other.rate_hz <= 0 || view.rate_hz == other.rate_hz)
    return "Cut both to the same frames.";
  return say("Their rates differ, ", other.rate_hz, " and ", view.rate_hz,
             " frames per second: export both at one rate from the same start.");
}

}  // namespace

void requirePartners(const ViewFiles& view, const ViewFiles& other) {
  if (allNumbered(view.files) && allNumbered(other.files)) requireSameNumbers(view, other);
  if (view.count == other.count) return;
  requireNoOddFile(view, other);
  throw InputError(say(shown(other.path), ": has ", other.count, " frames, but ", shown(view.path),
                       " has ", view.count, ". ", adviceFor(view, other)));
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
