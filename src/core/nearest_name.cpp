#include "core/nearest_name.h"

#include <algorithm>

namespace softscope {
namespace {

// Limit of the work; longer names are not misspellings.
constexpr std::size_t kLongestName = 200;

std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string_view lastPart(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

int allowed(std::string_view name) { return std::max(2, static_cast<int>(name.size()) / 3); }

}  // namespace

int editDistance(std::string_view a, std::string_view b) {
  // Optimal string alignment with three rows of the table.
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

std::string nearestName(std::string_view name, const std::vector<std::string>& known) {
  if (name.size() > kLongestName) return {};
  const std::string wanted = lowerCase(name);
  const std::string_view wanted_part = lastPart(wanted);
  std::string best;
  int best_distance = 1 << 20;
  for (const std::string& candidate : known) {
    const std::string lower = lowerCase(candidate);
    const int whole = editDistance(wanted, lower);
    // A correct last part with a wrong or missing first part counts like two wrong letters.
    const int part = editDistance(wanted_part, lastPart(lower)) + 2;
    const int distance = std::min(whole <= allowed(wanted) ? whole : 1 << 20,
                                  part - 2 <= allowed(wanted_part) ? part : 1 << 20);
    if (distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

}  // namespace softscope
