// toolkit/comparison/compare_outputs.h: the files of a comparison.
#pragma once

#include <filesystem>
#include <string>

#include "core/triangle_mesh.h"
#include "io/files/new_files.h"
#include "toolkit/comparison/compare_record.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Files are written atomically; a failure removes the files written before.
class CompareOutputs {
 public:
  /// Throws OptionError if `folder` is a file, or an
  /// output file exists and `overwrite` is false.
  CompareOutputs(std::filesystem::path folder, bool overwrite);

  /// `test`: in the space of the reference. Returns the reason for a missing figure,
  /// empty if all were drawn: without a renderer the numbers are still written.
  std::string write(const ComparisonResult& result, const TriangleMesh& reference,
                    const TriangleMesh& test, const ErrorColourOptions& picture,
                    const FactSheet::Json& record) const;

 private:
  void put(const std::string& name, const std::string& bytes) const;
  void putFigure(const std::string& name, const VectorDrawing& figure) const;

  std::filesystem::path folder_;
  bool overwrite_;
  mutable NewFiles new_files_;
};

/// metric,value: every number by its path in the record; an empty cell without a measurement.
std::string metricsCsv(const FactSheet::Json& record);

}  // namespace softscope
