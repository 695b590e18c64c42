// toolkit/simulation/dataset_layout.h: a simulated clip in the form that a data set ships.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "eval/simulation/sequence/simulator.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

/// One clip. Each file appears whole or not at all; without finish() the destructor takes back what
/// was written.
class DatasetLayout {
 public:
  virtual ~DatasetLayout() = default;
  /// Of `frames` that were asked for, as many as the form holds.
  virtual int frameCount(int frames) const { return frames; }
  virtual void addFrame(int index, const SimulatedFrame& frame, const Simulator& simulator) = 0;
  /// For the frames that were added.
  virtual void finish(const Simulator& simulator) = 0;
};

/// "stir2026", "surgt", "scared", …: every name of --layout.
std::vector<std::string> datasetLayoutNames();

/// `folder`: of the clip (of SCARED: of the keyframe, whose images are those of the first frame).
/// Throws OptionError for an unknown name, a folder that isn't empty, and options that the form
/// can't hold (a lens that bends, in STIR 2026 and SurgT, whose truth lies on rectified images).
std::unique_ptr<DatasetLayout> makeDatasetLayout(const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 const SimulateOptions& options);

}  // namespace softscope
