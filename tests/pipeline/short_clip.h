// tests/pipeline/short_clip.h: a small simulated clip with its truth, and a run over it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/stereo_rig.h"
#include "eval/simulation/sequence/simulator.h"
#include "pipeline/reconstructor.h"

namespace softscope::test {

/// 240 x 180 pixels of a breathing, pushed organ before a moving scope.
struct ShortClip {
  StereoCalibration calibration;
  std::vector<Frame> frames;
  std::vector<SimulatedFrame> truth;
  std::vector<TrackSeed> seeds;
};

/// Made once a program.
const ShortClip& shortClip();

/// The same organ at rest and at five frames a second; the scope is withdrawn in frames 2 to 5 and
/// comes back 12 mm aside, turned by 40 degrees. Made once a program.
const ShortClip& clipWithAWithdrawal();

/// A narrow view that moves aside by more than its width over a long organ, and back, twice as
/// fast. Made once a program.
const ShortClip& clipWithASweep();

/// Options for a clip of this size: fewer disparities, smaller search.
ReconstructionOptions smallOptions();

/// Of a frame that lives as long as the program.
std::shared_ptr<const Frame> sharing(const Frame& frame);
/// Those that come after that one.
UpcomingFrames framesAfter(const std::vector<Frame>& frames, std::size_t index);

Reconstructor reconstructorOf(const ShortClip& clip, const ReconstructionOptions& options);

/// A frame without anything to match on: every pixel has this grey level.
Frame flatFrame(const ShortClip& clip, int index, std::uint8_t level);

/// Upside down: depth, but no tissue that is known.
Frame elsewhere(const Frame& frame);

/// Mean distance of tracked points from the truth, in the current camera frame.
double trackErrorMm(const FrameRecord& record, const SimulatedFrame& truth);

/// Bytes of positions, colours and weights, to compare runs.
std::string bytesOf(const PointModel& model);

/// The same bytes where every frame was computed on the processor. A GPU takes the solver's sums in
/// another order: energies differ by 1e-15 of their size, so one point in thousands falls on the
/// other side of a threshold, and all others lie within 0.003 mm, below which differences between
/// two surfaces mean nothing.
void expectModel(const PointModel& expected, const std::string& backend, const PointModel& found);

}  // namespace softscope::test
