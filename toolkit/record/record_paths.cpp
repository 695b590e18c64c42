// toolkit/record/record_paths.cpp: paths by their key, and paths within texts.
#include "toolkit/record/record_paths.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "toolkit/record/path_words.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;
/// Path as given, and the name that replaces it.
using KnownPath = std::pair<std::string, std::string>;

constexpr const char* kCommandLine = "command_line";

template <std::size_t N>
bool isAmong(const std::string& key, const char* const (&names)[N]) {
  return std::find(std::begin(names), std::end(names), key) != std::end(names);
}

/// Keys whose texts are paths; below `inputs` all but these two.
bool holdsPath(const std::string& key, bool in_inputs) {
  if (in_inputs) return !isAmong(key, {"sha256", "role"});
  return isAmong(key, {"path", "run", "runs", "sequence", "stereo.model"});
}

bool staysAsItIs(const std::string& key) { return isAmong(key, {"softscope", "machine", "style"}); }

/// Settings of a record that are not paths are kept.
bool staysWithin(const std::string& parent, const std::string& key) {
  return parent == "configuration" && !holdsPath(key, false);
}

std::string recordedName(const std::string& text) {
  fs::path path = fs::path(text).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (path.filename() == "." || path.filename() == "..") {
    std::error_code unreadable;
    path = fs::weakly_canonical(path, unreadable);
    if (unreadable) return "";
  }
  return path.filename().string();
}

/// `visit` receives each text with its key (elements of an array
/// have the key of the array) and whether it is below `inputs`.
template <class Visit>
void forEachText(Json& part, const std::string& key, bool in_inputs, const Visit& visit) {
  if (part.is_string()) visit(part, key, in_inputs);
  if (part.is_array())
    for (Json& element : part) forEachText(element, key, in_inputs, visit);
  if (!part.is_object()) return;
  for (const auto& [name, value] : part.items())
    if (!staysAsItIs(name) && !staysWithin(key, name))
      forEachText(value, name, in_inputs || name == "inputs", visit);
}

bool continuesWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '.' || c == '_' ||
         c == '-';
}

void replaceKnown(const KnownPath& known, std::string& text) {
  const auto& [path, name] = known;
  for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos;) {
    if (at > 0 && continuesWord(text[at - 1])) {
      at += path.size();
      continue;
    }
    text.replace(at, path.size(), name);
    at += name.size();
  }
}

std::string sentence(std::string text, const std::vector<KnownPath>& known) {
  for (const KnownPath& one : known) replaceKnown(one, text);
  return replacePaths(text, [&](const std::string& path) {
    for (const KnownPath& one : known)
      if (path.rfind(one.second + "/", 0) == 0) return path;  // inside a folder of that name
    return recordedName(path);
  });
}

/// Word of a command line: CLIP, --out=FOLDER or KEY=FILE.
std::string commandWord(const std::string& word) {
  const std::size_t path = word.find('=') == std::string::npos ? 0 : word.find('=') + 1;
  if (word.find('/', path) == std::string::npos) return word;
  return word.substr(0, path) + recordedName(word.substr(path));
}

}  // namespace

Json RecordPaths::applyTo(const Json& record) const {
  Json result = record;
  if (keep) return result;
  std::vector<KnownPath> known;
  forEachText(result, "", false, [&](Json& text, const std::string& key, bool in_inputs) {
    if (!holdsPath(key, in_inputs)) return;
    const auto path = text.get<std::string>();
    text = recordedName(path);
    if (path.find('/') != std::string::npos) known.emplace_back(path, recordedName(path));
  });
  std::sort(known.begin(), known.end(), [](const KnownPath& a, const KnownPath& b) {
    return a.first.size() > b.first.size();  // a file before its folder
  });
  forEachText(result, "", false, [&](Json& text, const std::string& key, bool in_inputs) {
    if (in_inputs || holdsPath(key, in_inputs)) return;
    const auto written = text.get<std::string>();
    text = key == kCommandLine ? commandWord(written) : sentence(written, known);
  });
  return result;
}

}  // namespace softscope
