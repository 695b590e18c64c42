#include "toolkit/simulation/dataset_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/nearest_name.h"
#include "eval/simulation/camera/scope_lens.h"
#include "io/calibrations/calibration_writer.h"
#include "io/datasets/stir_files.h"
#include "io/datasets/surgt_files.h"
#include "io/files/atomic_file.h"
#include "io/files/new_files.h"
#include "io/geometry/xyz_files.h"
#include "io/images/image_writer.h"
#include "io/images/video_writer.h"
#include "io/text/message.h"
#include "toolkit/simulation/layout_folder.h"
#include "toolkit/simulation/shipped_layouts.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr int kSurgtTargets = 3;
constexpr double kSurgtTargetMm = 6;  // side of the square of tissue inside a box

void requirePinhole(const std::string& name, const SimulateOptions& options) {
  require(options.simulation.scope.lens().distortion.isZero(), "`layout=`", name,
          "its truth lies on rectified images; leave scope.k1 … p2 at 0");
}

class StirLayout : public DatasetLayout {
 public:
  StirLayout(const fs::path& folder, const SimulateOptions& options)
      : folder_(folder), rate_(options.simulation.frames_per_second) {}

  void addFrame(int index, const SimulatedFrame& frame, const Simulator& simulator) override {
    const StereoPair& pair = frame.pictures;
    for (const char* name : {"left.mp4", "right.mp4"})
      if (videos_.size() < 2)
        videos_.emplace_back(folder_ / name, pair.left.width_px, pair.left.height_px, rate_, false);
    videos_[0].add(pair.left);
    videos_[1].add(pair.right);
    for (const VisiblePoint& point : visiblePoints(frame, simulator.rig()))
      annotations_[index].push_back({point.left_px.x(), point.left_px.y(), point.disparity_px,
                                     point.in_left, point.in_right});
  }

  void finish(const Simulator& simulator) override {
    const char* const names[] = {"left.mp4", "right.mp4"};
    for (std::size_t i = 0; i < videos_.size(); ++i)
      folder_.make(names[i], [&](const fs::path& /*file*/) { videos_[i].finish(); });
    std::vector<Eigen::Vector2d> queries;
    for (const StirPoint& point : annotations_.begin()->second)
      queries.emplace_back(point.left_u_px, point.left_v_px);
    folder_.put("calib.json", stirCalibrationJson(simulator.calibration()));
    folder_.put("queries.json", stirQueriesJson(queries));
    folder_.put("annotations.json", stirAnnotationsJson(annotations_));
    folder_.keep();
  }

 private:
  LayoutFolder folder_;
  double rate_;
  std::vector<VideoWriter> videos_;
  StirAnnotations annotations_;
};

class SurgtLayout : public DatasetLayout {
 public:
  SurgtLayout(const fs::path& folder, const SimulateOptions& options)
      : folder_(folder), rate_(options.simulation.frames_per_second) {}

  void addFrame(int /*index*/, const SimulatedFrame& frame, const Simulator& simulator) override {
    const ColourImage both = stackedViews(frame.pictures);
    if (video_.empty())
      video_.emplace_back(folder_ / "video.mp4", both.width_px, both.height_px, rate_, false);
    video_[0].add(both);
    const std::vector<VisiblePoint> points = visiblePoints(frame, simulator.rig());
    if (targets_.empty()) chooseTargets(points.size());
    for (Target& target : targets_)
      target.frames.push_back(frameOf(points[target.point], simulator.rig()));
  }

  void finish(const Simulator& simulator) override {
    folder_.make("video.mp4", [&](const fs::path& /*file*/) { video_[0].finish(); });
    SurgtInfo info;
    info.width_px = simulator.rig().left.width_px;
    info.height_px = simulator.rig().left.height_px;
    info.video = "video.mp4";
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      info.truth.push_back(say("gt_rectified_", i, ".yaml"));
      folder_.put(info.truth.back(), surgtTruthYaml(targets_[i].frames));
    }
    folder_.put("info.yaml", surgtInfoYaml(info));
    folder_.make("calibration.yaml", [&](const fs::path& file) {
      writeCalibration(file, simulator.calibration(), false);
    });
    folder_.keep();
  }

 private:
  struct Target {
    std::size_t point;
    std::vector<SurgtFrame> frames;
  };

  /// Evenly spread over the tracked points.
  void chooseTargets(std::size_t points) {
    for (std::size_t i = 0; i < kSurgtTargets && i < points; ++i)
      targets_.push_back({points * (2 * i + 1) / (2 * kSurgtTargets), {}});
  }

  static SurgtFrame frameOf(const VisiblePoint& point, const RectifiedRig& rig) {
    SurgtFrame frame;
    frame.visible_in_both = point.in_left && point.in_right;
    if (!frame.visible_in_both) return frame;
    const double side = rig.left.fx_px * kSurgtTargetMm / point.depth_mm;
    const double u = point.left_px.x() - side / 2, v = point.left_px.y() - side / 2;
    frame.boxes = {{{u, v, side, side}, {u - point.disparity_px, v, side, side}}};
    return frame;
  }

  LayoutFolder folder_;
  double rate_;
  std::vector<VideoWriter> video_;
  std::vector<Target> targets_;
};

class ScaredLayout : public DatasetLayout {
 public:
  ScaredLayout(const fs::path& folder, const SimulateOptions& options)
      : folder_(folder), lens_(options.simulation.scope.lens()) {}

  int frameCount(int /*frames*/) const override { return 1; }  // a keyframe is one pair

  void addFrame(int /*index*/, const SimulatedFrame& frame, const Simulator& simulator) override {
    folder_.make("Left_Image.png",
                 [&](const fs::path& file) { writePng(file, frame.pictures.left, false); });
    folder_.make("Right_Image.png",
                 [&](const fs::path& file) { writePng(file, frame.pictures.right, false); });
    folder_.make("left_depth_map.tiff", [&](const fs::path& file) {
      writePointRaster(file, pointsOf(frame.depth_mm), false);
    });
    folder_.make("endoscope_calibration.yaml", [&](const fs::path& file) {
      writeCalibration(file, simulator.calibration(), false);
    });
  }

  void finish(const Simulator& /*simulator*/) override { folder_.keep(); }

 private:
  PointRaster pointsOf(const Raster<float>& depth_mm) const {
    PointRaster points(depth_mm.width_px, depth_mm.height_px,
                       Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    for (int v = 0; v < depth_mm.height_px; ++v)
      for (int u = 0; u < depth_mm.width_px; ++u)
        if (std::isfinite(depth_mm.at(u, v)))
          points.at(u, v) =
              (lens_.ray(u, v) * static_cast<double>(depth_mm.at(u, v))).cast<float>();
    return points;
  }

  LayoutFolder folder_;
  ScopeLens lens_;
};

}  // namespace

std::vector<std::string> datasetLayoutNames() {
  return {"stir2026", "surgt", "scared", "servct", "stereomis", "d4d", "stir", "hamlyn", "c3vd"};
}

std::unique_ptr<DatasetLayout> makeDatasetLayout(const std::string& name, const fs::path& folder,
                                                 const SimulateOptions& options) {
  const std::vector<std::string> names = datasetLayoutNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    const std::string nearest = nearestName(name, names);
    throw OptionError(
        "`layout=`: `" + name + "` is no known form" +
        (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)") +
        ". Give stir2026, surgt, scared, servct, stereomis, d4d, stir, hamlyn or c3vd");
  }
  if (name == "scared") return std::make_unique<ScaredLayout>(folder, options);
  requirePinhole(name, options);
  if (auto shipped = makeShippedLayout(name, folder, options)) return shipped;
  if (name == "stir2026") return std::make_unique<StirLayout>(folder, options);
  return std::make_unique<SurgtLayout>(folder, options);
}

}  // namespace softscope
