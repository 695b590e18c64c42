// include/softscope/evaluate.h: errors of a run against ground truth.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "softscope/run.h"

namespace softscope::api {

/// For a length of one unit of a file: what the file states, else 1 mm.
inline constexpr double kStatedUnit = std::numeric_limits<double>::quiet_NaN();

/// NaN if not measured.
struct Distances {
  double mean_mm = 0, sd_mm = 0, rmse_mm = 0, median_mm = 0, p95_mm = 0, max_mm = 0;
  long count = 0;
};

struct SurfaceErrors {
  Distances all, observed, predicted;  // observed: points currently visible to the scope
};

struct Evaluation {
  SurfaceErrors surface;                  // NaN without ground truth or mesh
  std::map<std::string, double> metrics;  // by path: "surface.observed.p95_mm"; NaN: not measured
  std::vector<std::string> warnings;
  std::string record;  // content of evaluation.json: docs/evaluation.md

  /// Throws OptionError for an unknown metric.
  double metric(const std::string& path) const;
};

struct EvaluationOptions {
  std::string align = "none";  // to a mesh: none, rigid (one for all models), icp (each model)
  bool each_model = false;     // against a mesh: every saved model instead of the last
  double reference_unit_mm = kStatedUnit;  // of a mesh file: 1000 for metres
  bool views = true;                       // render models for depth, PSNR and SSIM
  std::string out;  // folder of evaluation.json, tables and figures; empty: none
  bool overwrite = false;
  std::function<bool(int done, int total)> progress;  // models; false: stop
};

/// `reference`: a sequence folder, preferably with groundtruth/, or a mesh
/// file. Throws OptionError and InputError; Error after a stop by `progress`.
Evaluation evaluate(const Run& run, const std::string& reference,
                    const EvaluationOptions& options = {});

}  // namespace softscope::api
