// src/io/calibrations/misspelt_key.h: keys of a calibration that are probably misspelt.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/documents/document.h"

namespace softscope {

/// Key that is not among `known` and differs by one letter from one of `names`, or by two from a
/// long one, with the same first letter: a sentence with both. Empty if there is none. Keys of
/// other programs are mostly no misspellings.
std::string misspeltKey(const std::vector<Document>& documents,
                        const std::vector<std::string_view>& names,
                        const std::vector<std::string_view>& known);

/// Keys named like lens distortion that are not among `known`: "`distortion1`, `distortion2`".
std::string unreadLensKeys(const std::vector<Document>& documents,
                           const std::vector<std::string_view>& known);

}  // namespace softscope
