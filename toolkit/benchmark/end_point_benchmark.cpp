#include "toolkit/benchmark/end_point_benchmark.h"

#include <algorithm>

#include "core/error.h"
#include "eval/motion/tracking_scores.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/images/image_reader.h"
#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/benchmark/tattoo_marks.h"
#include "toolkit/record/json_text.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// left…/seqNN; the right view has the same parts.
bool isStirSequence(const fs::path& folder) {
  const std::string side = fs::absolute(folder).lexically_normal().parent_path().filename();
  return side.find("left") != std::string::npos && isFolder(folder / "frames") &&
         isFile(folder / "segmentation" / "icgstartseg.png");
}

std::vector<Eigen::Vector2d> marksIn(const fs::path& file) {
  std::vector<Eigen::Vector2d> centres;
  for (const TattooMark& mark : tattooMarks(readMask(file))) centres.push_back(mark.centre());
  if (centres.empty())
    throw InputError(shown(file) +
                     ": has no mark, but tattoos are expected. Is it the "
                     "segmentation?");
  return centres;
}

/// One view at the start or the end.
TattooView tattooView(const fs::path& sequence, const std::string& moment) {
  TattooView view;
  view.segmentation = readMask(sequence / "segmentation" / ("icg" + moment + "seg.png"));
  const std::string ending = "_icg" + moment + ".png";
  for (const fs::path& file : filesIn(sequence, {".png"})) {
    const std::string name = file.filename().string();
    if (name.size() < ending.size() ||
        name.compare(name.size() - ending.size(), ending.size(), ending) != 0)
      continue;
    view.infrared = readGrayImage(file);
    return view;
  }
  throw InputError(shown(sequence / ("..." + ending)) + ": is missing, but STIR has an infrared " +
                   "image of each view. Download it again.");
}

Eigen::Vector3d inImage(const Eigen::Vector2d& pixel) { return {pixel.x(), pixel.y(), 0}; }

class EndPointClip {
 public:
  EndPointClip(BenchmarkClip clip, const fs::path& out)
      : clip_(std::move(clip)), home_(out / "clips" / clip_.name) {
    result.name = clip_.name;
  }

  BenchmarkRun prepare(const BenchmarkOptions& options) {
    starts_ = marksIn(clip_.folder / "segmentation" / "icgstartseg.png");
    ends_ = marksIn(clip_.folder / "segmentation" / "icgendseg.png");
    fs::create_directories(home_);
    std::string csv = "id,u_px,v_px\n";
    for (std::size_t i = 0; i < starts_.size(); ++i)
      csv += say(i, ",", exactText(starts_[i].x()), ",", exactText(starts_[i].y()), "\n");
    writeFile(home_ / "points.csv", csv, true);
    return reconstruction(clip_.folder, home_ / "run", {"--track", (home_ / "points.csv").string()},
                          options);
  }

  void score() {
    SequenceReader reader(findSequence(clip_.folder), {});
    const StereoCalibration calibration = reader.calibration();
    const Eigen::Matrix3d raw_from_rectified =
        Rectifier(calibration).rig().rectified_from_raw_left.transpose();
    excludeOnError(&result.without_3d, [&] { readPositions(calibration); });
    const RunTracks tracks = readRunTracks(home_ / "run", starts_.size(), reader.totalCount());
    std::vector<Eigen::Vector3d> found, still, truth, found_mm, still_mm;
    for (const Eigen::Vector2d& end : ends_) truth.push_back(inImage(end));
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      still.push_back(inImage(starts_[i]));
      found.push_back(still.back());
      const Eigen::Vector3d last = raw_from_rectified * tracks.positions_mm.back()[i];
      const bool is_measured = last.allFinite() && last.z() > 0;
      if (is_measured) found.back() = inImage(projectPoint(calibration.left.pinhole, last));
      result.measured += is_measured;
      if (!result.without_3d.empty() || !starts_mm_[i].allFinite()) continue;
      still_mm.push_back(starts_mm_[i]);
      found_mm.push_back(is_measured ? last : starts_mm_[i]);
    }
    result.points = static_cast<int>(starts_.size());
    result.found_px = endPointDistances(found, truth);
    result.control_px = endPointDistances(still, truth);
    if (result.without_3d.empty()) {
      result.found_mm = endPointDistances(found_mm, ends_mm_);
      result.control_mm = endPointDistances(still_mm, ends_mm_);
    }
    const std::vector<double> latency_ms = readLatencies(home_ / "run");
    if (!latency_ms.empty()) result.latency_ms.assign(latency_ms.begin() + 1, latency_ms.end());
  }

  EndPointClipResult result;

 private:
  /// Throws InputError without a pair of tattoos at the start or the end.
  void readPositions(const StereoCalibration& calibration) {
    const fs::path right = findSequence(clip_.folder).right.parent_path().parent_path();
    const auto positions = [&](const std::string& moment) {
      return tattooPositions(tattooView(clip_.folder, moment), tattooView(right, moment),
                             calibration);
    };
    starts_mm_ = positions("start");
    ends_mm_ = positions("end");
    const auto unknown = [](const Eigen::Vector3d& position) { return !position.allFinite(); };
    ends_mm_.erase(std::remove_if(ends_mm_.begin(), ends_mm_.end(), unknown), ends_mm_.end());
    if (ends_mm_.empty() || std::all_of(starts_mm_.begin(), starts_mm_.end(), unknown))
      throw InputError(shown(right / "segmentation") +
                       ": no tattoo of the left view has a partner at the start and at the end");
  }

  BenchmarkClip clip_;
  fs::path home_;
  std::vector<Eigen::Vector2d> starts_, ends_;
  std::vector<Eigen::Vector3d> starts_mm_, ends_mm_;  // NaN: start without a partner
};

}  // namespace

EndPointBenchmarkResult benchmarkStirEnds(const BenchmarkOptions& options,
                                          const RunSoftscope& run_softscope,
                                          const Progress& progress) {
  std::vector<EndPointClip> clips;
  for (const BenchmarkClip& clip :
       findClips(options.data, isStirSequence,
                 "STIR; PATIENT/left.../seqNN with frames and segmentation/icgstartseg.png, or a "
                 "folder of patients, is expected."))
    clips.emplace_back(clip, options.out);
  std::vector<BenchmarkRun> runs(clips.size());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    runs[i].done = true;  // set to false below if there is work
    excludeOnError(&clips[i].result.excluded, [&] { runs[i] = clips[i].prepare(options); });
  }
  EndPointBenchmarkResult result;
  result.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.stopped) return result;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    std::string& excluded = clips[i].result.excluded;
    if (excluded.empty()) excluded = runs[i].failure;
    if (excluded.empty()) excludeOnError(&excluded, [&] { clips[i].score(); });
    result.clips.push_back(clips[i].result);
  }
  requireOneJudged(result.clips, options.data);
  writeFile(options.out / "benchmark.json", jsonText(endPointFacts(result).json()), true);
  return result;
}

}  // namespace softscope
