// toolkit/calibration/calibration_result.h: stereo
// calibration with its quality, as YAML, image and facts.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration_quality.h"
#include "calibrate/row_outlook.h"
#include "core/image.h"
#include "toolkit/calibration/board_film.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct CalibrationReport {
  CalibrationSolution solution;
  std::vector<LeftOutView> left_out;  // views excluded before or during the solution, by frame
  std::vector<ParameterInterval> intervals;
  RowErrors rows;
  RowOutlook row_outlook;
  BoardCoverage coverage;
  std::vector<DepthOutlook> depths;
  std::vector<std::string> advice;    // which views are missing
  std::vector<std::string> warnings;  // from the checks of the calibration
};

/// Selects views, solves, evaluates. Throws InputError for too few or too similar views, or
/// a result outside the limits of a stereo endoscope (io/calibrations/calibration_check.h).
CalibrationReport calibrateFromFilm(const BoardFilm& film, const BoardOptions& board,
                                    const SolveOptions& options,
                                    const std::vector<double>& distances_mm);

/// calibration.yaml of docs/formats.md, with an additional map `quality`, which readers ignore.
std::string calibrationText(const CalibrationReport& report);

/// Both views side by side: each corner used as a dot, empty cells in red.
ColourImage coverageImage(const CalibrationReport& report);

FactSheet calibrationFacts(const CalibrationReport& report, const BoardFilm& film);

}  // namespace softscope
