// include/softscope/figure.h: figure of CT, reference, model and runs.
#pragma once

#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// Content of a figure; files and folders, empty: not shown.
struct FigureContents {
  std::string kind = "four";          // or for a run: frames, series, compare, matches
  std::string run;                    // folder; excludes ct and test
  std::string ct, reference, test;    // files; for a run `reference` is its sequence
  std::vector<std::string> surfaces;  // additional surfaces or models
  std::vector<std::string> scans;     // points, drawn in red
  std::string align = "none";         // test to reference: none, landmarks or icp
  std::string landmarks;              // file of point pairs
  std::string errors = "absolute";    // test to reference: or signed, none
  double range_mm = 0;                // end of the colour bar; 0: at least the P95
  int frame = -1;                     // of a run; -1: the last one with a truth
};

struct FigureStyleChoice {
  std::string name = "ieee";  // or nature, elsevier, slides
  double width_mm = 0;        // 0: column width of the style
  double dots_per_inch = 0;   // for PNG; 0: from the style
};

/// Writes each of `files` (.png, .pdf or .svg), and a JSON record next to the first.
/// Deterministic. Returns warnings. Throws OptionError, InputError, BackendError.
std::vector<std::string> figure(const FigureContents& contents,
                                const std::vector<std::string>& files,
                                const FigureStyleChoice& style = {}, bool overwrite = false);

}  // namespace softscope::api
