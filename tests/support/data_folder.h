// tests/support/data_folder.h: larger data, where there are any.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace softscope::test {

/// A folder of the larger test data; empty where there is none.
inline std::filesystem::path dataFolder(const std::string& name) {
  const char* root = std::getenv("SOFTSCOPE_TEST_DATA");
  if (root == nullptr) return {};
  const std::filesystem::path folder = std::filesystem::path(root) / name;
  return std::filesystem::exists(folder) ? folder : std::filesystem::path();
}

}  // namespace softscope::test

/// Folder of the larger test data; skips the test with a message if it is missing.
#define SOFTSCOPE_DATA_OR_SKIP(variable, name)                                     \
  const std::filesystem::path variable = softscope::test::dataFolder(name);        \
  if (variable.empty())                                                            \
  GTEST_SKIP() << name                                                             \
               << " isn't there: set SOFTSCOPE_TEST_DATA to the folder of larger " \
                  "test data to run this test"
