// include/softscope/compare.h: comparison of a surface or model with a reference surface.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "softscope/evaluate.h"

namespace softscope::api {

struct ComparisonOptions {
  std::string align = "none";  // none, landmarks or icp
  std::string landmarks;       // file of point pairs
  double reference_unit_mm = kStatedUnit, test_unit_mm = kStatedUnit;
  std::vector<double> taus_mm{0.5, 1, 2};  // for precision, recall, F-score and surface Dice
};

struct Comparison {
  Distances accuracy, completeness;       // test to reference, reference to test
  std::map<std::string, double> metrics;  // by path; NaN: not measured
  std::vector<std::string> warnings;
  std::string record;  // content of comparison.json
};

/// Files: STL, PLY, OBJ or VTP; the test may be a point cloud. Throws OptionError and InputError.
Comparison compare(const std::string& reference, const std::string& test,
                   const ComparisonOptions& options = {});

}  // namespace softscope::api
