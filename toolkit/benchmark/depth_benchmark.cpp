#include "toolkit/benchmark/depth_benchmark.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/calibrations/calibration_reader.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/xyz_files.h"
#include "io/text/message.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/record/json_text.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// True depth of the rectified left image, with its rig.
struct DepthTruth {
  Raster<float> depth_mm;
  RectifiedRig rig;
};

/// Stereo pair, the arguments of its measurement, its ground truth.
struct BenchmarkPair {
  std::string name, group;
  std::function<BenchmarkRun(const fs::path& run)> prepare;
  std::function<DepthTruth()> truth;
};

Raster<float> measuredDepth(const fs::path& run) {
  for (const char* name : {"depth.pfm", "000000_depth.pfm"})
    if (isFile(run / name)) return readDepth(run / name);
  throw InputError(shown(run) + ": contains no depth.pfm. Run again with `overwrite=`.");
}

/// Processing time per pair without writing, ms.
double depthLatency(const fs::path& run) {
  std::ifstream stream(run / "summary.json");
  const auto json = nlohmann::json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("frames") || json["frames"].empty())
    return Statistics::kNone;
  double sum_ms = 0;
  for (const auto& [stage, ms] : json["frames"][0]["elapsed_ms"].items())
    if (stage != "write" && ms.is_number()) sum_ms += ms.get<double>();
  return sum_ms;
}

DepthBenchmarkResult benchmarkPairs(const std::vector<BenchmarkPair>& pairs,
                                    DepthBenchmarkResult result, const BenchmarkOptions& options,
                                    const RunSoftscope& run_softscope, const Progress& progress) {
  std::vector<BenchmarkRun> runs;
  for (const BenchmarkPair& pair : pairs) {
    const fs::path home = options.out / "clips" / pair.name;
    fs::create_directories(home);
    runs.push_back(pair.prepare(home / "run"));
    result.pairs.emplace_back();
    result.pairs.back().name = pair.name;
    result.pairs.back().group = pair.group;
  }
  result.stopped = !runAll(&runs, options.jobs, run_softscope, progress);
  if (result.stopped) return result;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    DepthPairResult& judged = result.pairs[i];
    judged.excluded = runs[i].failure;
    if (!judged.excluded.empty()) continue;
    const fs::path run = options.out / "clips" / judged.name / "run";
    excludeOnError(&judged.excluded, [&] {
      const DepthTruth truth = pairs[i].truth();
      judgeDepthPair(measuredDepth(run), truth.depth_mm, truth.rig, &judged);
      judged.latency_ms = depthLatency(run);
    });
  }
  requireOneJudged(result.pairs, options.data);
  writeFile(options.out / "benchmark.json", jsonText(depthBenchmarkFacts(result).json()), true);
  return result;
}

bool isScaredKeyframe(const fs::path& folder) {
  return isFile(folder / "Left_Image.png") && isFile(folder / "endoscope_calibration.yaml");
}

DepthTruth scaredTruth(const fs::path& keyframe) {
  const PointRaster points = readPointRaster(keyframe / "left_depth_map.tiff");
  StereoCalibration calibration = readCalibration(keyframe / "endoscope_calibration.yaml");
  for (PinholeCamera* camera : {&calibration.left.pinhole, &calibration.right.pinhole}) {
    if (camera->width_px == 0) camera->width_px = points.width_px;
    if (camera->height_px == 0) camera->height_px = points.height_px;
  }
  const PinholeCamera& left = calibration.left.pinhole;
  if (left.width_px != points.width_px || left.height_px != points.height_px)
    throw InputError(say(shown(keyframe / "left_depth_map.tiff"), ": has ", points.width_px, " x ",
                         points.height_px, " pixels, but the calibration is for ", left.width_px,
                         " x ", left.height_px, ". Unpack the keyframe again."));
  const RectifiedRig rig = Rectifier(calibration).rig();
  return {rectifiedDepth(points, rig), rig};
}

/// The name of the parent folder is the data set: dataset_8/keyframe_1.
std::string parentName(const fs::path& folder) {
  const fs::path own = folder.has_filename() ? folder : folder.parent_path();
  const std::string name = fs::absolute(own).parent_path().filename().string();
  return name.empty() ? "all" : name;
}

bool isServCtExperiment(const fs::path& folder) {
  return isFolder(folder / "Left_rectified") && isFolder(folder / "Right_rectified");
}

/// Calibration and truth have the name of the pair.
BenchmarkPair servCtPair(const fs::path& experiment, const std::string& name,
                         const std::string& group, const fs::path& left, const fs::path& reference,
                         const BenchmarkOptions& options) {
  const std::string stem = left.stem().string();
  const fs::path right = experiment / "Right_rectified" / left.filename();
  const fs::path calibration = experiment / "Rectified_calibration" / (stem + ".json");
  const fs::path truth = reference / "DepthL" / (stem + ".png");
  const auto prepare = [=, &options](const fs::path& run) {
    return depthMeasurement({left.string(), right.string(), "--calibration", calibration.string()},
                            run, options);
  };
  const auto read = [=] {
    DepthTruth out{readDepth(truth, kServCtStepMm), {}};
    StereoCalibration rectified = readCalibration(calibration);
    for (PinholeCamera* camera : {&rectified.left.pinhole, &rectified.right.pinhole}) {
      camera->width_px = out.depth_mm.width_px;
      camera->height_px = out.depth_mm.height_px;
    }
    out.rig = Rectifier(rectified).rig();
    return out;
  };
  return {name, group, prepare, read};
}

}  // namespace

DepthBenchmarkResult benchmarkServCt(const BenchmarkOptions& options,
                                     const RunSoftscope& run_softscope, const Progress& progress) {
  std::vector<BenchmarkPair> pairs;
  DepthBenchmarkResult result;
  result.title = "SERV-CT";
  for (const BenchmarkClip& clip :
       findClips(options.data, isServCtExperiment,
                 "SERV-CT; an experiment's folder with Left_rectified, Right_rectified, "
                 "Rectified_calibration and Reference_CT, or a folder of such folders, is "
                 "expected.")) {
    const bool has_ct = isFolder(clip.folder / "Reference_CT");
    const std::string reference = has_ct ? "Reference_CT" : "Reference_RGB";
    for (const fs::path& left : filesIn(clip.folder / "Left_rectified", {".png"}))
      pairs.push_back(servCtPair(clip.folder, clip.name + "_" + left.stem().string(), clip.name,
                                 left, clip.folder / reference, options));
    if (!has_ct) result.warnings.push_back(clip.name + ": evaluated against Reference_RGB");
  }
  if (pairs.empty()) throw InputError(shown(options.data) + ": Left_rectified contains no PNG.");
  result.protocol = "pairs as shipped, against DepthL of Reference_CT (mm, 16 bits / 256)";
  return benchmarkPairs(pairs, std::move(result), options, run_softscope, progress);
}

DepthBenchmarkResult benchmarkScared(const BenchmarkOptions& options,
                                     const RunSoftscope& run_softscope, const Progress& progress) {
  std::vector<BenchmarkPair> pairs;
  DepthBenchmarkResult result;
  result.title = "SCARED";
  result.protocol =
      "keyframes only, because the depth between them is interpolated; points of "
      "left_depth_map.tiff are rotated into the rectified camera and projected, the nearest is "
      "kept";
  for (const BenchmarkClip& clip :
       findClips(options.data, isScaredKeyframe,
                 "SCARED; a folder with Left_Image.png, Right_Image.png, "
                 "endoscope_calibration.yaml and left_depth_map.tiff, or a folder of such folders, "
                 "is expected.")) {
    const std::string group = parentName(clip.folder);
    pairs.push_back({clip.name, group,
                     [clip, &options](const fs::path& run) {
                       return depthMeasurement({clip.folder.string()}, run, options);
                     },
                     [clip] { return scaredTruth(clip.folder); }});
    if (group == "dataset_4" || group == "dataset_5")
      result.warnings.push_back(clip.name + ": data sets 4 and 5 are known to be mis-calibrated");
  }
  return benchmarkPairs(pairs, std::move(result), options, run_softscope, progress);
}

}  // namespace softscope
