// apps/compare_outputs.h: the files of a comparison.
#pragma once

#include <filesystem>

#include "apps/compare_record.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// Each file appears whole or not at all.
class CompareOutputs {
 public:
  /// Throws OptionError where `folder` is a file, or a file to be written is there and `overwrite`
  /// is false.
  CompareOutputs(std::filesystem::path folder, bool overwrite);

  /// `test`: in the reference's place.
  void write(const ComparisonResult& result, const TriangleMesh& test,
             const FactSheet::Json& record) const;

 private:
  std::filesystem::path folder_;
  bool overwrite_;
};

/// metric,value: every number by its path in the record; an empty cell where it wasn't measured.
std::string metricsCsv(const FactSheet::Json& record);

}  // namespace softscope
