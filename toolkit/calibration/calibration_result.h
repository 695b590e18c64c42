// toolkit/calibration/calibration_result.h: a calibration with its quality, as file, image and
// facts.
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
  std::vector<LeftOutView> left_out;  // before and by the solution, by frame
  std::vector<ParameterInterval> intervals;
  RowErrors rows;
  RowOutlook row_outlook;
  BoardCoverage coverage;
  std::vector<DepthOutlook> depths;
  std::vector<std::string> advice;    // what to film more of
  std::vector<std::string> warnings;  // of the calibration's own checks
};

/// Chooses views, solves, judges. Throws InputError where the views are too few or alike, or the
/// result is no calibration of a stereo endoscope (io/calibrations/calibration_check.h).
CalibrationReport calibrateFromFilm(const BoardFilm& film, const BoardOptions& board,
                                    const SolveOptions& options,
                                    const std::vector<double>& distances_mm);

/// calibration.yaml of docs/formats.md, with a map `quality` that readers pass over.
std::string calibrationText(const CalibrationReport& report);

/// Both views side by side: each corner that was used as a dot, cells without one in red.
ColourImage coverageImage(const CalibrationReport& report);

FactSheet calibrationFacts(const CalibrationReport& report, const BoardFilm& film);

}  // namespace softscope
