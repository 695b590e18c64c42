// tests/core/decimal_number_test.cpp: what is a number, in every file and option.
#include "core/decimal_number.h"

#include <gtest/gtest.h>

#include <clocale>

namespace softscope::test {
namespace {

TEST(DecimalNumber, IsReadWhole) {
  EXPECT_EQ(decimalNumber<double>("5."), 5.0);
  EXPECT_EQ(decimalNumber<double>("-.5"), -0.5);
  EXPECT_EQ(decimalNumber<double>("+1e5"), 1e5);
  EXPECT_EQ(decimalNumber<double>("1E-2"), 0.01);
  EXPECT_EQ(decimalNumber<int>("-7"), -7);
}

TEST(DecimalNumber, IsNothingElse) {
  for (const char* word : {"", "+", "-", ".", "0x10", "1,5", "1.5mm", "1 ", " 1", "1e", "--1",
                           "+-1", "1e999", "2 2", "1d5", "text"})
    EXPECT_FALSE(decimalNumber<double>(word).has_value()) << word;
  for (const char* word : {"1.0", "1e2", "2147483648", "0x10", "nan"})
    EXPECT_FALSE(decimalNumber<int>(word).has_value()) << word;
}

TEST(DecimalNumber, DoesNotDependOnTheLocale) {
  if (std::setlocale(LC_NUMERIC, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no such locale here";
  EXPECT_EQ(decimalNumber<double>("1.5"), 1.5);
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace
}  // namespace softscope::test
