// include/softscope/figure.h: CT, reference, model and runs as one figure.
#pragma once

#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// What a figure shows; files and folders, empty: not shown.
struct FigureContents {
  std::string kind = "four";          // or of a run: frames, series, compare, matches
  std::string run;                    // folder; excludes ct and test
  std::string ct, reference, test;    // files; of a run `reference` is its sequence
  std::vector<std::string> surfaces;  // further surfaces or models
  std::vector<std::string> scans;     // points, drawn in red
  std::string align = "none";         // the test to the reference: none, landmarks or icp
  std::string landmarks;              // file of pairs of points
  std::string errors = "absolute";    // of the test from the reference: or signed, none
  double range_mm = 0;                // end of the colour bar; 0: not below the P95
  int frame = -1;                     // of a run; -1: the last one that can be judged
};

struct FigureStyleChoice {
  std::string name = "ieee";  // or nature, elsevier, slides
  double width_mm = 0;        // 0: the style's column
  double dots_per_inch = 0;   // of PNG; 0: the style's
};

/// Writes each of `files` (.png, .pdf or .svg) and a JSON record beside the first. The same inputs
/// give the same bytes. Returns warnings. Throws OptionError, InputError, BackendError.
std::vector<std::string> figure(const FigureContents& contents,
                                const std::vector<std::string>& files,
                                const FigureStyleChoice& style = {}, bool overwrite = false);

}  // namespace softscope::api
