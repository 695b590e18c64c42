// tests/fuzz/trajectory_fuzz.cpp: trajectories and timestamps.
#include <cmath>

#include "fuzz/fuzz_target.h"
#include "io/geometry/trajectory_file.h"
#include "io/sequences/timestamps_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view text = textOf(data, size);
  if (const auto found = answerOf([&] { return parseTrajectory(text, "fuzz"); })) {
    mustHold(!found->empty());
    for (const TimedPose& pose : *found)
      mustHold(std::abs(pose.world_from_left.linear().determinant() - 1) < 1e-9);
    // Lengths beyond all sense are read, but not written.
    const auto again = answerOf([&] { return trajectoryText(*found); });
    if (again) mustHold(parseTrajectory(*again, "again").size() == found->size());
  }
  if (const auto times_s = answerOf([&] { return parseTimestamps(text, "fuzz"); }))
    for (std::size_t i = 1; i < times_s->size(); ++i) mustHold((*times_s)[i] > (*times_s)[i - 1]);
  return 0;
}
