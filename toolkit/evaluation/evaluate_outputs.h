// toolkit/evaluation/evaluate_outputs.h: the files of an evaluation.
#pragma once

#include <filesystem>

#include "io/new_files.h"
#include "toolkit/evaluation/depth_map_result.h"
#include "toolkit/evaluation/evaluate_frames.h"
#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/evaluation/truthless_result.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/vector_drawing.h"

namespace softscope {

/// Each file appears whole or not at all, and a failure takes back those that were written.
class EvaluateOutputs {
 public:
  /// Throws OptionError where `folder` is a file, or a file to be written is there and `overwrite`
  /// is false.
  EvaluateOutputs(std::filesystem::path folder, bool overwrite);

  /// evaluation.json, frames.csv, tracks.csv where tracks were judged, and the figures
  /// error_series, error_histogram and worst_frames as SVG, PDF and PNG where a surface was, with
  /// errors/NNNNNN.vtp of some of its moments.
  void write(const EvaluationResult& result, const FrameTable& frames,
             const FactSheet::Json& record) const;
  /// evaluation.json, frames.csv, and the figure quality_series.
  void write(const TruthlessResult& result, const FactSheet::Json& record) const;
  /// evaluation.json and maps.csv.
  void write(const DepthMapResult& result, const FactSheet::Json& record) const;

 private:
  void put(const std::string& name, const std::string& bytes) const;
  void putMaps(const std::vector<ErrorMap>& maps) const;
  void putFigure(const std::string& name, const VectorDrawing& figure) const;

  std::filesystem::path folder_;
  bool overwrite_;
  mutable NewFiles new_files_;
};

}  // namespace softscope
