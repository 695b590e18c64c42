// src/core/nearest_name.h: nearest known name of a misspelt one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
int editDistance(std::string_view a, std::string_view b);

/// The known name that is nearest, in letters or by its last part after a dot; the first of equals.
/// Empty where none is near: more than a third of the letters would have to change.
std::string nearestName(std::string_view name, const std::vector<std::string>& known);

}  // namespace softscope
