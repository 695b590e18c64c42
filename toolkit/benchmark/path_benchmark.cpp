#include "toolkit/benchmark/path_benchmark.h"

#include "core/error.h"
#include "io/datasets/stereomis_files.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/record/json_text.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

bool isStereoMisSequence(const fs::path& folder) {
  return isFile(folder / "StereoCalibration.ini") && isFile(folder / "groundtruth.txt");
}

struct PathClip {
  BenchmarkClip sequence;
  std::string words;  // argument of --frames; empty: all
  fs::path run;
};

void judgeRange(const PathClip& clip, PathClipResult* result) {
  const auto truth = readStereoMisPath(clip.sequence.folder / "groundtruth.txt");
  // True poses are those of the raw camera, poses of a run those of the rectified camera.
  const StereoCalibration calibration =
      SequenceReader(findSequence(clip.sequence.folder), {}).calibration();
  const Eigen::Isometry3d rectified_from_raw(Rectifier(calibration).rig().rectified_from_raw_left);
  judgePath(openJudgedRun(clip.run), truth, rectified_from_raw, result);
  const std::vector<double> latency_ms = readLatencies(clip.run);
  if (!latency_ms.empty()) result->latency_ms.assign(latency_ms.begin() + 1, latency_ms.end());
}

}  // namespace

PathBenchmarkResult benchmarkStereoMis(const BenchmarkOptions& options,
                                       const RunSoftscope& run_softscope,
                                       const Progress& progress) {
  PathBenchmarkResult result;
  result.title = "StereoMIS";
  result.protocol = "each range of test_split.csv (whole sequence without one) separately";
  std::vector<PathClip> clips;
  std::vector<BenchmarkRun> runs;
  for (const BenchmarkClip& sequence :
       findClips(options.data, isStereoMisSequence,
                 "StereoMIS; a folder with a video, StereoCalibration.ini and groundtruth.txt, or "
                 "a folder of such folders, is expected.")) {
    std::vector<FrameRange> ranges{FrameRange{}};
    PathClipResult entry;
    entry.name = entry.sequence = sequence.name;
    const fs::path split = sequence.folder / "test_split.csv";
    if (isFile(split)) excludeOnError(&entry.excluded, [&] { ranges = readStereoMisSplit(split); });
    for (const FrameRange& range : ranges) {
      const bool whole = range.end < 0;
      const std::string name =
          whole ? sequence.name : say(sequence.name, "_", numberedName(range.begin, ""));
      const std::string words = whole ? "" : say(range.begin, ":", range.end);
      const fs::path run = options.out / "clips" / name / "run";
      entry.name = name;
      result.clips.push_back(entry);
      clips.push_back({sequence, words, run});
      fs::create_directories(run.parent_path());
      runs.push_back(reconstruction(
          sequence.folder, run,
          whole ? std::vector<std::string>{} : std::vector<std::string>{"--frames", words},
          options));
      runs.back().done = runs.back().done || !entry.excluded.empty();
    }
  }
  result.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.stopped) return result;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    PathClipResult& judged = result.clips[i];
    if (judged.excluded.empty()) judged.excluded = runs[i].failure;
    if (judged.excluded.empty())
      excludeOnError(&judged.excluded, [&] { judgeRange(clips[i], &judged); });
  }
  requireOneJudged(result.clips, options.data);
  writeFile(options.out / "benchmark.json", jsonText(pathBenchmarkFacts(result).json()), true);
  return result;
}

}  // namespace softscope
