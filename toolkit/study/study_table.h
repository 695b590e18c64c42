// toolkit/study/study_table.h: results of all cases of a study, as one record and one table.
#pragma once

#include <string>
#include <vector>

#include "toolkit/record/fact_sheet.h"
#include "toolkit/study/study_file.h"

namespace softscope {

/// Of one sweep of one case and variant: the first level that breaks.
struct StudyBreak {
  std::string plot, series, sweep;
  bool broken = false;
  double level = 0;                   // if broken
  std::vector<double> held, not_run;  // levels that pass; levels that were not run
};

/// The whole study as study.json: its cases' records as they are, what breaks where, how and on
/// what machine it was made. `records`: one a case, null where it hasn't been run.
FactSheet::Json studyJson(const Study& study, const std::vector<FactSheet::Json>& records,
                          const std::string& command);

/// Of a study that names none.
const std::vector<StudyMetric>& usualColumns();

/// Number at a dotted path of a case's record; NaN where there is none.
double valueAt(const FactSheet::Json& record, const std::string& path);

/// Done or failed, so that it says something; not skipped, outdated or never begun.
bool wasRun(const FactSheet::Json& record);

/// "heart, paper": what a curve or bar stands for.
std::string seriesName(const StudyCase& study_case);

/// Series of which no level was run are left out. Where a level's metric is missing, above the
/// plot's limit, or fewer than half of the frames were fused, the level breaks.
std::vector<StudyBreak> breaksOf(const Study& study, const std::vector<FactSheet::Json>& records);

struct StudyTable {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  // one a case, as many cells as headings
  std::vector<std::string> notes;              // below the table

  std::string csv() const;
  std::string markdown() const;
};

/// Columns that no case has a value for are left out.
StudyTable studyTable(const Study& study, const std::vector<FactSheet::Json>& records);

}  // namespace softscope
