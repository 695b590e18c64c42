// toolkit/record/path_words.cpp: recognition of paths with blanks.
#include "toolkit/record/path_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <vector>

#include "io/text/text_lines.h"

namespace softscope {
namespace {

/// Part [begin, end) of a text, without surrounding punctuation.
struct Word {
  std::size_t begin = 0, end = 0;
  std::string core;
  char after = ' ';  // following character
};

template <std::size_t N>
bool isOneOf(const std::string& word, const std::array<const char*, N>& names) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

bool isUnit(const std::string& word) {
  constexpr std::array<const char*, 14> kUnits{
      "mm/s",     "um/s",     "px/s",     "deg/s",     "rad/s", "frames/s",     "mm/frame",
      "um/frame", "px/frame", "ms/frame", "deg/frame", "1/mm",  "mm\xC2\xB2/s", "\xC2\xB5m/s"};
  return isOneOf(word, kUnits) || word == "and/or" || word == "LPS/RAS";
}

/// File names of softscope contain no personal data.
bool isSoftscopeFile(const std::string& word) {
  constexpr std::array<const char*, 7> kOurs{
      "tracks.csv",     "frames.csv",       "model.ply",        "run.json",
      "trajectory.txt", "track_points.csv", "models/NNNNNN.ply"};
  return isOneOf(word, kOurs);
}

bool hasFileEnding(const std::string& word) {
  constexpr std::array<const char*, 23> kEndings{".ply",  ".stl", ".obj", ".vtp",  ".vtk",  ".csv",
                                                 ".txt",  ".png", ".jpg", ".jpeg", ".dcm",  ".nii",
                                                 ".json", ".mp4", ".avi", ".gz",   ".yaml", ".yml",
                                                 ".nrrd", ".mha", ".tif", ".tiff", ".bmp"};
  const std::string lower = lowerCase(word);
  return std::any_of(kEndings.begin(), kEndings.end(), [&](const std::string& ending) {
    return lower.size() > ending.size() &&
           lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0;
  });
}

bool namesFile(const std::string& word) {
  if (isSoftscopeFile(word) || isUnit(word)) return false;
  if (word == "/" || word == "\\") return false;
  return word.find_first_of("/\\") != std::string::npos || hasFileEnding(word);
}

bool isAbsolute(const std::string& word) {
  if (word.size() < 2) return false;
  const bool drive = std::isalpha(static_cast<unsigned char>(word[0])) != 0 && word[1] == ':';
  return word[0] == '/' || word[0] == '\\' || word.rfind("~/", 0) == 0 ||
         (drive && word.size() > 2) || word.rfind("file:", 0) == 0;
}

/// Typical start of personal names and of visit numbers.
bool couldBeName(const std::string& word) {
  const auto first = static_cast<unsigned char>(word.empty() ? 'a' : word[0]);
  return first >= 0x80 || std::isupper(first) != 0 || std::isdigit(first) != 0;
}

std::vector<Word> wordsIn(const std::string& text) {
  std::vector<Word> words;
  std::size_t at = 0;
  const auto blank = [&](std::size_t i) {
    return std::isspace(static_cast<unsigned char>(text[i])) != 0;
  };
  while (at < text.size()) {
    while (at < text.size() && blank(at)) ++at;
    std::size_t end = at;
    while (end < text.size() && !blank(end)) ++end;
    if (end == at) break;
    const std::string raw = text.substr(at, end - at);
    const std::size_t first = raw.find_first_not_of("('\"`["),
                      last = raw.find_last_not_of(".,:;)'\"`]");
    if (first != std::string::npos && last != std::string::npos && first <= last)
      words.push_back({at + first, at + last + 1, raw.substr(first, last + 1 - first),
                       last + 1 < raw.size() ? raw[last + 1] : ' '});
    at = end;
  }
  return words;
}

bool endsClause(const Word& word) {
  return word.after == ':' || word.after == ';' || word.after == '`' || word.after == '"';
}

/// Words [first, last] of one name.
struct Span {
  std::size_t first, last;
};

/// Extent of the name that contains word `at`, the first word of its clause that resembles a file.
Span spanAround(const std::vector<Word>& words, std::size_t clause_begin, std::size_t at) {
  std::size_t end = at;
  while (end + 1 < words.size() && !endsClause(words[end])) ++end;
  Span span{at, at};
  for (std::size_t i = at; i <= end; ++i)
    if (namesFile(words[i].core)) span.last = i;
  const bool closed = endsClause(words[end]);
  if (closed && isAbsolute(words[at].core)) span.last = end;
  while (span.last < end && words[span.last].after == ' ' && couldBeName(words[span.last + 1].core))
    ++span.last;
  if (isAbsolute(words[at].core)) return span;
  if (closed && span.last == end) span.first = clause_begin;
  while (span.first > clause_begin && words[span.first - 1].after == ' ' &&
         couldBeName(words[span.first - 1].core))
    --span.first;
  return span;
}

std::vector<Span> spansOf(const std::vector<Word>& words) {
  std::vector<Span> spans;
  std::size_t clause_begin = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (namesFile(words[i].core)) {
      spans.push_back(spanAround(words, clause_begin, i));
      i = spans.back().last;
      clause_begin = i + 1;
    }
    if (endsClause(words[i])) clause_begin = i + 1;
  }
  return spans;
}

void replaceAll(const std::string& what, const std::string& by, std::string& text) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

}  // namespace

std::string replacePaths(const std::string& text,
                         const std::function<std::string(const std::string&)>& instead) {
  const std::vector<Word> words = wordsIn(text);
  std::string out;
  std::size_t done = 0;
  for (const Span& span : spansOf(words)) {
    const std::size_t begin = words[span.first].begin, end = words[span.last].end;
    out += text.substr(done, begin - done) + instead(text.substr(begin, end - begin));
    done = end;
  }
  return out + text.substr(done);
}

std::string withoutFolders(std::string text, const std::string& folder) {
  namespace fs = std::filesystem;
  const std::string absolute = fs::absolute(folder).lexically_normal().string();
  for (const std::string& known : {absolute, folder})
    if (!known.empty()) replaceAll(known.back() == '/' ? known : known + "/", "", text);
  return replacePaths(text, [](const std::string& path) {
    return isAbsolute(path) ? fs::path(path).filename().string() : path;
  });
}

}  // namespace softscope
