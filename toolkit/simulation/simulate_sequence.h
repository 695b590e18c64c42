// toolkit/simulation/simulate_sequence.h: an organ to a stereo sequence with ground truth.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "toolkit/progress.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

struct SimulatedSequence {
  int frames = 0;  // fewer than asked for where it was interrupted; 0: nothing was written
  int width_px = 0, height_px = 0;
  int tracked_points = 0;
  bool interrupted = false;
};

/// Writes the sequence folder `out` (docs/formats.md), whose frames are counted by
/// `listener.progress`. Without `overwrite` the folder must be new or empty. Throws OptionError and
/// InputError.
SimulatedSequence simulateSequence(SimulateOptions options, const TruthKinds& truth,
                                   const std::filesystem::path& out, bool overwrite,
                                   const WorkListener& listener = {});

/// One clip as the data set `layout` ships it (toolkit/simulation/dataset_layout.h), into the new
/// or empty folder `out`. Throws OptionError and InputError.
SimulatedSequence simulateLayout(SimulateOptions options, const std::string& layout,
                                 const std::filesystem::path& out,
                                 const WorkListener& listener = {});

}  // namespace softscope
