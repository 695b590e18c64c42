#include "core/length_unit.h"

#include <cctype>
#include <cmath>

namespace softscope {
namespace {

const LengthUnit kUnits[] = {{"mm", 1}, {"cm", 10}, {"m", 1000}};

bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }

std::string_view wordAt(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && isLetter(text[end])) ++end;
  return text.substr(begin, end - begin);
}

}  // namespace

double unitOfFileMm(double requested_mm, std::string_view header) {
  if (!std::isnan(requested_mm)) return requested_mm;
  constexpr std::string_view kKey = "unit ";
  for (std::size_t at = header.find(kKey); at != std::string_view::npos;
       at = header.find(kKey, at + 1)) {
    if (at > 0 && isLetter(header[at - 1])) continue;
    for (const LengthUnit& unit : kUnits)
      if (wordAt(header, at + kKey.size()) == unit.name) return unit.mm;
  }
  return 1;
}

}  // namespace softscope
