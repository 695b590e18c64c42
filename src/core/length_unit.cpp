#include "core/length_unit.h"

#include <cctype>
#include <cmath>

namespace softscope {
namespace {

bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }

std::string_view wordAt(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && isLetter(text[end])) ++end;
  return text.substr(begin, end - begin);
}

}  // namespace

std::optional<LengthUnit> lengthUnitNamed(std::string_view name) {
  if (name == "mm") return LengthUnit{"mm", 1};
  if (name == "cm") return LengthUnit{"cm", 10};
  if (name == "m") return LengthUnit{"m", 1000};
  return std::nullopt;
}

double unitOfFileMm(double requested_mm, std::string_view header) {
  if (!std::isnan(requested_mm)) return requested_mm;
  constexpr std::string_view kKey = "unit ";
  for (std::size_t at = header.find(kKey); at != std::string_view::npos;
       at = header.find(kKey, at + 1)) {
    if (at > 0 && isLetter(header[at - 1])) continue;
    if (const auto unit = lengthUnitNamed(wordAt(header, at + kKey.size()))) return unit->mm;
  }
  return 1;
}

void toMillimetres(double unit_mm, std::vector<Eigen::Vector3f>* positions) {
  if (unit_mm == 1) return;
  for (Eigen::Vector3f& p : *positions) p = (p.cast<double>() * unit_mm).cast<float>();
}

}  // namespace softscope
