// tests/toolkit/run_tables_test.cpp: lines fit their headings, for any content.
#include "toolkit/run/run_tables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "tests/io/temporary_folder.h"

namespace softscope {
namespace {

/// Commas outside of quotes.
int cells(const std::string& line) {
  int count = 1;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++count;
  }
  return count;
}

TEST(RunTables, EveryLineHasTheHeadingsCells) {
  for (const FrameStatus status :
       {FrameStatus::kStarted, FrameStatus::kFused, FrameStatus::kRecovered,
        FrameStatus::kSkippedDepth, FrameStatus::kLost, FrameStatus::kSkippedResidual,
        FrameStatus::kUnconfirmed, FrameStatus::kUnreadable, FrameStatus::kUnpaired}) {
    FrameRecord record;
    record.status = status;
    record.reason = "a \"quoted\", torn\nreason";
    const std::string line = framesCsvLine(record);
    EXPECT_EQ(cells(line), cells(framesCsvHeading())) << toString(status);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << "one line a frame";
  }
}

TEST(RunTables, WhatIsUnknownIsEmptyOrNan) {
  FrameRecord record;
  record.frame = 4;
  EXPECT_EQ(framesCsvLine(record).rfind("4,,unreadable,0,0,0,0,,", 0), 0u);
  record.tracked.push_back({7, Eigen::Vector3d::Constant(kUnknown), false});
  EXPECT_EQ(tracksCsvLines(record), "4,7,nan,nan,nan,0,nan\n");
}

TEST(RunTables, RowsOfAMapMoveIntoAnother) {
  FrameRecord record;
  record.reason = "1,2,\"1\"";
  std::string rows, expected;
  for (const int map : {0, 2, 1, 12}) {
    record.map = map;
    rows += framesCsvLine(record);
    record.map = map == 2 ? 0 : map;
    expected += framesCsvLine(record);
  }
  EXPECT_EQ(moveRows(rows, {2, 0, Eigen::Isometry3d::Identity()}), expected);
  std::string line = framesCsvLine(record);
  line.pop_back();
  EXPECT_EQ(readFramesCsvLine(line, "run/frames.csv").map, 12);
}

TEST(RunTables, ANumberThatNoFrameHasIsRefusedWithItsFile) {
  FrameRecord record;
  record.times.emplace_back("check", 5.25);
  std::string line = framesCsvLine(record);
  line.pop_back();  // its end
  EXPECT_EQ(readFramesCsvLine(line, "run/frames.csv").times.back().second, 5.25);
  const std::size_t at = line.find("5.25");
  for (const std::string wrong : {"inf", "nan", "1e300", "5,25x"})
    test::expectError<InputError>(
        [&] { readFramesCsvLine(std::string(line).replace(at, 4, wrong), "run/frames.csv"); },
        {"run/frames.csv"});
}

}  // namespace
}  // namespace softscope
