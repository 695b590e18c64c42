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

/// Each file appears whole or not at all, and a failure takes back those that were written.
class CompareOutputs {
 public:
  /// Throws OptionError where `folder` is a file, or a file to be written is there and `overwrite`
  /// is false.
  CompareOutputs(std::filesystem::path folder, bool overwrite);

  /// `test`: in the reference's place. Returns what could not be drawn, empty where all was: a
  /// machine without a renderer still gets the numbers.
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

/// metric,value: every number by its path in the record; an empty cell where it wasn't measured.
std::string metricsCsv(const FactSheet::Json& record);

}  // namespace softscope
