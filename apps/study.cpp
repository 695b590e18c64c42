// apps/study.cpp: `softscope study`: many cases, one table.
#include <filesystem>
#include <iostream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/result_output.h"
#include "apps/work_progress.h"
#include "core/error.h"
#include "io/text/message.h"
#include "toolkit/record/child_process.h"
#include "toolkit/study/run_study.h"
#include "toolkit/study/study_case.h"
#include "toolkit/study/study_gpus.h"

namespace softscope {
namespace {

const char* const kStudyDetails =
    "FILE lists cases: an existing or simulated sequence, settings of `reconstruct`, a reference;\n"
    "variants and sweeps multiply them (docs/studies.md, data/studies). Each case is a process; a\n"
    "failed case is reported and does not stop the others; a complete case is not repeated unless\n"
    "its settings or inputs changed. Ctrl-C stops cleanly, the same command continues.\n"
    "Writes DIR/study.json, table.csv, table.md, report.html, plots/, and cases/NAME/\n"
    "with run, evaluation and log.txt of each case. Exit code 1: a case failed.\n"
    "--list, --case and --table are for workflow managers (data/studies/Snakefile).";

class StudyCommand : public Command {
 public:
  std::string name() const override { return "study"; }
  std::string summary() const override { return "table of errors of many simulated or real cases"; }
  std::string details() const override { return kStudyDetails; }
  std::string example() const override {
    return "softscope study data/studies/stress.toml --out stress --jobs 4";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  StudyRun readRun() const;
  int listCases(const StudyRun& run) const;
  int runOne(const StudyRun& run) const;
  int runAll(StudyRun run) const;
  int writeTable(const StudyRun& run) const;

  std::string file_, out_, case_;
  int jobs_ = 0;
  bool list_ = false, table_ = false, force_ = false;
};

void StudyCommand::declare(ArgumentList& arguments) {
  arguments.positional("FILE", file_, "study file (TOML)", true);
  arguments.option("--out", "DIR", out_,
                   "folder for all results; an earlier study in it is continued");
  arguments.option("--jobs", "N", jobs_,
                   "parallel cases, which share --threads (0, the default: one per GPU, "
                   "without GPUs one per core)");
  arguments.flag("--list", list_, "print the names of all cases only");
  arguments.option("--case", "NAME", case_, "run only this case, without the table");
  arguments.flag("--table", table_, "write only the table of existing results");
  arguments.flag("--force", force_, "repeat complete cases");
}

StudyRun StudyCommand::readRun() const {
  StudyRun run{readStudy(file_), file_,  {out_}, executablePath(), jobs_,
               common.threads,   force_, {}};
  run.validate();
  return run;
}

int StudyCommand::run() {
  if (int(list_) + int(table_) + int(!case_.empty()) > 1)
    throw OptionError("--list, --case and --table exclude each other; give one");
  const StudyRun run = readRun();
  if (list_) return listCases(run);
  if (out_.empty()) throw OptionError("softscope study: --out is missing: folder for all results");
  run.folder.requireUsable();
  if (table_ && !std::filesystem::exists(run.folder.marker()))
    throw OptionError("--table: there is no study in " + shown(run.folder.root) +
                      " yet; run it first, without --table");
  if (!case_.empty()) run.study.caseNamed(case_);  // before the folder is made
  run.folder.claim();
  if (table_) return writeTable(run);
  return case_.empty() ? runAll(run) : runOne(run);
}

int StudyCommand::listCases(const StudyRun& run) const {
  FactSheet::Json names = FactSheet::Json::array();
  for (const StudyCase& one : run.study.cases) names.push_back(one.name);
  if (common.json)
    printJson({{"schema_version", 1}, {"cases", names}});
  else
    for (const StudyCase& one : run.study.cases) std::cout << printable(one.name) << "\n";
  return kDone;
}

int StudyCommand::runOne(const StudyRun& run) const {
  const InterruptGuard interrupt;
  const StudyCase& chosen = run.study.caseNamed(case_);
  const CaseEnd end = runStudyCase(
      run, chosen, [&] { return interrupt.requested(); }, logListener());
  if (end == CaseEnd::kInterrupted) return kInterrupted;
  if (common.json) printJson(recordOf(chosen, run.folder));
  return end == CaseEnd::kFailed ? kThresholdFailed : kDone;
}

int StudyCommand::runAll(StudyRun run) const {
  if (mayUseGpus(run.study)) run.gpus = visibleGpus();
  const InterruptGuard interrupt;
  WorkProgress progress("study", progressStyle(common.quiet), interrupt);
  return runStudy(run, listenerOf(progress)) ? writeTable(run) : kInterrupted;
}

int StudyCommand::writeTable(const StudyRun& run) const {
  const WrittenStudy written = writeStudyTable(run, table_, logListener());
  if (common.json)
    printJson(written.record);
  else
    std::cout << written.markdown << "\nwritten to " << printable(out_) << "\n";
  return written.failed > 0 ? kThresholdFailed : kDone;
}

}  // namespace

std::unique_ptr<Command> makeStudyCommand() { return std::make_unique<StudyCommand>(); }

}  // namespace softscope
