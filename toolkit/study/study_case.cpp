// toolkit/study/study_case.cpp: simulation, reconstruction and evaluation of a case.
#include "toolkit/study/study_case.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/file_hash.h"
#include "io/files/file_lock.h"
#include "io/geometry/trajectory_file.h"
#include "io/text/message.h"
#include "toolkit/record/child_process.h"
#include "toolkit/record/json_text.h"
#include "toolkit/record/path_words.h"
#include "toolkit/record/version.h"
#include "toolkit/study/study_settings.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr std::size_t kFolderLetters = 12;  // length of the hash prefix in the name of a sequence

struct Interrupted {};

struct StepFailed {
  std::string step, reason;
};

Json readJson(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return Json::parse(stream, nullptr, /*allow_exceptions=*/false);
}

/// Hash of all files of a sequence, including truth, or of one file.
std::string sequenceDigest(const fs::path& sequence) {
  std::string all = sha256Of(sequence);
  for (const char* name :
       {"left", "right", "mask", "depth", "groundtruth", "groundtruth/mesh", "groundtruth/depth"})
    if (fs::is_directory(sequence / name)) all += name + sha256Of(sequence / name);
  return sha256OfBytes(all);
}

std::string simulationDigest(const StudyCase& study_case) {
  std::string all = versionText() + "\n" + simulationText(study_case);
  const auto mesh = study_case.simulate.find("organ.mesh");
  if (mesh != study_case.simulate.end() && mesh->second != "builtin") all += sha256Of(mesh->second);
  const auto picture = study_case.simulate.find("texture.picture");
  if (picture != study_case.simulate.end()) all += sha256Of(picture->second);
  return sha256OfBytes(all);
}

/// Last line of a log with `error`, else its last line.
std::string lastComplaint(const fs::path& log) {
  std::ifstream file(log);
  std::string last, complaint;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line;
    if (line.rfind("error: ", 0) == 0) complaint = line.substr(7);
  }
  return complaint.empty() ? last : complaint;
}

/// Values available to tables; the others remain in the folder of the case.
Json withoutDetails(Json json) {
  if (!json.is_object()) return json;
  for (const char* name : {"frames", "configuration", "inputs", "thresholds"})
    if (json.contains(name) && !json[name].is_number()) json.erase(name);
  return json;
}

Json recordWithStatus(const StudyCase& one, const char* status, const std::string& reason) {
  Json record{{"schema_version", 1}, {"softscope", versionText()}, {"name", one.name}};
  record["case"] = one.base;
  record["variant"] = one.variant;
  record["sweep"] = one.sweep;
  record["level"] = one.sweep.empty() ? Json() : Json(one.level);
  record["status"] = status;
  record["reason"] = reason;
  record["notes"] = one.notes;
  return record;
}

/// Removes files of killed processes. The caller holds
/// the lock of the sequence, so there is no other writer.
void removeParts(const fs::path& target) {
  const std::string prefix = target.filename().string() + ".part-";
  std::vector<fs::path> parts;
  for (const auto& entry : fs::directory_iterator(target.parent_path()))
    if (entry.path().filename().string().rfind(prefix, 0) == 0) parts.push_back(entry.path());
  for (const fs::path& part : parts) fs::remove_all(part);
}

class CaseRunner {
 public:
  CaseRunner(const StudyCase& study_case, const StudyFolder& folder, int threads,
             std::function<bool()> interrupted, RunCommand run_command)
      : case_(study_case),
        folder_(folder),
        threads_(threads),
        interrupted_(std::move(interrupted)),
        run_command_(std::move(run_command)),
        home_(folder.ofCase(study_case.name)) {}

  Json run();

 private:
  void step(const std::string& name, std::vector<std::string> words);
  fs::path sequence();
  void simulate(const fs::path& target);
  void waitFor(const FileLock& lock) const;
  std::string referenceOf(const fs::path& sequence) const;
  void judge(Json& record);

  const StudyCase& case_;
  const StudyFolder& folder_;
  int threads_;
  std::function<bool()> interrupted_;
  RunCommand run_command_;
  fs::path home_;
  Json seconds_ = Json::object();
};

void CaseRunner::step(const std::string& name, std::vector<std::string> words) {
  for (const std::string& word : {std::string("--threads"), std::to_string(threads_)})
    words.push_back(word);
  words.emplace_back("--quiet");
  const fs::path log = home_ / "log.txt";
  std::ofstream(log, std::ios::app) << "# " << name << "\n";
  const auto start = std::chrono::steady_clock::now();
  const std::optional<int> code = run_command_(words, log);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  seconds_[name + "_s"] = elapsed.count();
  if (!code || interrupted_()) throw Interrupted();
  if (*code == 0) return;
  const std::string complaint = lastComplaint(log);
  throw StepFailed{name, complaint.empty() || complaint[0] == '#'
                             ? "ended with exit code " + std::to_string(*code)
                             : complaint};
}

void CaseRunner::waitFor(const FileLock& lock) const {
  while (!lock.tryToHold()) {
    if (interrupted_()) throw Interrupted();
    sleepBriefly();
  }
}

/// Written under a temporary name first: other processes see complete sequences only.
void CaseRunner::simulate(const fs::path& target) {
  const fs::path part = target.string() + ".part-" + std::to_string(getpid());
  try {
    step("simulate", simulateWords(case_, part.string()));
  } catch (...) {
    fs::remove_all(part);
    throw;
  }
  std::error_code taken;  // another process, which missed the lock, has written the same bytes
  fs::rename(part, target, taken);
  if (taken) fs::remove_all(part);
}

fs::path CaseRunner::sequence() {
  if (!case_.sequence.empty()) return case_.sequence;
  fs::create_directories(folder_.sequences());
  const std::string made_by = simulationDigest(case_) + sha256Of(executablePath());
  const fs::path target = folder_.sequences() / sha256OfBytes(made_by).substr(0, kFolderLetters);
  const FileLock lock(target.string() + ".lock");
  waitFor(lock);
  removeParts(target);
  if (!fs::exists(target)) simulate(target);
  return target;
}

std::string CaseRunner::referenceOf(const fs::path& sequence) const {
  const auto named = case_.evaluate.find("reference");
  if (named != case_.evaluate.end()) return named->second;
  return fs::exists(sequence / "groundtruth") ? sequence.string() : "";
}

void CaseRunner::judge(Json& record) {
  const fs::path where = sequence();
  const fs::path run = home_ / "run", evaluation = home_ / "evaluation";
  step("reconstruct", reconstructWords(case_, where.string(), run.string()));
  record["run"] = withoutDetails(readJson(run / "run.json"));
  record["run"]["fused_share"] =
      record["run"].value("frames_fused", 0.0) / std::max(1.0, record["run"].value("frames", 0.0));
  const Trajectory path = readTrajectory(run / "trajectory.txt");
  if (path.size() > 1)
    record["run"]["scope_moved_mm"] =
        (path.back().world_from_left.translation() - path.front().world_from_left.translation())
            .norm();
  const std::string reference = referenceOf(where);
  if (reference.empty()) return;
  step("evaluate", evaluateWords(case_, run.string(), reference, evaluation.string()));
  record["evaluation"] = withoutDetails(readJson(evaluation / "evaluation.json"));
}

Json CaseRunner::run() {
  fs::create_directories(home_);
  fs::remove(folder_.record(case_.name));
  fs::remove(home_ / "log.txt");
  Json record = recordWithStatus(case_, "failed", "");
  record["threads"] = threads_;
  try {
    if (case_.skip.empty()) {
      record["digest"] = digestOf(case_);
      record["executable_sha256"] = sha256Of(executablePath());
      judge(record);
      record["status"] = "done";
    } else {
      record["status"] = "skipped";
      record["reason"] = case_.skip;
    }
  } catch (const Interrupted&) {
    return {};
  } catch (const StepFailed& failure) {
    record["reason"] = failure.step + ": " + withoutFolders(failure.reason, folder_.root.string());
  } catch (const Error& error) {
    record["reason"] = withoutFolders(error.what(), folder_.root.string());
  }
  record["seconds"] = seconds_;
  writeFile(folder_.record(case_.name), jsonText(record), true);
  return record;
}

}  // namespace

void StudyFolder::requireUsable() const {
  if (!fs::exists(root)) return;
  if (!fs::is_directory(root))
    throw OptionError("`out=`: " + shown(root) + " is a file, but must be a folder");
  if (fs::exists(marker())) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    if (entry.path().filename() != "cases")  // workflow tools create it before the study
      throw OptionError("`out=`: " + shown(root) + " holds " + shown(entry.path().filename()) +
                        ", but is no folder of a study; choose another one");
}

void StudyFolder::claim() const {
  fs::create_directories(marker().parent_path());
  if (!fs::exists(marker())) writeFile(marker(), "A folder of softscope study.\n", true);
}

std::string digestOf(const StudyCase& study_case) {
  std::string all = versionText() + "\n";
  all += study_case.sequence.empty() ? simulationDigest(study_case)
                                     : sequenceDigest(study_case.sequence);
  all += "\n" + reconstructionText(study_case) + evaluationText(study_case);
  for (const StudyValues* values : {&study_case.reconstruct, &study_case.evaluate})
    for (const char* key : {"right", "calibration", "mask", "reference"})
      if (const auto file = values->find(key); file != values->end())
        all += sequenceDigest(file->second);
  return sha256OfBytes(all);
}

Json recordOf(const StudyCase& study_case, const StudyFolder& folder) {
  const Json record = readJson(folder.record(study_case.name));
  if (!record.is_object() || !record.contains("status")) return {};
  for (const char* key : {"status", "reason", "digest", "name", "softscope"})
    if (record.contains(key) && !record[key].is_string()) return {};  // damaged: repeated
  return record;
}

Json currentRecord(const StudyCase& study_case, const StudyFolder& folder) {
  const Json record = recordOf(study_case, folder);
  if (!record.is_object()) return record;
  if (!study_case.skip.empty()) return recordWithStatus(study_case, "skipped", study_case.skip);
  const std::string digest = record.value("digest", "");
  std::string now;
  try {
    now = digestOf(study_case);
  } catch (const Error&) {  // unreadable input: the run has failed or would fail
  }
  if (digest == now) return record;
  return recordWithStatus(study_case, "outdated",
                          "its settings or inputs changed since it was run; run the study again");
}

Json finishedRecord(const StudyCase& study_case, const StudyFolder& folder) {
  if (!study_case.skip.empty()) return {};
  const Json record = recordOf(study_case, folder);
  if (!record.is_object() || record["status"] != "done") return {};
  return record.value("digest", "") == digestOf(study_case) ? record : Json();
}

Json runCase(const StudyCase& study_case, const StudyFolder& folder, int threads,
             const std::function<bool()>& interrupted, const RunCommand& run_command) {
  return CaseRunner(study_case, folder, threads, interrupted, run_command).run();
}

}  // namespace softscope
