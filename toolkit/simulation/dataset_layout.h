// toolkit/simulation/dataset_layout.h: simulated clip in the folder layout of a data set.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "eval/simulation/sequence/simulator.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

/// One clip. Files are written atomically;
/// without finish() the destructor removes them.
class DatasetLayout {
 public:
  virtual ~DatasetLayout() = default;
  /// Number of frames supported by the layout, at most `frames`.
  virtual int frameCount(int frames) const { return frames; }
  virtual void addFrame(int index, const SimulatedFrame& frame, const Simulator& simulator) = 0;
  /// Completes the clip after the last frame.
  virtual void finish(const Simulator& simulator) = 0;
};

/// "stir2026", "surgt", "scared", …: values of --layout.
std::vector<std::string> datasetLayoutNames();

/// `folder`: of the clip (for SCARED: of the keyframe, with the images of the first frame). Throws
/// OptionError for an unknown name, a folder that is not empty, and options that the layout does
/// not support (lens distortion in STIR 2026 and SurgT, whose truth is on rectified images).
std::unique_ptr<DatasetLayout> makeDatasetLayout(const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 const SimulateOptions& options);

}  // namespace softscope
