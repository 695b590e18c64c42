// toolkit/evaluation/evaluate_frames.h: one row a frame, for CSV and JSON alike.
#pragma once

#include <string>
#include <vector>

#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Units are in the headings; NaN = not measured, an empty cell and null.
struct FrameTable {
  std::vector<std::string> headings;  // the first is "frame"
  std::vector<std::vector<double>> rows;
  std::vector<std::string> outcomes;  // of each row: fused, skipped, lost; empty if not known

  std::string csv() const;
  FactSheet::Json json() const;
};

/// Every frame of the run (of a mesh: with a judged model), rising; docs/evaluation.md explains the
/// columns.
FrameTable frameTable(const EvaluationResult& result);

/// frame,id,error_mm,no_motion_mm,visible,sigma_mm
std::string tracksCsv(const TrackErrors& tracks);

}  // namespace softscope
