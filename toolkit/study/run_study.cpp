// toolkit/study/run_study.cpp: pending and running cases, and their results.
#include "toolkit/study/run_study.h"

#include <algorithm>
#include <list>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/text/message.h"
#include "toolkit/record/child_process.h"
#include "toolkit/record/machine.h"
#include "toolkit/record/shell_word.h"
#include "toolkit/study/study_case.h"
#include "toolkit/study/study_gpus.h"
#include "toolkit/study/study_outputs.h"
#include "toolkit/study/study_table.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr int kInterruptedExit = 130;  // of softscope

/// Cases with a sequence of their own come first, so that those that share one need not wait.
std::vector<const StudyCase*> pendingCases(const StudyRun& run) {
  std::vector<const StudyCase*> first, later;
  std::vector<std::pair<std::string, StudyValues>> sequences;
  for (const StudyCase& one : run.study.cases) {
    if (!run.again && finishedRecord(one, run.folder).is_object()) continue;
    const std::pair<std::string, StudyValues> sequence{one.sequence, one.simulate};
    const bool known = std::find(sequences.begin(), sequences.end(), sequence) != sequences.end();
    if (!known) sequences.push_back(sequence);
    (known ? later : first).push_back(&one);
  }
  first.insert(first.end(), later.begin(), later.end());
  return first;
}

int coresOf(const StudyRun& run) { return run.threads > 0 ? run.threads : describeMachine().cores; }

int jobCount(const StudyRun& run, std::size_t cases) {
  const int by_default =
      run.gpus.empty() ? describeMachine().cores : static_cast<int>(run.gpus.size());
  const int jobs = run.jobs > 0 ? run.jobs : by_default;
  return std::max(1, std::min(jobs, static_cast<int>(cases)));
}

/// A case as a process, with its GPU.
class RunningCase {
 public:
  RunningCase(const StudyRun& run, const StudyCase& study_case, int threads, GpuPool* gpus)
      : gpus_(gpus),
        gpu_(gpus->empty() ? 0 : gpus->take()),
        child_(start(run, study_case, threads)) {}
  RunningCase(const RunningCase&) = delete;
  RunningCase& operator=(const RunningCase&) = delete;
  ~RunningCase() {
    if (!gpus_->empty()) gpus_->giveBack(gpu_);
  }
  bool ended() { return child_.ended().has_value(); }
  void interrupt() { child_.interrupt(); }

 private:
  ChildProcess start(const StudyRun& run, const StudyCase& study_case, int threads) const;

  GpuPool* gpus_;
  std::size_t gpu_;
  ChildProcess child_;
};

ChildProcess RunningCase::start(const StudyRun& run, const StudyCase& study_case,
                                int threads) const {
  fs::create_directories(run.folder.ofCase(study_case.name));
  std::vector<std::string> words{run.program.string(),
                                 "study",
                                 run.file,
                                 "--case",
                                 study_case.name,
                                 "--out",
                                 run.folder.root.string(),
                                 "--threads",
                                 std::to_string(threads),
                                 "--quiet"};
  if (run.again) words.emplace_back("--force");
  std::vector<std::string> variables;
  if (!gpus_->empty()) variables.push_back("CUDA_VISIBLE_DEVICES=" + gpus_->name(gpu_));
  return ChildProcess(words, run.folder.root / "cases" / "study_log.txt", variables);
}

bool tellIfBad(const StudyRun& run, const StudyCase& one, const Json& record,
               const WorkListener& listener) {
  if (!record.is_object()) {
    listener.warn(one.name + ": has not been run");
    return true;
  }
  const std::string status = record["status"], reason = record.value("reason", "");
  if (status == "outdated") listener.warn(one.name + ": " + reason);
  if (status == "failed")
    listener.warn(one.name + ": " + reason + "; " + shown(run.folder.ofCase(one.name) / "log.txt") +
                  " tells more");
  return status == "outdated" || status == "failed";
}

}  // namespace

void StudyRun::validate() const {
  require(jobs >= 0 && jobs <= 1024, "`jobs=`", jobs,
          "must be 0 (one per GPU, without GPUs one per core) to 1024");
}

/// As shell text, without options that do not affect results, and without folders of the machine.
std::string StudyRun::command() const {
  const auto word = [](const fs::path& path) {
    const auto whole = path.lexically_normal();
    const auto name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
    return shellWord(path.is_absolute() ? name.string() : path.string());
  };
  return "softscope study " + word(file) + " --out " + word(folder.root);
}

CaseEnd runStudyCase(const StudyRun& run, const StudyCase& study_case,
                     const std::function<bool()>& interrupted, const WorkListener& listener) {
  if (!run.again && finishedRecord(study_case, run.folder).is_object()) return CaseEnd::kDone;
  const Json record =
      runCase(study_case, run.folder, coresOf(run), interrupted,
              [&](std::vector<std::string> words, const fs::path& log) -> std::optional<int> {
                words.insert(words.begin(), run.program.string());
                const int code = runToEnd(ChildProcess(words, log), interrupted);
                if (code == kInterruptedExit) return std::nullopt;
                return code;
              });
  if (!record.is_object()) return CaseEnd::kInterrupted;
  const std::string status = record["status"], reason = record.value("reason", "");
  if (status == "skipped") listener.warn(study_case.name + " is skipped: " + reason);
  if (status == "failed") listener.fail(study_case.name + ": " + reason);
  return status == "failed" ? CaseEnd::kFailed : CaseEnd::kDone;
}

bool runStudy(const StudyRun& run, const WorkListener& listener) {
  const auto waiting = pendingCases(run);
  const std::size_t all = run.study.cases.size(), finished = all - waiting.size();
  if (waiting.empty()) return true;
  if (finished > 0) listener.tell(say(finished, " of ", all, " cases are complete already"));
  const int jobs = jobCount(run, waiting.size()), total = static_cast<int>(waiting.size());
  const int threads = std::max(1, coresOf(run) / jobs);
  GpuPool gpus(run.gpus);
  std::list<RunningCase> running;
  std::size_t next = 0;
  int done = 0;
  bool progress_continues = reportProgress(listener.progress, done, total);
  while (!running.empty() || (next < waiting.size() && progress_continues)) {
    while (progress_continues && next < waiting.size() && static_cast<int>(running.size()) < jobs)
      running.emplace_back(run, *waiting[next++], threads, &gpus);
    for (auto child = running.begin(); child != running.end();) {
      const bool ended = child->ended();
      done += ended && progress_continues ? 1 : 0;
      child = ended ? running.erase(child) : std::next(child);
    }
    if (progress_continues && !reportProgress(listener.progress, done, total)) {
      progress_continues = false;
      for (RunningCase& child : running) child.interrupt();
    }
    sleepBriefly();
  }
  if (!progress_continues)
    listener.warn("interrupted: complete cases are kept; the same command continues");
  return progress_continues;
}

WrittenStudy writeStudyTable(const StudyRun& run, bool check, const WorkListener& listener) {
  WrittenStudy written;
  std::vector<Json> records;
  for (const StudyCase& one : run.study.cases) {
    records.push_back(check ? currentRecord(one, run.folder) : recordOf(one, run.folder));
    written.failed += tellIfBad(run, one, records.back(), listener) ? 1 : 0;
  }
  for (const std::string& warning : metricWarnings(run.study, records)) listener.warn(warning);
  writeStudy(run.study, records, run.command(), run.folder);
  written.record = studyJson(run.study, records, run.command());
  written.markdown = studyTable(run.study, records).markdown();
  return written;
}

}  // namespace softscope
