// toolkit/simulation/simulate_sequence.h: stereo sequence with ground truth from an organ.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "toolkit/progress.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

struct SimulatedSequence {
  int frames = 0;  // smaller than requested after an interruption; 0: no output
  int width_px = 0, height_px = 0;
  int tracked_points = 0;
  bool interrupted = false;
};

/// Writes the sequence folder `out` (docs/formats.md);
/// `listener.progress` counts frames. Without `overwrite` the
/// folder must be new or empty. Throws OptionError and InputError.
SimulatedSequence simulateSequence(SimulateOptions options, const TruthKinds& truth,
                                   const std::filesystem::path& out, bool overwrite,
                                   const WorkListener& listener = {});

/// Writes one clip in the layout `layout` of a data set (toolkit/simulation/dataset_layout.h)
/// into the new or empty folder `out`. Throws OptionError and InputError.
SimulatedSequence simulateLayout(SimulateOptions options, const std::string& layout,
                                 const std::filesystem::path& out,
                                 const WorkListener& listener = {});

}  // namespace softscope
