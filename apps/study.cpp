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
#include "toolkit/study/study_gpus.h"

namespace softscope {
namespace {

const char* const kDetails =
    "FILE names cases: a sequence that exists or is simulated, settings of `reconstruct`, what it\n"
    "is judged by; variants and sweeps multiply them (docs/studies.md, data/studies). Each case "
    "is\n"
    "a process; one that fails is told and doesn't stop the others; one that is done is not run\n"
    "again unless its settings or inputs changed. Ctrl-C stops cleanly, the same line goes on.\n"
    "Writes DIR/study.json, table.csv, table.md, report.html, plots/, and cases/NAME/\n"
    "with each case's run, evaluation and log.txt. Exit code 1: a case failed.\n"
    "--list, --case and --table are what a workflow manager needs (data/studies/Snakefile).";

class StudyCommand : public Command {
 public:
  std::string name() const override { return "study"; }
  std::string summary() const override {
    return "many simulated or real cases to one table of errors";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope study data/studies/stress.toml --out stress --jobs 4";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  StudyRun readRun() const;
  int runOne(const StudyRun& run) const;
  int runAll(StudyRun run) const;
  int writeTable(const StudyRun& run) const;

  std::string file_, out_, case_;
  int jobs_ = 0;
  bool list_ = false, table_ = false, force_ = false;
};

void StudyCommand::declare(ArgumentList& arguments) {
  arguments.positional("FILE", file_, "the study (TOML)", true);
  arguments.option("--out", "DIR", out_, "folder for everything; an earlier study in it goes on");
  arguments.option("--jobs", "N", jobs_,
                   "cases at the same time, which share --threads (0, the default: one a GPU, "
                   "without GPUs one a core)");
  arguments.flag("--list", list_, "print the names of all cases, run nothing");
  arguments.option("--case", "NAME", case_, "run this case alone, write no table");
  arguments.flag("--table", table_, "run nothing, write the table of what is there");
  arguments.flag("--force", force_, "run cases that are done again");
}

StudyRun StudyCommand::readRun() const {
  StudyRun run{readStudy(file_), file_, {out_}, ownExecutable(), jobs_, common.threads, force_, {}};
  run.validate();
  return run;
}

int StudyCommand::run() {
  if (int(list_) + int(table_) + int(!case_.empty()) > 1)
    throw OptionError("--list, --case and --table exclude each other; give one");
  const StudyRun run = readRun();
  if (list_) {
    for (const StudyCase& one : run.study.cases) std::cout << printable(one.name) << "\n";
    return kDone;
  }
  if (out_.empty()) throw OptionError("softscope study: --out is missing: folder for everything");
  run.folder.requireUsable();
  if (table_ && !std::filesystem::exists(run.folder.marker()))
    throw OptionError("--table: there is no study in " + shown(run.folder.root) +
                      " yet; run it first, without --table");
  if (!case_.empty()) run.study.caseNamed(case_);  // before the folder is made
  run.folder.claim();
  if (table_) return writeTable(run);
  return case_.empty() ? runAll(run) : runOne(run);
}

int StudyCommand::runOne(const StudyRun& run) const {
  const InterruptGuard interrupt;
  const CaseEnd end = runStudyCase(
      run, run.study.caseNamed(case_), [&] { return interrupt.requested(); }, logListener());
  if (end == CaseEnd::kInterrupted) return kInterrupted;
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
