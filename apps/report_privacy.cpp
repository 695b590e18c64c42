// apps/report_privacy.cpp: known paths by their role, others by their looks.
#include "apps/report_privacy.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "apps/report_case.h"
#include "io/text_lines.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Where `what` stands alone; a plain word ("run") only where a colon or slash shows that it is a
/// path.
void replaceInput(const std::string& what, const std::string& role, std::string& text) {
  if (what.empty()) return;
  const bool plain = what.find_first_of("/\\.") == std::string::npos;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos;) {
    const std::size_t end = at + what.size();
    const char before = at == 0 ? ' ' : text[at - 1], after = end < text.size() ? text[end] : ' ';
    const bool alone = !isWordLetter(before) && !isWordLetter(after);
    if (!alone || (plain && after != ':' && after != '/')) {
      at = end;
      continue;
    }
    text.replace(at, what.size() + (after == '/' ? 1 : 0), after == '/' ? role + ": " : role);
    at += role.size();
  }
}

/// mm/s, um/frame: letters around one slash.
bool isUnit(const std::string& word) {
  const auto slash = word.find('/');
  return slash != 0 && slash + 1 < word.size() && slash <= 3 && word.size() <= slash + 7 &&
         std::all_of(word.begin(), word.end(),
                     [](unsigned char c) { return c == '/' || std::isalpha(c) != 0; }) &&
         std::count(word.begin(), word.end(), '/') == 1;
}

/// What softscope itself calls its files tells nothing of anyone.
bool isOurName(const std::string& word) {
  constexpr std::array<const char*, 7> kOurs{
      "tracks.csv",     "frames.csv",       "model.ply",        "run.json",
      "trajectory.txt", "track_points.csv", "models/NNNNNN.ply"};
  return std::find(kOurs.begin(), kOurs.end(), word) != kOurs.end();
}

bool namesFile(const std::string& word) {
  if (isOurName(word)) return false;
  if (word.find_first_of("/\\") != std::string::npos) return !isUnit(word);
  constexpr std::array<const char*, 15> kEndings{".ply", ".stl",  ".obj", ".vtp", ".vtk",
                                                 ".csv", ".txt",  ".png", ".jpg", ".dcm",
                                                 ".nii", ".json", ".mp4", ".gz",  ".yaml"};
  const std::string lower = lowerCase(word);
  return std::any_of(kEndings.begin(), kEndings.end(), [&](const std::string& ending) {
    return lower.size() > ending.size() &&
           lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0;
  });
}

/// Without the punctuation behind it, which stays.
std::string hidden(const std::string& word) {
  const std::size_t end = word.find_last_not_of(".,:;)'\"`");
  const std::string core = word.substr(0, end == std::string::npos ? 0 : end + 1);
  return namesFile(core) ? "[file]" + word.substr(core.size()) : word;
}

Json cleaned(const Json& part, const Json& record) {
  if (part.is_string()) return withoutPaths(part.get<std::string>(), record);
  Json result = part;
  if (part.is_structured())
    for (const auto& [key, value] : part.items())
      (part.is_array() ? result[std::stoul(key)] : result[key]) = cleaned(value, record);
  return result;
}

}  // namespace

std::string withoutPaths(std::string text, const Json& record) {
  using Role = std::pair<const char*, const char*>;
  for (const auto& [key, role] : {Role{"inputs.run", "the run"}, Role{"inputs.test", "the model"},
                                  Role{"inputs.reference", "the reference"}}) {
    replaceInput(textAt(record, key), role, text);
  }
  std::string out, word;
  for (const char c : text + ' ') {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      word += c;
      continue;
    }
    out += hidden(word) + c;
    word.clear();
  }
  out.pop_back();
  return out;
}

Json withoutPaths(const Json& record) {
  Json result = record;
  result.erase("inputs");
  return cleaned(result, record);
}

}  // namespace softscope
