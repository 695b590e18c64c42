// tests/toolkit/records.h: records as their files hold them.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "toolkit/evaluation/thresholds.h"
#include "toolkit/record/json_text.h"

namespace softscope::test {

using Json = nlohmann::json;

/// As it is written and read again: NaN is null.
inline Json written(const FactSheet::Json& record) { return Json::parse(jsonText(record)); }

/// What --fail-if makes of these limits.
inline std::vector<Threshold> limits(const std::vector<std::string>& texts) {
  std::vector<Threshold> thresholds;
  for (const std::string& text : texts) thresholds.push_back(parseThreshold(text));
  return thresholds;
}

}  // namespace softscope::test
