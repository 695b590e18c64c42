// toolkit/benchmark/benchmark_runs.h: common parts of all benchmarks: search
// of clips, runs of softscope, and reading of their tracks and latencies.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/text/message.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

inline constexpr std::uint64_t kBenchmarkSeed = 2026;  // of all bootstraps

struct BenchmarkOptions {
  std::filesystem::path data;  // one clip, or a folder of clips
  std::filesystem::path out;
  std::vector<std::string> settings;  // KEY=VALUE arguments of the command
  bool force = false;                 // repeat clips that are complete
  int jobs = 1;                       // clips processed in parallel
};

/// Runs softscope with these arguments and appends its
/// output to a log. Returns the exit code. Thread-safe.
using RunSoftscope =
    std::function<int(const std::vector<std::string>& words, const std::filesystem::path& log)>;

/// One process.
struct BenchmarkRun {
  std::vector<std::string> words;
  std::filesystem::path log;
  bool done = false;    // complete since an earlier benchmark: skipped
  std::string failure;  // set by runAll(): reason for the missing result
};

/// Executes all runs that are not done, `jobs` in parallel. Returns false if `progress` stops it.
bool runAll(std::vector<BenchmarkRun>* runs, int jobs, const RunSoftscope& run_softscope,
            const Progress& progress);

/// `reconstruct CLIP --out RUN` with the `more` arguments and the settings.
BenchmarkRun reconstruction(const std::filesystem::path& clip, const std::filesystem::path& run,
                            const std::vector<std::string>& more, const BenchmarkOptions& options);
/// `depth INPUT… --out RUN --write depth` with the settings.
BenchmarkRun depthMeasurement(const std::vector<std::string>& input,
                              const std::filesystem::path& run, const BenchmarkOptions& options);

struct BenchmarkClip {
  std::string name;
  std::filesystem::path folder;
};

/// Folders at or below `data` for which `is_clip` is true, in natural order;
/// clips are not nested. The name of a clip is its path relative to `data`,
/// with `_` for `/`. Throws InputError with `expected` if there is none.
std::vector<BenchmarkClip> findClips(
    const std::filesystem::path& data,
    const std::function<bool(const std::filesystem::path&)>& is_clip, const std::string& expected);

/// Tracked points of a run in the frame of the rectified left camera, by
/// frame of the clip and index of the point; NaN without a measurement.
struct RunTracks {
  std::vector<std::vector<Eigen::Vector3d>> positions_mm;
  std::vector<std::vector<bool>> visible;
};

/// Throws InputError for an unreadable run.
RunTracks readRunTracks(const std::filesystem::path& run, std::size_t points, int frames);

/// Total time per row of frames.csv, ms.
std::vector<double> readLatencies(const std::filesystem::path& run);

/// An InputError excludes the clip; its text becomes the reason.
template <class Work>
void excludeOnError(std::string* reason, const Work& work) {
  try {
    work();
  } catch (const InputError& problem) {
    *reason = problem.what();
  }
}

/// Throws InputError with the first reason if all clips (name, excluded) are excluded.
template <class Clip>
void requireOneJudged(const std::vector<Clip>& clips, const std::filesystem::path& data) {
  for (const Clip& clip : clips)
    if (clip.excluded.empty()) return;
  throw InputError(say(shown(data), ": none of ", clips.size(),
                       " clips could be evaluated; the first: ", clips[0].excluded));
}

/// Clip excluded from a table, with the reason.
struct ExcludedClip {
  std::string name, why;
};

/// First and last lines of every table.
void addClips(const std::vector<std::string>& judged, const std::vector<ExcludedClip>& excluded,
              FactSheet* facts);
void addLatency(const std::vector<double>& latency_ms, const std::string& of_what,
                FactSheet* facts);

/// "key": mean over the clusters (clips, groups) named by `over`, with the 95 % interval of
/// a bootstrap over clusters, as one line of text; no line for fewer than three clusters.
void addClusterMean(const std::string& label, const std::string& key, const std::string& unit,
                    const std::string& over, const std::vector<double>& values, FactSheet* facts);

}  // namespace softscope
