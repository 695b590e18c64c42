// toolkit/study/study_file.h: cases and settings of a study (docs/studies.md).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Key and value in TOML syntax, texts without quotes.
using StudyValues = std::map<std::string, std::string>;

/// One sequence, one reconstruction, one evaluation.
struct StudyCase {
  std::string name;           // name of its folder: "heart-depth-blur-2"
  std::string base, variant;  // names in the study file; empty if unnamed
  std::string sweep;          // name of the sweep, or empty
  double level = 0;           // of the sweep
  std::string sequence;       // existing folder; empty: simulated
  StudyValues simulate, reconstruct, evaluate;
  std::map<std::string, double> beside;  // published values for comparison, by heading
  std::vector<std::string> notes;        // notes below the table
  std::string skip;                      // reason to skip the case here; empty: none
};

/// Column of the table, or metric of a plot.
struct StudyMetric {
  std::string path;  // path in the values of a case: "evaluation.tracks.mean_mm"
  std::string label;
  int decimals = 3;
};

struct StudyPlot {
  std::string name;  // file name
  StudyMetric metric;
  std::string p95_path;  // second curve; may be empty
  double limit = 0;      // a level with a larger metric fails; 0: no limit
};

struct StudySweep {
  std::string name, label;
  std::vector<double> levels;
};

struct Study {
  std::filesystem::path file;
  std::string title, about;
  std::vector<StudyCase> cases;
  std::vector<StudySweep> sweeps;
  std::vector<StudyMetric> columns;
  std::vector<StudyPlot> plots;

  /// Throws OptionError with the nearest name.
  const StudyCase& caseNamed(const std::string& name) const;
};

/// ${NAME} is an environment variable. Throws InputError for a
/// missing file or invalid TOML, OptionError for unknown keys or
/// values: every key of every case is checked before any work.
Study readStudy(const std::filesystem::path& file);

}  // namespace softscope
