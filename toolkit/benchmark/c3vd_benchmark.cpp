#include "toolkit/benchmark/c3vd_benchmark.h"

#include "core/error.h"
#include "core/not_measured.h"
#include "eval/images/dense_answer.h"
#include "eval/images/model_drawing.h"
#include "io/datasets/c3vd_files.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/geometry/depth_files.h"
#include "io/sequences/sequence_paths.h"
#include "io/text/message.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/record/json_text.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/sequence_calibration.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr int kHoldOutEvery = 8;
constexpr float kFarthestKnownMm = 99.999F;  // the last step also stands for larger depths

bool isC3vdSequence(const fs::path& folder) { return isFile(folder / "pose.txt"); }

/// Truth of one sequence.
class C3vdTruth {
 public:
  explicit C3vdTruth(const fs::path& folder)
      : rig_(Rectifier(sequenceCalibration(folder)).rig()),
        depth_files_(findSequence(folder).depth_files),
        path_(readC3vdPath(folder / "pose.txt")) {
    if (path_.size() != depth_files_.size())
      throw InputError(say(shown(folder / "pose.txt"), ": has ", path_.size(), " poses, but there ",
                           "are ", depth_files_.size(), " images; one per image is expected."));
  }

  const RectifiedRig& rig() const { return rig_; }
  int count() const { return static_cast<int>(path_.size()); }
  std::map<int, Eigen::Isometry3d> poses() const {
    std::map<int, Eigen::Isometry3d> poses;
    for (std::size_t i = 0; i < path_.size(); ++i) poses[static_cast<int>(i)] = path_[i];
    return poses;
  }
  Eigen::Isometry3d motion(int from, int to) const {
    return path_[static_cast<std::size_t>(from)].inverse() * path_[static_cast<std::size_t>(to)];
  }
  Raster<float> depthMm(int frame) const {
    Raster<float> depth_mm = readDepth(depth_files_[static_cast<std::size_t>(frame)], kC3vdStepMm);
    for (float& value : depth_mm.values)
      if (value > kFarthestKnownMm) value = kNotMeasured<float>;
    return depth_mm;
  }

 private:
  RectifiedRig rig_;
  std::vector<fs::path> depth_files_;
  std::vector<Eigen::Isometry3d> path_;
};

HeldOutDepths judgeHeldOutDepths(const JudgedRun& run, const C3vdTruth& truth) {
  HeldOutDepths depths;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const int before = run.frames[i], frame = before + 1;
    if (frame % kHoldOutEvery != 1 || frame >= truth.count()) continue;
    const auto model = run.models.find(before);
    if (model == run.models.end() || !run.isPlaced(before)) {
      ++depths.missing;
      continue;
    }
    const Eigen::Isometry3d pose = run.trajectory[i].world_from_left * truth.motion(before, frame);
    const Raster<float> drawn_mm =
        drawModel(readModel(model->second).model, truth.rig().left, pose).depth_mm;
    const Raster<float> true_mm = truth.depthMm(frame);
    depths.drawn.push_back(depthErrors(drawn_mm, true_mm));
    depths.dense.push_back(depthErrors(fillFromNearest(drawn_mm), true_mm));
    depths.control.push_back(depthErrors(truth.depthMm(before), true_mm));
  }
  return depths;
}

HeldOutDepths judgeSequence(const BenchmarkClip& clip, const fs::path& folder,
                            PathClipResult* result) {
  const C3vdTruth truth(clip.folder);
  const JudgedRun run = openJudgedRun(folder);
  judgePath(run, truth.poses(), Eigen::Isometry3d(truth.rig().rectified_from_raw_left), result);
  const std::vector<double> latency_ms = readLatencies(folder);
  if (!latency_ms.empty()) result->latency_ms.assign(latency_ms.begin() + 1, latency_ms.end());
  return judgeHeldOutDepths(run, truth);
}

}  // namespace

C3vdBenchmarkResult benchmarkC3vd(const BenchmarkOptions& options,
                                  const RunSoftscope& run_softscope, const Progress& progress) {
  const std::vector<BenchmarkClip> clips = findClips(
      options.data, isC3vdSequence,
      "C3VD; a folder with NNNN_color.png, NNNN_depth.tiff, pose.txt and calibration.yaml, or a "
      "folder of such folders, is expected.");
  std::vector<BenchmarkRun> runs;
  for (const BenchmarkClip& clip : clips) {
    const fs::path run = options.out / "clips" / clip.name / "run";
    fs::create_directories(run.parent_path());
    runs.push_back(
        reconstruction(clip.folder, run, {"--hold-out", std::to_string(kHoldOutEvery)}, options));
  }
  C3vdBenchmarkResult result;
  result.path.title = "C3VD";
  result.path.protocol =
      "depth files are the input of the run; frames 1, 9, 17, ... are held out; the depth of each "
      "is that of the model of the previous frame, drawn from its pose moved by the true motion; "
      "true depths of 100 mm are ignored; mean per frame, per clip, over the clips; path: the "
      "other frames";
  result.path.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.path.stopped) return result;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    PathClipResult judged;
    judged.name = judged.sequence = clips[i].name;
    judged.excluded = runs[i].failure;
    HeldOutDepths depths;
    if (judged.excluded.empty())
      excludeOnError(&judged.excluded, [&] {
        depths = judgeSequence(clips[i], options.out / "clips" / clips[i].name / "run", &judged);
      });
    result.path.clips.push_back(judged);
    result.depths.push_back(depths);
  }
  requireOneJudged(result.path.clips, options.data);
  writeFile(options.out / "benchmark.json", jsonText(c3vdBenchmarkFacts(result).json()), true);
  return result;
}

}  // namespace softscope
