// toolkit/study/study_table.h: results of all cases of a study, as one record and one table.
#pragma once

#include <string>
#include <vector>

#include "toolkit/record/fact_sheet.h"
#include "toolkit/study/study_file.h"

namespace softscope {

/// First failed level of one sweep of a case and variant.
struct StudyBreak {
  std::string plot, series, sweep;
  bool broken = false;
  double level = 0;                   // if failed
  std::vector<double> held, not_run;  // passed levels; levels without a result
};

/// Content of study.json: records of the cases, failed levels, version
/// and machine. `records`: one per case, null without a result.
FactSheet::Json studyJson(const Study& study, const std::vector<FactSheet::Json>& records,
                          const std::string& command);

/// Default columns.
const std::vector<StudyMetric>& usualColumns();

/// Number at a dotted path of the record of a case; NaN if absent.
double valueAt(const FactSheet::Json& record, const std::string& path);

/// True for done or failed; false for skipped, outdated or not started.
bool wasRun(const FactSheet::Json& record);

/// "heart, paper": label of a curve or bar.
std::string seriesName(const StudyCase& study_case);

/// Series without any result are omitted. A level fails if its metric is missing
/// or above the limit of the plot, or if fewer than half of the frames were fused.
std::vector<StudyBreak> breaksOf(const Study& study, const std::vector<FactSheet::Json>& records);

/// Metrics of columns and plots in the study file without a value in any
/// case, with the nearest name. Empty as long as no case is done.
std::vector<std::string> metricWarnings(const Study& study,
                                        const std::vector<FactSheet::Json>& records);

struct StudyTable {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  // one per case, as many cells as headings
  std::vector<std::string> notes;              // below the table

  std::string csv() const;
  std::string markdown() const;
};

/// Columns without any value are omitted; the notes have metricWarnings().
StudyTable studyTable(const Study& study, const std::vector<FactSheet::Json>& records);

}  // namespace softscope
