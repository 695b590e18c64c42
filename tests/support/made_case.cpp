// tests/support/made_case.cpp: numbers that follow from one.
#include "support/made_case.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace softscope::test {

ErrorMap smallMap(double mean_mm) {
  ErrorMap map;
  map.surface.vertices_mm = {{0, 0, 50}, {10, 0, 50}, {0, 10, 51}};
  map.absolute_mm = {float(mean_mm), 0, float(3 * mean_mm)};
  map.signed_mm = {float(-mean_mm), 0, float(3 * mean_mm)};
  return map;
}

void writeCase(const std::filesystem::path& case_folder, double mean_mm, const ErrorMap& map) {
  using Json = nlohmann::json;
  namespace fs = std::filesystem;
  fs::create_directories(case_folder / "errors");
  Json record{{"schema_version", 1}, {"softscope", "0.1.0"}, {"command", "evaluate"}};
  record["inputs"] = {{"run", case_folder / "run"}, {"reference", case_folder / "truth"}};
  record["comparison"] = {{"reference_kind", "sequence"}, {"alignment", "none"}};
  record["surface"] = {{"mean_mm", mean_mm},
                       {"sd_mm", 0.1},
                       {"rmse_mm", mean_mm + 0.1},
                       {"median_mm", mean_mm},
                       {"p95_mm", 2 * mean_mm},
                       {"max_mm", 3 * mean_mm},
                       {"n", 3},
                       {"models_judged", 2},
                       {"signed", {{"mean_mm", -mean_mm}, {"n", 3}}}};
  record["frames"] = Json::array();
  for (int frame = 0; frame < 4; ++frame)
    record["frames"].push_back({{"frame", frame},
                                {"time_s", 0.1 * frame},
                                {"mean_mm", mean_mm + 0.01 * frame},
                                {"median_mm", mean_mm},
                                {"p95_mm", 2 * mean_mm}});
  record["error_histogram"] = {
      {"low_mm", 0}, {"high_mm", 4 * mean_mm}, {"counts", {1, 2}}, {"beyond", 0}};
  record["warnings"] = {(case_folder / "run").string() + ": is old"};
  std::ofstream(case_folder / "evaluation.json") << record.dump();
  std::ofstream(case_folder / "errors/000002.vtp", std::ios::binary) << errorMapVtp(map);
}

void writeTruthlessCase(const std::filesystem::path& case_folder, double psnr_db) {
  using Json = nlohmann::json;
  std::filesystem::create_directories(case_folder);
  Json record{{"schema_version", 1}, {"softscope", "0.1.0"}, {"command", "evaluate"}};
  record["comparison"] = {{"reference_kind", "pictures"}, {"alignment", "none"}};
  record["missing"] = {"surface errors: they take meshes", "errors of the drawn depth: no depth"};
  record["view"] = {
      {"psnr_db", psnr_db}, {"ssim", 0.9}, {"judged_share", 0.75}, {"models_judged", 4}};
  record["backprojection"] = {{"mean_mm", 0.25}, {"n", 4}};
  record["coverage"] = {{"mean_share", 0.5}};
  record["camera"] = {{"moved_mm", 1.5}, {"turned_deg", 2}, {"jitter_rms_mm", 0.01}};
  record["frames"] = Json::array();
  for (int frame = 0; frame < 4; ++frame)
    record["frames"].push_back({{"frame", frame},
                                {"time_s", frame},
                                {"view_psnr_db", psnr_db + frame - 1.5},
                                {"backprojection_mean_mm", frame == 2 ? Json() : Json(0.25)}});
  std::ofstream(case_folder / "evaluation.json") << record.dump();
}

}  // namespace softscope::test
