#include "io/calibrations/misspelt_key.h"

#include <algorithm>

#include "core/nearest_name.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

using KeyNames = std::vector<std::string_view>;

constexpr std::size_t kShortestKey = 4;  // shorter ones resemble too many others
constexpr std::size_t kLongestKey = 40;  // limit of the work
constexpr std::size_t kLongName = 11;

std::vector<std::string_view> unknownKeys(const std::vector<Document>& documents,
                                          const KeyNames& known) {
  std::vector<std::string_view> unknown;
  for (const Document& document : documents)
    for (const auto& [key, value] : document.members)
      if (std::find(known.begin(), known.end(), key) == known.end()) unknown.push_back(key);
  return unknown;
}

bool isMisspelling(std::string_view key, std::string_view name) {
  if (key.size() < kShortestKey || key.size() > kLongestKey) return false;
  const std::string found = lowerCase(key), expected = lowerCase(name);
  return found.front() == expected.front() &&
         editDistance(found, expected) <= (expected.size() < kLongName ? 1 : 2);
}

bool namesDistortion(std::string_view key) {
  const std::string name = lowerCase(key);
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  return name == "k1" ||
         ((has("distort") || has("distcoef") || has("dist_coef")) && !has("model") && !has("type"));
}

}  // namespace

std::string misspeltKey(const std::vector<Document>& documents, const KeyNames& names,
                        const KeyNames& known) {
  for (const std::string_view key : unknownKeys(documents, known))
    for (const std::string_view name : names)
      if (isMisspelling(key, name))
        return say(excerpt(key), " is not a known key; is `", name, "` meant?");
  return {};
}

std::string unreadLensKeys(const std::vector<Document>& documents, const KeyNames& known) {
  std::string keys;
  for (const std::string_view key : unknownKeys(documents, known))
    if (namesDistortion(key)) keys += (keys.empty() ? "" : ", ") + excerpt(key);
  return keys;
}

}  // namespace softscope
