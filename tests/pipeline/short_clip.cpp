#include "short_clip.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "eval/simulation/tissue/organ_mesh.h"
#include "fusion/surface_search.h"
#include "pipeline/cpu_backend.h"

namespace softscope::test {
namespace {

ShortClip makeClip(SimulationOptions options, int frames) {
  options.scope.width_px = 240;
  options.scope.height_px = 180;
  options.organ.cells_per_side = 40;
  Simulator simulator(makeOrganMesh(options.organ, 1), options);
  ShortClip clip;
  clip.calibration.rectified = true;
  clip.calibration.left.pinhole = clip.calibration.right.pinhole = simulator.rig().left;
  clip.calibration.right_from_left.translation().x() = -simulator.rig().baseline_mm;
  clip.calibration.source = "simulated";
  for (int i = 0; i < frames; ++i) {
    clip.truth.push_back(simulator.frame(i));
    Frame frame;
    frame.index = i;
    frame.time_s = clip.truth.back().pose.time_s;
    frame.pair = clip.truth.back().pictures;
    clip.frames.push_back(std::move(frame));
  }
  for (std::size_t i = 0; i < simulator.trackPoints().size(); ++i) {
    const Eigen::Vector2d pixel =
        projectPoint<double>(simulator.rig().left, clip.truth.front().tracks_world_mm[i]);
    clip.seeds.push_back({static_cast<int>(i), pixel.x(), pixel.y()});
  }
  return clip;
}

}  // namespace

const ShortClip& shortClip() {
  static const ShortClip clip = makeClip({}, 6);
  return clip;
}

const ShortClip& clipWithAWithdrawal() {
  SimulationOptions options;
  options.frames_per_second = 5;
  options.event = {"withdraw", 0.3, 0.9, 12, 40};
  options.deformation.breathing.amplitude_mm = 0;
  options.deformation.heartbeat.amplitude_mm = 0;
  options.deformation.push.amplitude_mm = 0;
  static const ShortClip clip = makeClip(options, 10);
  return clip;
}

const ShortClip& clipWithASweep() {
  SimulationOptions options;
  options.scope.focal_px = 630;
  options.organ.length_mm = 140;
  options.camera.distance_mm = 60;
  options.camera.amplitude_mm = 44;
  options.camera.period_s = 2.4;
  static const ShortClip clip = [&] {
    ShortClip made = makeClip(options, 23);
    for (std::size_t back = 1; back < 23; back += 2) {
      made.frames.push_back(made.frames[22 - back]);
      made.frames.back().index = static_cast<int>(made.frames.size()) - 1;
      made.truth.push_back(made.truth[22 - back]);
    }
    return made;
  }();
  return clip;
}

ReconstructionOptions smallOptions() {
  ReconstructionOptions options;
  options.depth.stereo.disparity_max_px = 63;
  return options;
}

std::shared_ptr<const Frame> sharing(const Frame& frame) {
  return {std::shared_ptr<const Frame>(), &frame};
}

UpcomingFrames framesAfter(const std::vector<Frame>& frames, std::size_t index) {
  UpcomingFrames upcoming;
  for (std::size_t i = index + 1; i < frames.size(); ++i) upcoming.push_back(sharing(frames[i]));
  return upcoming;
}

Reconstructor reconstructorOf(const ShortClip& clip, const ReconstructionOptions& options) {
  return {makeCpuBackend(clip.calibration, options), options};
}

Frame flatFrame(const ShortClip& clip, int index, std::uint8_t level) {
  Frame frame = clip.frames.front();
  frame.index = index;
  for (ColourImage* picture : {&frame.pair.left, &frame.pair.right})
    for (Rgb8& pixel : picture->values) pixel = {level, level, level};
  return frame;
}

Frame elsewhere(const Frame& frame) {
  Frame turned = frame;
  for (ColourImage* picture : {&turned.pair.left, &turned.pair.right}) {
    const ColourImage upright = *picture;
    for (int v = 0; v < upright.height_px; ++v)
      std::copy_n(upright.row(upright.height_px - 1 - v), upright.width_px, picture->row(v));
  }
  return turned;
}

double trackErrorMm(const FrameRecord& record, const SimulatedFrame& truth) {
  double sum = 0;
  int count = 0;
  for (const TrackedPosition& point : record.tracked) {
    if (!point.position_mm.allFinite()) continue;
    const Eigen::Vector3d found = record.world_from_left.inverse() * point.position_mm;
    const Eigen::Vector3d right = truth.pose.world_from_left.inverse() *
                                  truth.tracks_world_mm[static_cast<std::size_t>(point.id)];
    sum += (found - right).norm();
    ++count;
  }
  EXPECT_GT(count, static_cast<int>(0.8 * record.tracked.size()));
  return sum / count;
}

std::string bytesOf(const PointModel& model) {
  std::string bytes;
  const auto add = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  add(model.positions_mm);
  add(model.colours);
  add(model.weights);
  return bytes;
}

void expectModel(const PointModel& expected, const std::string& backend, const PointModel& found) {
  if (backend == "cpu") {
    EXPECT_TRUE(bytesOf(found) == bytesOf(expected));
    return;
  }
  const double few = 1e-3 * static_cast<double>(expected.size());
  EXPECT_NEAR(static_cast<double>(found.size()), static_cast<double>(expected.size()), few);
  const std::vector<std::int32_t> nearest =
      CpuSurfaceSearch().nearestPoints(expected, found.positions_mm);
  int apart = 0;
  float most_mm = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3f& as_mm = expected.positions_mm[static_cast<std::size_t>(nearest[i])];
    const float apart_mm = (as_mm - found.positions_mm[i]).norm();
    most_mm = std::max(most_mm, apart_mm);
    apart += !(apart_mm <= 0.003F);
  }
  EXPECT_LT(apart, few) << "of " << found.size() << ", up to " << most_mm << " mm";
}

}  // namespace softscope::test
