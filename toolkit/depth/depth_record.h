// toolkit/depth/depth_record.h: summary.json of `softscope depth`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "io/settings/settings_binder.h"
#include "toolkit/depth/depth_estimator.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

class DepthRecord {
 public:
  /// `inputs`: paths by role.
  DepthRecord(const std::map<std::string, std::string>& inputs,
              const StereoCalibration& calibration, const DepthEstimator& estimator, bool raw_left);

  void addSettings(const std::vector<SettingInfo>& settings);
  void addFrame(int index, double time_s, const DepthResult& measured, double write_ms);
  void addFailure(int index, const std::string& error);
  void addWarning(const std::string& text);
  void setInterrupted() { json_["interrupted"] = true; }

  int goodFrames() const { return int(frames_.size()); }
  int failures() const { return int(failed_.size()); }
  FactSheet::Json json() const;
  /// Short summary as text.
  FactSheet text() const;

 private:
  double meanOf(const char* key) const;
  double meanTime(const std::string& stage) const;

  FactSheet::Json json_;
  FactSheet::Json frames_ = FactSheet::Json::array();
  FactSheet::Json failed_ = FactSheet::Json::array();
  FactSheet::Json warnings_ = FactSheet::Json::array();
};

}  // namespace softscope
