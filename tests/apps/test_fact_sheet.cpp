// tests/apps/test_fact_sheet.cpp: the same facts as lines and as JSON.
#include <gmock/gmock.h>

#include "apps/fact_sheet.h"
#include "apps/result_output.h"

namespace softscope {
namespace {

TEST(FactSheet, DotsMakeNestedJson) {
  FactSheet facts("title");
  facts.add("baseline", "5.2 mm", "calibration.baseline_mm", 5.2);
  facts.add("frames", "frames", 63);
  facts.warn("odd");
  const auto json = facts.json();
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["calibration"]["baseline_mm"], 5.2);
  EXPECT_EQ(json["warnings"][0], "odd");
  EXPECT_TRUE(json["missing"].empty());
  EXPECT_EQ(facts.text(), "title\n  baseline  5.2 mm\n  frames    63\n  warning: odd\n");
}

TEST(FactSheet, BytesThatAreNoUtf8StillMakeJson) {
  FactSheet facts("title");
  facts.add("file", "file", "caf\xe9.png");
  EXPECT_TRUE(nlohmann::json::accept(jsonText(facts.json())));
}

TEST(FactSheet, NumbersThatAreNoneBecomeNull) {
  FactSheet facts("title");
  facts.addQuietly("depth_mm", std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(nlohmann::json::parse(jsonText(facts.json()))["depth_mm"].is_null());
}

}  // namespace
}  // namespace softscope
