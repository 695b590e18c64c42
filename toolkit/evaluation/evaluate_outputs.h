// toolkit/evaluation/evaluate_outputs.h: the files of an evaluation.
#pragma once

#include <filesystem>

#include "io/files/new_files.h"
#include "toolkit/evaluation/evaluate_run.h"
#include "vtk_views/drawing/vector_drawing.h"

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
  /// Without truth: evaluation.json, frames.csv, and the figure quality_series.
  /// Of maps: evaluation.json, maps.csv, and error_map of the worst of them.
  void write(const RunEvaluation& evaluation) const;

 private:
  void write(const EvaluationResult& result) const;
  void write(const TruthlessResult& result) const;
  void write(const DepthMapResult& result) const;
  void put(const std::string& name, const std::string& bytes) const;
  void putMaps(const std::vector<ErrorMap>& maps) const;
  void putFigure(const std::string& name, const VectorDrawing& figure) const;

  std::filesystem::path folder_;
  bool overwrite_;
  mutable NewFiles new_files_;
};

}  // namespace softscope
