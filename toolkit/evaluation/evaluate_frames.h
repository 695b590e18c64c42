// toolkit/evaluation/evaluate_frames.h: table with one row per frame, for CSV and JSON.
#pragma once

#include <string>
#include <vector>

#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Units are in the headings; NaN = not measured: an empty cell, null.
struct FrameTable {
  std::vector<std::string> headings;  // first heading: "frame"
  std::vector<std::vector<double>> rows;
  std::vector<std::string> outcomes;  // per row: fused, skipped, lost; empty if unknown

  std::string csv() const;
  FactSheet::Json json() const;
};

/// All frames of the run (for a mesh: with an evaluated
/// model), ascending; columns: docs/evaluation.md.
FrameTable frameTable(const EvaluationResult& result);

/// frame,id,error_mm,no_motion_mm,visible,sigma_mm
std::string tracksCsv(const TrackErrors& tracks);

}  // namespace softscope
