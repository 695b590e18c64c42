// tests/core/length_unit_test.cpp: units that the headers of files state.
#include "core/length_unit.h"

#include <gtest/gtest.h>

namespace softscope {
namespace {

TEST(LengthUnit, IsThatOfTheHeaderUnlessRequested) {
  EXPECT_EQ(unitOfFileMm(kUnitOfFile, "ply\ncomment unit cm\ncomment SPACE=LPS\n"), 10);
  EXPECT_EQ(unitOfFileMm(kUnitOfFile, "# unit m\nv 0 0 0\n"), 1000);
  EXPECT_EQ(unitOfFileMm(kUnitOfFile, "unit mm SPACE=RAS"), 1);
  EXPECT_EQ(unitOfFileMm(kUnitOfFile, "unit cm"), 10);  // at the end
  EXPECT_EQ(unitOfFileMm(25.4, "comment unit cm\n"), 25.4);
}

TEST(LengthUnit, IsMillimetresWithoutWordOfIt) {
  for (const char* header : {"", "solid liver", "a subunit cm of it", "unit centimetres", "unit ",
                             "units cm", "unit furlong"})
    EXPECT_EQ(unitOfFileMm(kUnitOfFile, header), 1) << header;
  EXPECT_EQ(unitOfFileMm(kUnitOfFile, "unit of the model: unit cm"), 10);
}

}  // namespace
}  // namespace softscope
