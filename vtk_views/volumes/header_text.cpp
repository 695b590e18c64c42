#include "vtk_views/volumes/header_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/decimal_number.h"
#include "core/error.h"
#include "core/guarded_read.h"
#include "core/nearest_name.h"

namespace softscope {
namespace {

constexpr std::size_t kLongestHeaderLine = 1 << 16;
constexpr int kMostHeaderLines = 4000;

std::string withoutSpaces(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::ifstream openHeader(const std::string& path) {
  requireRegularFile(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": can't be opened; check its rights");
  return file;
}

/// False at the end of the file. Throws for a line that is not text.
bool nextLine(const std::string& path, std::istream& file, std::string& line) {
  line.clear();
  char c = 0;
  while (file.get(c)) {
    if (c == '\n') return true;
    if ((static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\r') ||
        line.size() == kLongestHeaderLine)
      throw InputError(path + ": its header holds bytes that are no text, after " + inQuotes(line) +
                       ". Is it damaged, or of another kind than its name says?");
    line += c;
  }
  return !line.empty();
}

[[noreturn]] void failLine(const std::string& path, const std::string& line) {
  throw InputError(path + ": its header has the line " + inQuotes(line) +
                   ", which says nothing. Is it damaged, or of another kind than its name says?");
}

/// Lower case; without word separators if they are irrelevant.
std::string plainName(const std::string& name, bool joined) {
  std::string plain;
  for (const char c : name)
    if (!joined || (c != ' ' && c != '_' && c != '-'))
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

/// True if two names differ by a typing error or a damaged byte.
bool nearlyEqual(const std::string& name, const std::string& known) {
  constexpr std::size_t kLettersPerSlip = 5, kLongestKey = 100;
  if (name.size() > kLongestKey) return false;
  const int slips = std::max(1, static_cast<int>(known.size() / kLettersPerSlip));
  return editDistance(plainName(name, true), plainName(known, true)) <= slips;
}

bool isAmong(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Name in a message: at most 60 characters, unprintable ones as `?`.
std::string shownKey(const std::string& key) {
  const std::string quoted = inQuotes(key);
  return quoted.substr(1, quoted.size() - 2);
}

/// "a finite number", "3 finite numbers".
std::string countOf(std::size_t count, const std::string& noun) {
  return count == 1 ? "a " + noun : std::to_string(count) + " " + noun + "s";
}

}  // namespace

HeaderText HeaderText::readMetaImage(const std::string& path, const std::string& last_key) {
  HeaderText header;
  header.path_ = path;
  std::ifstream file = openHeader(path);
  std::string line;
  for (int n = 0; n < kMostHeaderLines && nextLine(path, file, line); ++n) {
    const auto at = line.find('=');
    if (withoutSpaces(line).empty()) continue;
    if (at == std::string::npos) failLine(path, line);
    const std::string key = withoutSpaces(line.substr(0, at));
    header.add(key, withoutSpaces(line.substr(at + 1)));
    if (key != last_key) continue;
    file.clear();
    header.end_offset_ = static_cast<std::uintmax_t>(file.tellg());
    return header;
  }
  throw InputError(path + ": the header has no line `" + last_key +
                   "`. Is the file complete, and of the kind its name says?");
}

HeaderText HeaderText::readNrrd(const std::string& path) {
  HeaderText header;
  header.path_ = path;
  std::ifstream file = openHeader(path);
  std::string line;
  if (!nextLine(path, file, line) || line.compare(0, 5, "NRRD0") != 0)
    throw InputError(path + ": does not begin with NRRD0, so it is no NRRD file");
  for (int n = 0; n < kMostHeaderLines && nextLine(path, file, line); ++n) {
    line = withoutSpaces(line);
    if (line.empty()) break;
    if (line[0] == '#') continue;
    const auto at = line.find(':');
    if (at == std::string::npos) failLine(path, line);
    const std::string key = plainName(withoutSpaces(line.substr(0, at)), false);
    if (line.compare(at, 2, ":=") == 0)
      header.notes_.insert(key);
    else
      header.add(key, withoutSpaces(line.substr(at + 1)));
  }
  file.clear();
  header.end_offset_ = static_cast<std::uintmax_t>(file.tellg());
  return header;
}

void HeaderText::add(const std::string& key, const std::string& value) {
  const auto [place, is_new] = fields_.emplace(key, value);
  if (!is_new && place->second != value)
    fail(key, "before, and " + inQuotes(value) + " in a second line; which one is valid?");
}

std::string HeaderText::firstOf(std::initializer_list<const char*> keys) const {
  for (const char* key : keys)
    if (has(key)) return key;
  return {};
}

const std::string& HeaderText::text(const std::string& key) const {
  const auto found = fields_.find(key);
  if (found == fields_.end())
    throw InputError(path_ + ": the header has no line `" + key +
                     "`. Is the file complete, and of the kind its name says?");
  return found->second;
}

std::string HeaderText::textOr(const std::string& key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

std::vector<double> HeaderText::numbers(const std::string& key, std::size_t count) const {
  const std::vector<double> values = finiteNumbers(text(key));
  if (values.size() != count) fail(key, "but must be " + countOf(count, "finite number"));
  return values;
}

std::vector<std::int64_t> HeaderText::wholes(const std::string& key, std::size_t count,
                                             std::int64_t least, std::int64_t most) const {
  std::vector<std::int64_t> values;
  for (const double value : numbers(key, count)) {
    if (value != std::floor(value) || value < double(least) || value > double(most))
      fail(key, least == most ? "but must be " + std::to_string(least)
                              : "but must be " + countOf(count, "whole number") + " from " +
                                    std::to_string(least) + " to " + std::to_string(most));
    values.push_back(static_cast<std::int64_t>(value));
  }
  return values;
}

bool HeaderText::flagOr(const std::string& key, bool otherwise) const {
  if (!has(key)) return otherwise;
  const std::string& value = text(key);
  for (const char* yes : {"True", "true", "TRUE", "1"})
    if (value == yes) return true;
  for (const char* no : {"False", "false", "FALSE", "0"})
    if (value == no) return false;
  fail(key, "but must be True or False");
}

std::vector<std::string> HeaderText::unknownKeys(const std::vector<std::string>& read,
                                                 const std::vector<std::string>& harmless) const {
  std::vector<std::string> unknown;
  for (const auto& [key, value] : fields_) {
    if (isAmong(read, key) || isAmong(harmless, key)) continue;
    for (const std::string& meant : read)
      if (nearlyEqual(key, meant))
        throw InputError(path_ + ": the header has the line `" + shownKey(key) + "`, but `" +
                         meant +
                         "` is expected. Correct the line, or remove it where it means nothing");
    unknown.push_back(shownKey(key));
  }
  return unknown;
}

void HeaderText::requireKnownKeys(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : fields_) {
    if (isAmong(known, key)) continue;
    const std::string nearest = nearestName(key, known);
    throw InputError(path_ + ": the header has the line `" + shownKey(key) +
                     "`, which is no field of its format" +
                     (nearest.empty() ? "." : "; is `" + nearest + "` meant?") +
                     " Correct the line, or write a note as `key:=value`");
  }
  for (const std::string& note : notes_)
    if (isAmong(known, note) && !has(note))
      throw InputError(path_ + ": the header has the note `" + note + ":=`, but the field `" +
                       note + ":` is expected. Write it without the equals sign");
}

void HeaderText::fail(const std::string& key, const std::string& complaint) const {
  throw InputError(path_ + ": `" + key + "` is " + inQuotes(textOr(key, "")) + ", " + complaint);
}

std::vector<double> finiteNumbers(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = decimalNumber<double>(word);
    if (!value || !std::isfinite(*value)) return {};
    values.push_back(*value);
  }
  return values;
}

std::string inQuotes(const std::string& text) {
  constexpr std::size_t kLongestQuote = 60;
  std::string shown_text = text.substr(0, kLongestQuote);
  for (char& c : shown_text)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
  return "\"" + shown_text + (text.size() > kLongestQuote ? "…\"" : "\"");
}

}  // namespace softscope
