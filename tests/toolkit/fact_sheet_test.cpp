// tests/toolkit/fact_sheet_test.cpp: the same facts as lines and as JSON.
#include "toolkit/record/fact_sheet.h"

#include <gmock/gmock.h>

#include "toolkit/record/json_text.h"

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

TEST(FactSheet, NoControlCharacterReachesATerminal) {
  const std::string name =
      "a\x1b[2J\nb\x7f\xc2\x9b"
      "31m\xc3\xa9";
  FactSheet facts(name);
  facts.add(name, "name", name);
  facts.warn(name);
  facts.missing(name);
  facts.fail(name);
  const std::string shown = "a?[2J?b??31m\xc3\xa9";
  EXPECT_EQ(facts.text(), shown + "\n  " + shown + "  " + shown + "\n  error: " + shown +
                              "\n  warning: " + shown + "\n  missing: " + shown + "\n");
  const std::string json = jsonText(facts.json());
  for (const char* control : {"\x1b", "\x7f", "\xc2\x9b"})
    EXPECT_EQ(json.find(control), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(json)["name"], name);
}

TEST(FactSheet, NumbersThatAreNoneBecomeNull) {
  FactSheet facts("title");
  facts.addQuietly("depth_mm", std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(nlohmann::json::parse(jsonText(facts.json()))["depth_mm"].is_null());
}

}  // namespace
}  // namespace softscope
