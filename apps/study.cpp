// apps/study.cpp: `softscope study`: many cases, one table.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>
#include <list>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/result_output.h"
#include "core/error.h"
#include "io/text/message.h"
#include "toolkit/record/child_process.h"
#include "toolkit/record/machine.h"
#include "toolkit/record/shell_word.h"
#include "toolkit/study/study_case.h"
#include "toolkit/study/study_outputs.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

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
  int runOne(const StudyCase& study_case, const StudyFolder& folder);
  int runAll(const Study& study, const StudyFolder& folder);
  std::vector<const StudyCase*> pending(const Study& study, const StudyFolder& folder) const;
  ChildProcess start(const StudyCase& study_case, const StudyFolder& folder, int threads) const;
  static bool tellIfBad(const StudyCase& one, const Json& record, const StudyFolder& folder);
  int writeAll(const Study& study, const StudyFolder& folder) const;
  int jobCount(std::size_t cases) const;
  std::string commandLine() const;

  std::string file_, out_, case_;
  int jobs_ = 0;
  bool list_ = false, table_ = false, force_ = false;
};

void StudyCommand::declare(ArgumentList& arguments) {
  arguments.positional("FILE", file_, "the study (TOML)", true);
  arguments.option("--out", "DIR", out_, "folder for everything; an earlier study in it goes on");
  arguments.option("--jobs", "N", jobs_,
                   "cases at the same time, which share --threads (0: one a core, the default)");
  arguments.flag("--list", list_, "print the names of all cases, run nothing");
  arguments.option("--case", "NAME", case_, "run this case alone, write no table");
  arguments.flag("--table", table_, "run nothing, write the table of what is there");
  arguments.flag("--force", force_, "run cases that are done again");
}

/// As a shell takes it, without options that decide no result, and without the machine's folders.
std::string StudyCommand::commandLine() const {
  const auto word = [](const std::filesystem::path& path) {
    const auto whole = path.lexically_normal();
    const auto name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
    return shellWord(path.is_absolute() ? name.string() : path.string());
  };
  return "softscope study " + word(file_) + " --out " + word(out_);
}

int StudyCommand::run() {
  require(jobs_ >= 0 && jobs_ <= 1024, "--jobs", jobs_, "must be 0 (one a core) to 1024");
  if (int(list_) + int(table_) + int(!case_.empty()) > 1)
    throw OptionError("--list, --case and --table exclude each other; give one");
  const Study study = readStudy(file_);
  if (list_) {
    for (const StudyCase& one : study.cases) std::cout << printable(one.name) << "\n";
    return kDone;
  }
  if (out_.empty()) throw OptionError("softscope study: --out is missing: folder for everything");
  const StudyFolder folder{out_};
  folder.requireUsable();
  if (table_ && !std::filesystem::exists(folder.marker()))
    throw OptionError("--table: there is no study in " + shown(folder.root) +
                      " yet; run it first, without --table");
  const StudyCase* one = case_.empty() ? nullptr : &study.caseNamed(case_);
  folder.claim();
  if (table_) return writeAll(study, folder);
  if (one != nullptr) return runOne(*one, folder);
  const int code = runAll(study, folder);
  return code == kInterrupted ? code : writeAll(study, folder);
}

int StudyCommand::runOne(const StudyCase& study_case, const StudyFolder& folder) {
  if (!force_ && finishedRecord(study_case, folder).is_object()) return kDone;
  const InterruptGuard interrupt;
  const int threads = common.threads > 0 ? common.threads : describeMachine().cores;
  const auto interrupted = [&] { return interrupt.requested(); };
  const Json record = runCase(
      study_case, folder, threads, interrupted,
      [&](std::vector<std::string> words, const std::filesystem::path& log) -> std::optional<int> {
        words.insert(words.begin(), ownExecutable().string());
        const int code = runToEnd(ChildProcess(words, log), interrupted);
        if (code == kInterrupted) return std::nullopt;
        return code;
      });
  if (!record.is_object()) return kInterrupted;
  const std::string status = record["status"], reason = record.value("reason", "");
  if (status == "skipped") spdlog::warn("{} is skipped: {}", study_case.name, reason);
  if (status == "failed") spdlog::error("{}: {}", study_case.name, reason);
  return status == "failed" ? kThresholdFailed : kDone;
}

/// Cases with a sequence of their own come first: those that share one needn't wait for it then.
std::vector<const StudyCase*> StudyCommand::pending(const Study& study,
                                                    const StudyFolder& folder) const {
  std::vector<const StudyCase*> first, later;
  std::vector<std::pair<std::string, StudyValues>> sequences;
  for (const StudyCase& one : study.cases) {
    if (!force_ && finishedRecord(one, folder).is_object()) continue;
    const std::pair<std::string, StudyValues> sequence{one.sequence, one.simulate};
    const bool known = std::find(sequences.begin(), sequences.end(), sequence) != sequences.end();
    if (!known) sequences.push_back(sequence);
    (known ? later : first).push_back(&one);
  }
  first.insert(first.end(), later.begin(), later.end());
  return first;
}

int StudyCommand::jobCount(std::size_t cases) const {
  const int jobs = jobs_ > 0 ? jobs_ : describeMachine().cores;
  return std::max(1, std::min(jobs, static_cast<int>(cases)));
}

ChildProcess StudyCommand::start(const StudyCase& study_case, const StudyFolder& folder,
                                 int threads) const {
  std::filesystem::create_directories(folder.ofCase(study_case.name));
  std::vector<std::string> words{ownExecutable().string(), "study",  file_, "--case",
                                 study_case.name,          "--out",  out_,  "--threads",
                                 std::to_string(threads),  "--quiet"};
  if (force_) words.emplace_back("--force");
  return ChildProcess(words, folder.root / "cases" / "study_log.txt");
}

int StudyCommand::runAll(const Study& study, const StudyFolder& folder) {
  const auto waiting = pending(study, folder);
  const std::size_t finished = study.cases.size() - waiting.size();
  if (waiting.empty()) return kDone;
  if (finished > 0) spdlog::info("{} of {} cases are done already", finished, study.cases.size());
  const int jobs = jobCount(waiting.size());
  const int cores = common.threads > 0 ? common.threads : describeMachine().cores;
  const InterruptGuard interrupt;
  ProgressBar progress("study", static_cast<int>(waiting.size()), progressStyle(common.quiet),
                       std::cerr);
  std::list<ChildProcess> running;
  std::size_t next = 0;
  bool told = false;
  while (!running.empty() || (next < waiting.size() && !interrupt.requested())) {
    while (next < waiting.size() && static_cast<int>(running.size()) < jobs &&
           !interrupt.requested())
      running.push_back(start(*waiting[next++], folder, std::max(1, cores / jobs)));
    if (interrupt.requested() && !told) {
      for (ChildProcess& child : running) child.interrupt();
      told = true;
    }
    for (auto child = running.begin(); child != running.end();) {
      const bool ended = child->ended().has_value();
      if (ended && !told) progress.advance();
      child = ended ? running.erase(child) : std::next(child);
    }
    waitAMoment();
  }
  if (!interrupt.requested()) return kDone;
  spdlog::warn("interrupted: cases that are done stay; the same line goes on");
  return kInterrupted;
}

bool StudyCommand::tellIfBad(const StudyCase& one, const Json& record, const StudyFolder& folder) {
  if (!record.is_object()) {
    spdlog::warn("{}: has not been run", one.name);
    return true;
  }
  const std::string status = record["status"], reason = record.value("reason", "");
  if (status == "outdated") spdlog::warn("{}: {}", one.name, reason);
  if (status == "failed")
    spdlog::warn("{}: {}; {} tells more", one.name, reason,
                 shown(folder.ofCase(one.name) / "log.txt"));
  return status == "outdated" || status == "failed";
}

int StudyCommand::writeAll(const Study& study, const StudyFolder& folder) const {
  std::vector<Json> records;
  int failed = 0;
  for (const StudyCase& one : study.cases) {
    records.push_back(table_ ? currentRecord(one, folder) : recordOf(one, folder));
    failed += tellIfBad(one, records.back(), folder) ? 1 : 0;
  }
  writeStudy(study, records, commandLine(), folder);
  if (common.json)
    printJson(studyJson(study, records, commandLine()));
  else
    std::cout << studyTable(study, records).markdown() << "\nwritten to " << printable(out_)
              << "\n";
  return failed > 0 ? kThresholdFailed : kDone;
}

}  // namespace

std::unique_ptr<Command> makeStudyCommand() { return std::make_unique<StudyCommand>(); }

}  // namespace softscope
