// tests/support/run_results.h: what two runs of the same input have in common.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace softscope::test {

/// Bytes of the files of a run by their names; without run.json, and without times.
std::map<std::string, std::string> resultsIn(const std::filesystem::path& run);

/// run.json without times.
nlohmann::json recordWithoutTimes(const std::filesystem::path& run);

}  // namespace softscope::test
