// tests/support/made_case.h: an evaluation as `evaluate --out` leaves it, by hand.
#pragma once

#include <filesystem>

#include "vtk_views/files/error_map.h"

namespace softscope::test {

/// Three points, 50 mm before the camera, of which one is exact.
ErrorMap smallMap(double mean_mm);

/// What evaluate leaves of a model that is `mean_mm` off: a record, and the map of one moment.
void writeCase(const std::filesystem::path& case_folder, double mean_mm, const ErrorMap& map);
inline void writeCase(const std::filesystem::path& case_folder, double mean_mm) {
  writeCase(case_folder, mean_mm, smallMap(mean_mm));
}

/// What evaluate leaves of a run whose sequence has no truth.
void writeTruthlessCase(const std::filesystem::path& case_folder, double psnr_db);

}  // namespace softscope::test
