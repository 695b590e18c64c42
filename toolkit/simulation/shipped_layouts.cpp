#include "toolkit/simulation/shipped_layouts.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "io/calibrations/calibration_writer.h"
#include "io/calibrations/shipped_calibrations.h"
#include "io/datasets/c3vd_files.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_writer.h"
#include "io/images/video_writer.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/simulation/layout_folder.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr long long kFirstStampS = 1700000000;  // time stamp in the names of D4D
constexpr double kTattooMm = 1;                 // radius of the infrared marks of STIR

std::string digits(long long number, int count) {
  std::ostringstream text;
  text << std::setw(count) << std::setfill('0') << number;
  return text.str();
}

template <class Image>
void putPng(LayoutFolder* folder, const std::string& name, const Image& image) {
  folder->make(name, [&](const fs::path& file) { writePng(file, image, false); });
}

/// Metres.
std::string poseLine(const TimedPose& pose, const std::string& first) {
  const Eigen::Vector3d t = pose.world_from_left.translation() / 1000;
  const Eigen::Quaterniond q(pose.world_from_left.linear());
  return say(first, " ", exactText(t.x()), " ", exactText(t.y()), " ", exactText(t.z()), " ",
             exactText(q.x()), " ", exactText(q.y()), " ", exactText(q.z()), " ", exactText(q.w()),
             "\n");
}

class ServCtLayout : public DatasetLayout {
 public:
  explicit ServCtLayout(const fs::path& folder) : folder_(folder) {}

  void addFrame(int index, const SimulatedFrame& frame, const Simulator& simulator) override {
    const std::string name = digits(index + 1, 3);
    putPng(&folder_, "Left_rectified/" + name + ".png", frame.pictures.left);
    putPng(&folder_, "Right_rectified/" + name + ".png", frame.pictures.right);
    folder_.put("Rectified_calibration/" + name + ".json", projectionJson(simulator.calibration()));
    Raster<float> disparity_px = frame.depth_mm;
    for (float& value : disparity_px.values)
      value = static_cast<float>(simulator.rig().disparityPx(value));
    folder_.make("Reference_CT/Disparity/" + name + ".png",
                 [&](const fs::path& file) { writeDisparityPng(file, disparity_px, false); });
    folder_.make("Reference_CT/DepthL/" + name + ".png", [&](const fs::path& file) {
      writeDepthPng(file, frame.depth_mm, kServCtStepMm, false);
    });
  }
  void finish(const Simulator& /*simulator*/) override { folder_.keep(); }

 private:
  LayoutFolder folder_;
};

class StereoMisLayout : public DatasetLayout {
 public:
  StereoMisLayout(const fs::path& folder, const SimulateOptions& options)
      : folder_(folder), rate_(options.simulation.frames_per_second), masks_(options.masks) {}

  void addFrame(int index, const SimulatedFrame& frame, const Simulator& /*simulator*/) override {
    const ColourImage both = stackedViews(frame.pictures);
    if (video_.empty())
      video_.emplace_back(folder_ / "video.mp4", both.width_px, both.height_px, rate_, false);
    video_[0].add(both);
    if (masks_ && !frame.instrument.empty() && index % 2 == 0)  // half rate
      putPng(&folder_, "masks/" + digits(index, 6) + "l.png", halfTissue(frame.instrument));
    poses_ += poseLine(frame.pose, std::to_string(index));
    ++count_;
  }
  void finish(const Simulator& simulator) override {
    folder_.make("video.mp4", [&](const fs::path& /*file*/) { video_[0].finish(); });
    folder_.put("StereoCalibration.ini", calibrationIni(simulator.calibration()));
    folder_.put("groundtruth.txt", poses_);
    folder_.put("test_split.csv", say("start,end\n0,", count_, "\n"));
    folder_.keep();
  }

 private:
  /// 255 for tissue, in half the size.
  static GrayImage halfTissue(const Mask& instrument) {
    GrayImage tissue((instrument.width_px + 1) / 2, (instrument.height_px + 1) / 2);
    for (int v = 0; v < tissue.height_px; ++v)
      for (int u = 0; u < tissue.width_px; ++u)
        tissue.at(u, v) = instrument.at(2 * u, 2 * v) == 0 ? 255 : 0;
    return tissue;
  }

  LayoutFolder folder_;
  double rate_;
  bool masks_;
  std::vector<VideoWriter> video_;
  std::string poses_;
  int count_ = 0;
};

/// Recording with one clip.
class D4dLayout : public DatasetLayout {
 public:
  explicit D4dLayout(const fs::path& folder) : folder_(folder) {}

  void addFrame(int /*index*/, const SimulatedFrame& frame,
                const Simulator& /*simulator*/) override {
    const auto nano = static_cast<long long>(std::llround(1e9 * frame.pose.time_s));
    const std::string stamp =
        say(digits(kFirstStampS + nano / 1000000000, 10), "_", digits(nano % 1000000000, 9));
    const std::string clip = "clips/Clip_1/";
    putPng(&folder_, clip + "left_images_rect/" + stamp + ".png", frame.pictures.left);
    putPng(&folder_, clip + "right_images_rect/" + stamp + ".png", frame.pictures.right);
    folder_.make(clip + "stereo_depth/" + stamp + ".npy",
                 [&](const fs::path& file) { writeDepthNpy(file, frame.depth_mm, false); });
  }
  void finish(const Simulator& simulator) override {
    const StereoCalibration calibration = simulator.calibration();
    folder_.put("camera_info/left_rect.yaml", cameraInfoYaml(calibration, false));
    folder_.put("camera_info/right_rect.yaml", cameraInfoYaml(calibration, true));
    folder_.keep();
  }

 private:
  LayoutFolder folder_;
};

/// PATIENT with left/seq01 and right/seq01.
class StirEndsLayout : public DatasetLayout {
 public:
  StirEndsLayout(const fs::path& folder, const SimulateOptions& options)
      : folder_(folder), rate_(options.simulation.frames_per_second) {}

  void addFrame(int index, const SimulatedFrame& frame, const Simulator& simulator) override {
    const StereoPair& pair = frame.pictures;
    if (videos_.empty())
      for (const char* side : {"left", "right"}) {
        folder_.makeFolder(say(side, "/seq01/frames"));
        videos_.emplace_back(folder_ / say(side, "/seq01/frames/clip.mp4"), pair.left.width_px,
                             pair.left.height_px, rate_, false);
      }
    videos_[0].add(pair.left);
    videos_[1].add(pair.right);
    end_ = tattooImages(frame, simulator.rig());
    if (index == 0) start_ = end_;
    end_ms_ = static_cast<int>(std::lround(1000 * frame.pose.time_s));
  }
  void finish(const Simulator& simulator) override {
    for (std::size_t i = 0; i < videos_.size(); ++i) {
      const std::string frames = say(i == 0 ? "left" : "right", "/seq01/frames/");
      folder_.make(say(frames, "0ms-", end_ms_, "ms.mp4"), [&](const fs::path& file) {
        videos_[i].finish();
        fs::rename(folder_ / (frames + "clip.mp4"), file);
      });
    }
    for (const int side : {0, 1}) {
      putTattoos(side, "0ms_icgstart", "icgstartseg", start_);
      putTattoos(side, say(end_ms_, "ms_icgend"), "icgendseg", end_);
    }
    folder_.put("calib.json", firstStirCalibrationJson(simulator.calibration()));
    folder_.keep();
  }

 private:
  /// Of both views.
  struct TattooImages {
    GrayImage segmentation[2], infrared[2];
  };

  /// Discs at the visible tracked points, bright on dark tissue in infrared light.
  static TattooImages tattooImages(const SimulatedFrame& frame, const RectifiedRig& rig) {
    TattooImages images;
    for (const int side : {0, 1}) {
      images.segmentation[side] = GrayImage(rig.left.width_px, rig.left.height_px, 0);
      images.infrared[side] = toGray(side == 0 ? frame.pictures.left : frame.pictures.right);
      for (std::uint8_t& value : images.infrared[side].values) value /= 2;
    }
    for (const VisiblePoint& point : visiblePoints(frame, rig)) {
      const double radius_px = rig.left.fx_px * kTattooMm / point.depth_mm;
      const Eigen::Vector2d right_px = point.left_px - Eigen::Vector2d(point.disparity_px, 0);
      if (point.in_left) addTattoo(point.left_px, radius_px, 0, &images);
      if (point.in_right) addTattoo(right_px, radius_px, 1, &images);
    }
    return images;
  }
  static void addTattoo(const Eigen::Vector2d& centre_px, double radius_px, int side,
                        TattooImages* images) {
    GrayImage& segmentation = images->segmentation[side];
    for (int v = 0; v < segmentation.height_px; ++v)
      for (int u = 0; u < segmentation.width_px; ++u) {
        if ((Eigen::Vector2d(u, v) - centre_px).norm() > radius_px) continue;
        segmentation.at(u, v) = 255;
        images->infrared[side].at(u, v) |= 128;  // halved before
      }
  }

  void putTattoos(int side, const std::string& infrared, const std::string& segmentation,
                  const TattooImages& images) {
    const std::string home = say(side == 0 ? "left" : "right", "/seq01/");
    folder_.make(home + infrared + ".png",
                 [&](const fs::path& file) { writePng(file, images.infrared[side], false); });
    folder_.make(home + "segmentation/" + segmentation + ".png",
                 [&](const fs::path& file) { writePng(file, images.segmentation[side], false); });
  }

  LayoutFolder folder_;
  double rate_;
  std::vector<VideoWriter> videos_;
  TattooImages start_, end_;
  int end_ms_ = 0;
};

class HamlynLayout : public DatasetLayout {
 public:
  explicit HamlynLayout(const fs::path& folder) : folder_(folder) {}

  void addFrame(int index, const SimulatedFrame& frame, const Simulator& /*simulator*/) override {
    const std::string name = digits(index, 10) + ".png";
    putPng(&folder_, "image01/" + name, frame.pictures.left);
    putPng(&folder_, "image02/" + name, frame.pictures.right);
  }
  void finish(const Simulator& simulator) override {
    folder_.put("calibration.yaml", calibrationYaml(simulator.calibration()));
    folder_.keep();
  }

 private:
  LayoutFolder folder_;
};

/// Left view only, with its depth.
class C3vdLayout : public DatasetLayout {
 public:
  explicit C3vdLayout(const fs::path& folder) : folder_(folder) {}

  void addFrame(int index, const SimulatedFrame& frame, const Simulator& /*simulator*/) override {
    putPng(&folder_, digits(index, 4) + "_color.png", frame.pictures.left);
    folder_.make(digits(index, 4) + "_depth.tiff", [&](const fs::path& file) {
      writeDepthTiff(file, frame.depth_mm, kC3vdStepMm, false);
    });
    poses_.push_back(frame.pose.world_from_left);
  }
  void finish(const Simulator& simulator) override {
    folder_.put("pose.txt", c3vdPathText(poses_));
    folder_.put("calibration.yaml", calibrationYaml(simulator.calibration()));
    folder_.keep();
  }

 private:
  LayoutFolder folder_;
  std::vector<Eigen::Isometry3d> poses_;
};

}  // namespace

std::unique_ptr<DatasetLayout> makeShippedLayout(const std::string& name, const fs::path& folder,
                                                 const SimulateOptions& options) {
  if (name == "servct") return std::make_unique<ServCtLayout>(folder);
  if (name == "stereomis") return std::make_unique<StereoMisLayout>(folder, options);
  if (name == "d4d") return std::make_unique<D4dLayout>(folder);
  if (name == "stir") return std::make_unique<StirEndsLayout>(folder, options);
  if (name == "hamlyn") return std::make_unique<HamlynLayout>(folder);
  if (name == "c3vd") return std::make_unique<C3vdLayout>(folder);
  return nullptr;
}

}  // namespace softscope
