// toolkit/run/run_record.h: run.json of a reconstruction.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/stereo_rig.h"
#include "io/sequences/sequence_paths.h"
#include "io/settings/settings_binder.h"
#include "pipeline/frame_record.h"
#include "pipeline/reconstruction_backend.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/run/frame_outcomes.h"
#include "toolkit/run/overlay_finder.h"

namespace softscope {

/// Path and SHA-256 of every existing part; of a folder, the SHA-256 of names and contents of its
/// files. Further files of a calibration are calibration_2 …. `tracks`: pixels to be tracked; may
/// be empty. Throws InputError.
FactSheet::Json inputsJson(const SequencePaths& paths, const std::filesystem::path& stereo_model,
                           const std::filesystem::path& tracks = {});

class RunRecord {
 public:
  /// `inputs`: from inputsJson().
  RunRecord(const FactSheet::Json& inputs, const StereoCalibration& calibration,
            const ReconstructionBackend& backend, const std::vector<SettingInfo>& settings);

  /// Replaces the values recorded for these keys.
  void setConfiguration(const std::vector<SettingInfo>& settings);
  void add(const FrameRecord& record);
  void addWarning(const std::string& text) { warnings_.push_back(text); }
  void set(const std::string& key, const FactSheet::Json& value) { json_[key] = value; }

  /// Warnings about the whole run: frames not fused or fused
  /// with little evidence, a static scope. Included in json().
  std::vector<std::string> conclusions() const;
  FactSheet::Json json() const;
  /// The images of that frame, for what stands still in them.
  void addView(std::shared_ptr<const Frame> frame, const FrameRecord& record,
               const RectifiedRig& rig);
  /// Non-zero where structure stands still in the left image while the scope moves, if that is
  /// worth a warning; else empty.
  Mask overlay() const;
  /// One more frame whose images are those of the frame before.
  void addRepeated() { ++repeated_; }
  /// Short summary as text. `folder`: of the run; empty if nothing was written.
  FactSheet text(const std::string& folder) const;

 private:
  std::string statusText() const;
  int framesElsewhere() const;
  double meanOf(const std::vector<double>& values) const;

  FactSheet::Json json_;
  FactSheet::Json warnings_ = FactSheet::Json::array();
  std::map<std::string, int> frames_of_status_;
  std::map<int, int> frames_of_map_;  // fused ones
  FrameOutcomes outcomes_;
  OverlayFinder overlay_;
  std::map<std::string, double> elapsed_ms_;  // per stage, over all frames
  std::vector<double> backprojection_mm_, prediction_mm_, frame_ms_, matches_;
  int frames_ = 0, points_ = 0, nodes_ = 0;
  int most_points_ = 0;  // of any frame: the model in use at the end may be of another place
  int located_ = 0, scope_static_ = 0, doubtful_ = 0, disagreeing_ = 0, imprecise_ = 0,
      imprecise_tracks_ = 0, assumed_ = 0, repeated_ = 0;
};

}  // namespace softscope
