// toolkit/study/run_study.h: the cases of a study as processes, and the table of all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/study/study_file.h"
#include "toolkit/study/study_folder.h"

namespace softscope {

struct StudyRun {
  Study study;
  std::string file;               // of the study
  StudyFolder folder;             // of all results
  std::filesystem::path program;  // softscope, which runs each case
  int jobs = 0;        // cases at the same time; 0: one per GPU, without GPUs one per core
  int threads = 0;     // shared by all cases; 0: one per core
  bool again = false;  // run cases that are done, too
  std::vector<std::string> gpus;  // to distribute the cases over; empty: none

  /// Throws OptionError.
  void validate() const;
  /// The command that makes this study, without the machine's folders.
  std::string command() const;
};

enum class CaseEnd { kDone, kFailed, kInterrupted };

/// One case within this process; a failure and a skip are reported. Writes no table.
CaseEnd runStudyCase(const StudyRun& run, const StudyCase& study_case,
                     const std::function<bool()>& interrupted, const WorkListener& listener = {});

/// All pending cases, several in parallel; cases with a sequence of their own come first.
/// `listener.progress` counts cases. Returns false if it was stopped: complete cases are kept.
bool runStudy(const StudyRun& run, const WorkListener& listener = {});

struct WrittenStudy {
  FactSheet::Json record;  // of study.json
  std::string markdown;    // the table
  int failed = 0;          // cases
};

/// Tables, plots and page of the existing results. `check`: a case
/// with settings or inputs changed since its run is outdated.
WrittenStudy writeStudyTable(const StudyRun& run, bool check, const WorkListener& listener = {});

}  // namespace softscope
