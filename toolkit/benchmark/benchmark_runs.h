// toolkit/benchmark/benchmark_runs.h: what the benchmarks of all data sets share: clips, runs of
// softscope on them, tracks and latencies of these runs.
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

inline constexpr std::uint64_t kBenchmarkSeed = 2026;  // of every bootstrap

struct BenchmarkOptions {
  std::filesystem::path data;  // one clip, or a folder of clips
  std::filesystem::path out;
  std::vector<std::string> settings;  // KEY=VALUE for the command that is run
  bool force = false;                 // do clips again that are done
  int jobs = 1;                       // clips at the same time
};

/// Runs softscope with these words, its output appended to a log; returns its exit code. May be
/// called from several threads at once.
using RunSoftscope =
    std::function<int(const std::vector<std::string>& words, const std::filesystem::path& log)>;

/// One process.
struct BenchmarkRun {
  std::vector<std::string> words;
  std::filesystem::path log;
  bool done = false;    // by an earlier benchmark: not run again
  std::string failure;  // set by runAll(): why it has no result
};

/// Runs all that aren't done, `jobs` at the same time. Returns false where `progress` stopped it.
bool runAll(std::vector<BenchmarkRun>* runs, int jobs, const RunSoftscope& run_softscope,
            const Progress& progress);

/// `reconstruct CLIP --out RUN`, with `more` words and the settings.
BenchmarkRun reconstruction(const std::filesystem::path& clip, const std::filesystem::path& run,
                            const std::vector<std::string>& more, const BenchmarkOptions& options);
/// `depth INPUT… --out RUN --write depth`, likewise.
BenchmarkRun depthMeasurement(const std::vector<std::string>& input,
                              const std::filesystem::path& run, const BenchmarkOptions& options);

struct BenchmarkClip {
  std::string name;
  std::filesystem::path folder;
};

/// The folders below `data`, itself included, that `is_clip` takes, in natural order; none inside
/// another. A clip's name is its path below `data`, `_` for `/`. Throws InputError with `expected`
/// where there is none.
std::vector<BenchmarkClip> findClips(
    const std::filesystem::path& data,
    const std::function<bool(const std::filesystem::path&)>& is_clip, const std::string& expected);

/// Followed points of a run in the frame of the rectified left camera, by frame of the clip and
/// number of the point; NaN where the run has none.
struct RunTracks {
  std::vector<std::vector<Eigen::Vector3d>> positions_mm;
  std::vector<std::vector<bool>> visible;
};

/// Throws InputError where the run can't be read.
RunTracks readRunTracks(const std::filesystem::path& run, std::size_t points, int frames);

/// Of each frame of frames.csv, ms.
std::vector<double> readLatencies(const std::filesystem::path& run);

/// What is wrong with a clip excludes it: its InputError becomes the reason.
template <class Work>
void excludeOnError(std::string* reason, const Work& work) {
  try {
    work();
  } catch (const InputError& problem) {
    *reason = problem.what();
  }
}

/// Throws InputError with the first reason where all clips (name, excluded) are excluded.
template <class Clip>
void requireOneJudged(const std::vector<Clip>& clips, const std::filesystem::path& data) {
  for (const Clip& clip : clips)
    if (clip.excluded.empty()) return;
  throw InputError(say(shown(data), ": not one of ", clips.size(),
                       " clips could be judged; the first: ", clips[0].excluded));
}

/// A clip that has no part in a table, and why.
struct ExcludedClip {
  std::string name, why;
};

/// Lines that every table begins and ends with.
void addClips(const std::vector<std::string>& judged, const std::vector<ExcludedClip>& excluded,
              FactSheet* facts);
void addLatency(const std::vector<double>& latency_ms, const std::string& of_what,
                FactSheet* facts);

/// null for NaN.
FactSheet::Json orNull(double value);
/// "key": mean over the clusters (clips, groups) that `over` names and 95 % interval of a bootstrap
/// over them, for people in one line; without the line for fewer than three.
void addClusterMean(const std::string& label, const std::string& key, const std::string& unit,
                    const std::string& over, const std::vector<double>& values, FactSheet* facts);

}  // namespace softscope
