#include "toolkit/run/repeated_warnings.h"

#include <gtest/gtest.h>

#include <vector>

namespace softscope {
namespace {

TEST(RepeatedWarnings, TellsTheFirstOfAKindAndCountsTheOthers) {
  std::vector<std::string> told;
  RepeatedWarnings warnings([&](const std::string& text) { told.push_back(text); });
  warnings.add("lost", 3, "lost: no pose");
  warnings.add("blurred", 4, "blurred: much");
  for (int frame = 5; frame < 9; ++frame) warnings.add("lost", frame, "lost: no pose");
  EXPECT_EQ(told, (std::vector<std::string>{"frame 3: lost: no pose", "frame 4: blurred: much"}));
  warnings.conclude("a table has each");
  ASSERT_EQ(told.size(), 3u) << "nothing of what came once";
  EXPECT_EQ(told[2], "lost: 4 more frames, 5 to 8; a table has each");
}

TEST(RepeatedWarnings, TellsTheLastReasonWhereNoFileHasThem) {
  std::vector<std::string> told;
  RepeatedWarnings warnings([&](const std::string& text) { told.push_back(text); });
  for (int frame = 0; frame < 3; ++frame)
    warnings.add("lost", frame, "lost: " + std::to_string(frame) + " pairs");
  warnings.conclude("");
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[1], "lost: 2 more frames, 1 to 2; the last: lost: 2 pairs");
}

}  // namespace
}  // namespace softscope
