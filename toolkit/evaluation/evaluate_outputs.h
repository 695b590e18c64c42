// toolkit/evaluation/evaluate_outputs.h: the files of an evaluation.
#pragma once

#include <filesystem>

#include "io/files/new_files.h"
#include "toolkit/evaluation/evaluate_run.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Files are written atomically; a failure removes the files written before.
class EvaluateOutputs {
 public:
  /// Throws OptionError if `folder` is a file, or an
  /// output file exists and `overwrite` is false.
  EvaluateOutputs(std::filesystem::path folder, bool overwrite);

  /// evaluation.json, frames.csv, tracks.csv for evaluated tracks, and, for an
  /// evaluated surface, the figures error_series, error_histogram and
  /// worst_frames as SVG, PDF and PNG and errors/NNNNNN.vtp of selected frames.
  /// Without truth: evaluation.json, frames.csv and the figure quality_series.
  /// For maps: evaluation.json, maps.csv and error_map of the worst map.
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
