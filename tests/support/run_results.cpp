#include "support/run_results.h"

#include <sstream>
#include <vector>

#include "support/in_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

/// frames.csv without its columns of times, whose headings end in _ms.
std::string withoutTimes(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<bool> is_time;  // per column
  std::string kept;
  for (std::string line; std::getline(lines, line); kept += "\n") {
    const bool is_heading = kept.empty();
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t column = 0; std::getline(cells, cell, ','); ++column) {
      if (is_heading) is_time.push_back(cell.size() > 3 && cell.substr(cell.size() - 3) == "_ms");
      if (column >= is_time.size() || !is_time[column]) kept += cell + ",";
    }
  }
  return kept;
}

}  // namespace

std::map<std::string, std::string> resultsIn(const fs::path& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(run))
    if (entry.is_regular_file() && entry.path().filename() != "run.json")
      files[fs::relative(entry.path(), run)] = textOf(entry.path());
  files["frames.csv"] = withoutTimes(files["frames.csv"]);
  return files;
}

nlohmann::json recordWithoutTimes(const fs::path& run) {
  nlohmann::json record = nlohmann::json::parse(textOf(run / "run.json"));
  for (const char* times : {"frame_ms", "mean_frame_ms", "mean_stage_ms"}) record.erase(times);
  return record;
}

}  // namespace softscope::test
