// src/core/nearest_name.h: nearest known name of a misspelt name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Number of insertions, deletions, substitutions and swaps of neighbours between `a` and `b`.
int editDistance(std::string_view a, std::string_view b);

/// Nearest known name, by letters or by its last part after a dot; the
/// first of equals. Empty if more than a third of the letters differ.
std::string nearestName(std::string_view name, const std::vector<std::string>& known);

}  // namespace softscope
