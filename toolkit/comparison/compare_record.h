// toolkit/comparison/compare_record.h: a comparison as JSON and as lines for people.
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
  std::string reference, test;  // as the user named them
  std::string space;            // what was done or assumed
  SurfaceFit fit;
  SurfaceComparison comparison;
  std::optional<ObservedSplit> observed;  // where the user said what was seen
  std::vector<std::string> warnings;
};

FactSheet::Json comparisonJson(const ComparisonResult& result);
FactSheet comparisonFacts(const ComparisonResult& result);

}  // namespace softscope
