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

}  // namespace
}  // namespace softscope
