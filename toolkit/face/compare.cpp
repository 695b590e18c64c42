// toolkit/face/compare.cpp: implementation of include/softscope/compare.h.
#include "softscope/compare.h"

#include "toolkit/comparison/compare_files.h"
#include "toolkit/face/distances_of.h"
#include "toolkit/record/json_text.h"

namespace softscope::api {

Comparison compare(const std::string& reference, const std::string& test,
                   const ComparisonOptions& options) {
  CompareOptions files;
  files.reference = reference;
  files.test = test;
  files.fit = parseFit(options.align, options.landmarks, "landmarks");
  files.reference_unit_mm = options.reference_unit_mm;
  files.test_unit_mm = options.test_unit_mm;
  files.taus_mm = options.taus_mm;
  const FileComparison compared = compareFiles(files);
  const SurfaceComparison& found = compared.result.comparison;
  Comparison comparison;
  comparison.accuracy = distancesOf(found.accuracy.vertices_mm);
  comparison.completeness = distancesOf(found.completeness.vertices_mm);
  comparison.metrics = metricMapOf(compared.record);
  comparison.warnings = compared.result.warnings;
  comparison.record = jsonText(compared.record);
  return comparison;
}

}  // namespace softscope::api
