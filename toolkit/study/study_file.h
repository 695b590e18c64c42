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

/// Key to value as TOML writes it, without the quotes of a text.
using StudyValues = std::map<std::string, std::string>;

/// One sequence, one reconstruction, one judgement.
struct StudyCase {
  std::string name;           // of its folder: "heart-depth-blur-2"
  std::string base, variant;  // of the study file; empty where it names none
  std::string sweep;          // name of the sweep, or empty
  double level = 0;           // of the sweep
  std::string sequence;       // an existing folder; empty: simulated
  StudyValues simulate, reconstruct, evaluate;
  std::map<std::string, double> beside;  // published values to stand beside ours, by heading
  std::vector<std::string> notes;        // notes below the table
  std::string skip;                      // why it can't be run here; empty: it can
};

/// A column of the table, or what a plot shows.
struct StudyMetric {
  std::string path;  // in a case's values: "evaluation.tracks.mean_mm"
  std::string label;
  int decimals = 3;
};

struct StudyPlot {
  std::string name;  // of the file
  StudyMetric metric;
  std::string p95_path;  // drawn above the metric; may be empty
  double limit = 0;      // a level whose metric is above it breaks; 0: none
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

/// ${NAME} is the environment's. Throws InputError where the file is missing or no TOML,
/// OptionError where it asks for what there isn't: every key of every case is checked here, before
/// any work.
Study readStudy(const std::filesystem::path& file);

}  // namespace softscope
