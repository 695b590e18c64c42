// toolkit/depth/depth_record.cpp: options, frames, failures and warnings as JSON.
#include "toolkit/depth/depth_record.h"

#include <algorithm>
#include <cmath>

#include "io/calibrations/one_camera.h"
#include "toolkit/depth/frame_statistics.h"
#include "toolkit/record/setting_json.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

Json calibrationJson(const StereoCalibration& calibration, const RectifiedRig& rig) {
  if (isUncalibrated(calibration)) return nullptr;
  return {{"source", calibration.source},
          {"form", calibration.form},
          {"rectified", calibration.rectified},
          {"baseline_mm", hasOneCamera(calibration) ? Json() : Json(rig.baseline_mm)},
          {"rectified_focal_px", rig.left.fx_px},
          {"rectified_centre_px", {rig.left.cx_px, rig.left.cy_px}},
          {"disparity_offset_px", rig.disparity_offset_px}};
}

}  // namespace

DepthRecord::DepthRecord(const std::map<std::string, std::string>& inputs,
                         const StereoCalibration& calibration, const DepthEstimator& estimator,
                         bool raw_left) {
  json_["schema_version"] = 1;
  json_["softscope"] = versionText();
  json_["command"] = "depth";
  json_["inputs"] = inputs;
  json_["calibration"] = calibrationJson(calibration, estimator.rig());
  json_["backend"] = estimator.backend();
  json_["cloud_frame"] = raw_left ? "raw left" : "left";
  json_["interrupted"] = false;
  for (const std::string& warning : calibration.warnings) addWarning(warning);
}

void DepthRecord::addSettings(const std::vector<SettingInfo>& settings) {
  for (const SettingInfo& setting : settings) json_["options"][setting.key] = valueOf(setting);
}

void DepthRecord::addFrame(int index, double time_s, const DepthResult& measured, double write_ms) {
  json_["method"] = measured.method;
  Json frame{{"frame", index}};
  if (std::isfinite(time_s)) frame["time_s"] = time_s;
  frame.update(frameJson(measured));
  if (json_["calibration"].is_null()) {  // lengths are undefined
    frame["depth_mm"] = nullptr;
    frame["median_predicted_error_mm"] = nullptr;
  }
  frame["elapsed_ms"]["write"] = write_ms;
  frames_.push_back(std::move(frame));
  if (const std::string warning = rowWarning(measured); !warning.empty())
    addWarning("frame " + std::to_string(index) + ": " + warning);
}

void DepthRecord::addFailure(int index, const std::string& error) {
  failed_.push_back({{"frame", index}, {"error", error}});
}

void DepthRecord::addWarning(const std::string& text) { warnings_.push_back(text); }

FactSheet::Json DepthRecord::json() const {
  Json all = json_;
  all["frames_done"] = goodFrames();
  all["frames_failed"] = failures();
  all["mean_coverage"] = meanOf("coverage");
  all["frames"] = frames_;
  all["failed"] = failed_;
  all["warnings"] = warnings_;
  return all;
}

double DepthRecord::meanOf(const char* key) const {
  double sum = 0;
  for (const Json& frame : frames_) sum += frame.at(key).get<double>();
  return frames_.empty() ? 0 : sum / double(frames_.size());
}

double DepthRecord::meanTime(const std::string& stage) const {
  double sum = 0;
  for (const Json& frame : frames_) sum += frame["elapsed_ms"].value(stage, 0.0);
  return frames_.empty() ? 0 : sum / double(frames_.size());
}

FactSheet DepthRecord::text() const {
  const int count = goodFrames();
  const std::string method = json_["method"].get<std::string>();
  const bool files = method == "files";
  const std::string what = files ? " frame" : " pair";
  FactSheet facts((json_["calibration"].is_null() ? "disparity of " : "depth of ") +
                  std::to_string(count) + what + (count == 1 ? "" : "s") +
                  (files ? " from depth files" : " by " + method));
  facts.addLine("coverage", fixed(100 * meanOf("coverage"), 1) + " % of the unmasked pixels");
  if (count == 1) {
    const Json& depth = frames_[0]["depth_mm"];
    if (depth.is_object() && depth["median"].is_number() &&
        std::isfinite(depth["median"].get<double>()))
      facts.addLine("depth", fixed(depth["p1"], 1) + " to " + fixed(depth["p99"], 1) +
                                 " mm (1st to 99th percentile), median " +
                                 fixed(depth["median"], 1) + " mm");
  }
  if (count == 1 && frames_[0].contains("rows") && frames_[0]["rows"]["known"].get<bool>())
    facts.addLine("rows", "differ by " + fixed(frames_[0]["rows"]["mean_row_difference_px"], 2) +
                              " px on average" +
                              (frames_[0]["rows"]["removed"].get<bool>() ? ", removed" : ""));
  const std::string stereo_times = files ? ""
                                         : "rectify " + fixed(meanTime("rectify"), 0) + ", rows " +
                                               fixed(meanTime("rows"), 0) + ", match " +
                                               fixed(meanTime("disparity"), 0) + ", ";
  facts.addLine("time", stereo_times + "normals and cloud " +
                            fixed(meanTime("normals") + meanTime("cloud"), 0) + ", write " +
                            fixed(meanTime("write"), 0) + " ms a" + what);
  if (failures() > 0) facts.addLine("failed", std::to_string(failures()) + " frames, see above");
  return facts;
}

}  // namespace softscope
