#include "toolkit/benchmark/benchmark_runs.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "eval/statistics/cohort.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/run/run_reader.h"
#include "toolkit/run/table_reader.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestClip = 4;  // levels below the folder of the data set

std::string lastLineOf(const fs::path& log) {
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  return last;
}

BenchmarkRun runOf(std::vector<std::string> words, const fs::path& run, bool is_complete,
                   const BenchmarkOptions& options) {
  words.insert(words.end(), {"--out", run.string(), "--quiet"});
  if (isFolder(run)) words.emplace_back("--force");
  for (const std::string& setting : options.settings) {
    words.emplace_back("--set");
    words.push_back(setting);
  }
  return {words, run.parent_path() / "log.txt", is_complete && !options.force, {}};
}

/// Queue of runs shared by several threads.
class RunQueue {
 public:
  RunQueue(std::vector<BenchmarkRun>* runs, const RunSoftscope& run_softscope,
           const Progress& progress)
      : runs_(*runs), run_softscope_(run_softscope), progress_(progress) {
    for (const BenchmarkRun& run : runs_) total_ += !run.done;
  }

  bool work(int jobs) {
    if (!tell(0)) return false;
    std::vector<std::thread> threads;
    for (int i = 1; i < std::min(jobs, total_); ++i) threads.emplace_back([this] { workOn(); });
    workOn();
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    return !stopped_;
  }

 private:
  void workOn() {
    try {
      for (std::size_t i = next_++; i < runs_.size() && !stopped_; i = next_++) {
        if (runs_[i].done) continue;
        runOne(&runs_[i]);
        tell(1);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      failure_ = std::current_exception();
      stopped_ = true;
    }
  }

  void runOne(BenchmarkRun* run) {
    fs::create_directories(run->log.parent_path());
    const int code = run_softscope_(run->words, run->log);
    if (code != 0)
      run->failure = say(run->words[0], " ended with exit code ", code, ": ", lastLineOf(run->log));
  }

  bool tell(int more) {
    const std::lock_guard<std::mutex> lock(mutex_);
    finished_ += more;
    if (!reportProgress(progress_, finished_, total_)) stopped_ = true;
    return !stopped_;
  }

  std::vector<BenchmarkRun>& runs_;
  const RunSoftscope& run_softscope_;
  const Progress& progress_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopped_{false};
  int finished_ = 0, total_ = 0;
};

void collectClips(const fs::path& folder, const std::string& name, int depth,
                  const std::function<bool(const fs::path&)>& is_clip,
                  std::vector<BenchmarkClip>* clips) {
  if (is_clip(folder)) {
    const fs::path own = folder.has_filename() ? folder : folder.parent_path();
    clips->push_back({name.empty() ? own.filename().string() : name, folder});
    return;
  }
  if (depth == 0) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!isFolder(entry.path()) || fs::is_symlink(entry.symlink_status())) continue;
    const std::string part = entry.path().filename().string();
    collectClips(entry.path(), name.empty() ? part : name + "_" + part, depth - 1, is_clip, clips);
  }
}

}  // namespace

bool runAll(std::vector<BenchmarkRun>* runs, int jobs, const RunSoftscope& run_softscope,
            const Progress& progress) {
  return RunQueue(runs, run_softscope, progress).work(jobs);
}

BenchmarkRun reconstruction(const fs::path& clip, const fs::path& run,
                            const std::vector<std::string>& more, const BenchmarkOptions& options) {
  std::vector<std::string> words{"reconstruct", clip.string()};
  words.insert(words.end(), more.begin(), more.end());
  const bool has_tracks = std::find(more.begin(), more.end(), "--track") != more.end();
  const bool is_complete = isFile(run / "run.json") && !isFile(run / "checkpoint.bin") &&
                           (!has_tracks || isFile(run / "tracks.csv"));
  return runOf(words, run, is_complete, options);
}

BenchmarkRun depthMeasurement(const std::vector<std::string>& input, const fs::path& run,
                              const BenchmarkOptions& options) {
  std::vector<std::string> words{"depth"};
  words.insert(words.end(), input.begin(), input.end());
  words.insert(words.end(), {"--write", "depth"});
  return runOf(words, run, isFile(run / "summary.json"), options);
}

std::vector<BenchmarkClip> findClips(const fs::path& data,
                                     const std::function<bool(const fs::path&)>& is_clip,
                                     const std::string& expected) {
  requireFolder(data);
  std::vector<BenchmarkClip> clips;
  collectClips(data, "", kDeepestClip, is_clip, &clips);
  if (clips.empty()) throw InputError(say(shown(data), ": contains no clip of ", expected));
  std::sort(clips.begin(), clips.end(), [](const BenchmarkClip& a, const BenchmarkClip& b) {
    return naturallyBefore(a.name, b.name);
  });
  return clips;
}

RunTracks readRunTracks(const fs::path& run_folder, std::size_t points, int frames) {
  const JudgedRun run = openJudgedRun(run_folder);
  const Eigen::Vector3d nowhere =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  RunTracks tracks;
  tracks.positions_mm.assign(static_cast<std::size_t>(frames),
                             std::vector<Eigen::Vector3d>(points, nowhere));
  tracks.visible.assign(static_cast<std::size_t>(frames), std::vector<bool>(points, false));
  std::map<int, Eigen::Isometry3d> left_from_world;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    left_from_world[run.frames[i]] = run.trajectory[i].world_from_left.inverse();
  for (const TrackSample& sample : readTracks(run.tracks)) {
    const auto pose = left_from_world.find(sample.frame);
    if (pose == left_from_world.end() || sample.frame >= frames || sample.id < 0 ||
        sample.id >= static_cast<int>(points) || !sample.position_mm.allFinite())
      continue;
    const auto f = static_cast<std::size_t>(sample.frame), q = static_cast<std::size_t>(sample.id);
    tracks.positions_mm[f][q] = pose->second * sample.position_mm;
    tracks.visible[f][q] = sample.visible;
  }
  return tracks;
}

std::vector<double> readLatencies(const fs::path& run) {
  const fs::path file = run / "frames.csv";
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  const NumberTable table(text, shown(file), {"frame", "total_ms"}, {});
  std::vector<double> all;
  for (std::size_t row = 0; row < table.rows(); ++row) all.push_back(table.at(row, 1));
  return all;
}

void addClips(const std::vector<std::string>& judged, const std::vector<ExcludedClip>& excluded,
              FactSheet* facts) {
  FactSheet::Json left_out = FactSheet::Json::array();
  for (const ExcludedClip& clip : excluded) {
    left_out.push_back({{"clip", clip.name}, {"why", clip.why}});
    facts->warn("excluded: " + clip.name + ": " + clip.why);
  }
  facts->add(
      "clips",
      std::to_string(judged.size()) + " judged, " + std::to_string(excluded.size()) + " excluded",
      "clips", judged);
  facts->addQuietly("excluded", left_out);
}

void addLatency(const std::vector<double>& latency_ms, const std::string& of_what,
                FactSheet* facts) {
  const std::vector<double> latency = percentiles(latency_ms, {50, 95, 99});
  if (!latency_ms.empty())
    facts->addLine("latency", "p50 " + fixed(latency[0], 0) + ", p95 " + fixed(latency[1], 0) +
                                  ", p99 " + fixed(latency[2], 0) + " ms " + of_what);
  facts->addQuietly("latency_ms", {{"p50", orNull(latency[0])},
                                   {"p95", orNull(latency[1])},
                                   {"p99", orNull(latency[2])},
                                   {"frames", latency_ms.size()}});
}

void addClusterMean(const std::string& label, const std::string& key, const std::string& unit,
                    const std::string& over, const std::vector<double>& values, FactSheet* facts) {
  const CohortSummary clips = summariseCohort(values, kBenchmarkSeed);
  facts->addQuietly(key, {{"mean", orNull(clips.mean)},
                          {"ci_95", {orNull(clips.mean_ci.low), orNull(clips.mean_ci.high)}},
                          {"count", clips.count}});
  if (std::isfinite(clips.mean_ci.low))
    facts->addLine(label, fixed(clips.mean, 4) + unit + " [" + fixed(clips.mean_ci.low, 4) + ", " +
                              fixed(clips.mean_ci.high, 4) + "] (95 %, bootstrap over " + over +
                              ")");
}

}  // namespace softscope
