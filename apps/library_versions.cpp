// apps/library_versions.cpp: versions queried from each library.
#include "apps/library_versions.h"

#include <OpenMesh/Core/System/config.h>
#include <fmt/core.h>
#include <spdlog/version.h>
#include <tbb/version.h>
#include <toml++/toml.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "vtk_views/scenes/drawing_versions.h"

namespace softscope {
namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> libraryVersions() {
  std::vector<std::pair<std::string, std::string>> versions{
      {"OpenCV", cv::getVersionString()},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"OpenMesh", std::to_string(OM_GET_VER) + "." + std::to_string(OM_GET_MAJ)},
      {"oneTBB", TBB_runtime_version()}};
  for (const auto& version : drawingLibraryVersions()) versions.push_back(version);
  versions.emplace_back("toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH));
  versions.emplace_back("nlohmann-json",
                        dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                               NLOHMANN_JSON_VERSION_PATCH));
  versions.emplace_back("spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH));
  versions.emplace_back("fmt",
                        dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  return versions;
}

}  // namespace softscope
