// toolkit/comparison/compare_record.h: record of a comparison as JSON and as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/surfaces/observed_split.h"
#include "eval/surfaces/surface_comparison.h"
#include "toolkit/comparison/surface_fit.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct ComparisonResult {
  std::string reference, test;  // paths as given
  std::string space;            // change or assumption about the space
  SurfaceFit fit;
  SurfaceComparison comparison;
  std::optional<ObservedSplit> observed;  // set if an observed region is given
  std::vector<std::string> warnings;
};

FactSheet::Json comparisonJson(const ComparisonResult& result);
FactSheet comparisonFacts(const ComparisonResult& result);

}  // namespace softscope
