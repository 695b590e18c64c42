// toolkit/run/run_record.cpp: inputs with hashes, settings, frames and times.
#include "toolkit/run/run_record.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/tolerance.h"
#include "eval/statistics/statistics.h"
#include "io/calibrations/calibration_files.h"
#include "io/calibrations/one_camera.h"
#include "io/files/file_hash.h"
#include "toolkit/record/machine.h"
#include "toolkit/record/setting_json.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

Json machineJson(const ReconstructionBackend& backend) {
  const Machine machine = describeMachine();
  return {{"backend", backend.name()},
          {"device", backend.name() == "cpu" ? machine.processor : backend.device()},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"threads", threadCount()}};
}

Json rowsJson(const RowPlane& rows) {
  return {
      {"centre_px", rows.centre_px}, {"per_column", rows.per_column}, {"per_row", rows.per_row}};
}

Json rigJson(const RectifiedRig& rig, bool one_camera) {
  return {{"width_px", rig.left.width_px},
          {"height_px", rig.left.height_px},
          {"focal_px", rig.left.fx_px},
          {"centre_px", {rig.left.cx_px, rig.left.cy_px}},
          {"baseline_mm", one_camera ? Json() : Json(rig.baseline_mm)}};
}

constexpr double kDoubtful = 0.5;    // confidence of a frame
constexpr double kWarnShare = 0.1;   // smallest share of frames for a warning
constexpr double kFewPoints = 0.01;  // points per pixel; a usual model has 0.1 and more

}  // namespace

Json inputsJson(const SequencePaths& paths, const fs::path& stereo_model, const fs::path& tracks) {
  std::vector<std::pair<std::string, fs::path>> parts{
      {"left", paths.left}, {"right", paths.right}, {"stereo", paths.stereo}};
  std::string part = "calibration";
  int number = 1;
  for (const fs::path& file : locateCalibration(paths.calibration).files) {
    parts.emplace_back(part, file);
    part = "calibration_" + std::to_string(++number);
  }
  parts.insert(parts.end(), {{"mask", paths.mask},
                             {"depth", paths.depth},
                             {"timestamps", paths.timestamps},
                             {"tracks", tracks},
                             {"stereo_model", stereo_model}});
  Json inputs = Json::object();
  for (const auto& [name, path] : parts)
    if (!path.empty()) inputs[name] = {{"path", path.string()}, {"sha256", sha256Of(path)}};
  return inputs;
}

RunRecord::RunRecord(const Json& inputs, const StereoCalibration& calibration,
                     const ReconstructionBackend& backend,
                     const std::vector<SettingInfo>& settings) {
  json_["schema_version"] = 1;
  json_["softscope"] = versionText();
  json_["command"] = "reconstruct";
  json_["machine"] = machineJson(backend);
  json_["inputs"] = inputs;
  json_["rectified_rig"] = rigJson(backend.rig(), hasOneCamera(calibration));
  json_["rows"] = rowsJson(calibration.rows);
  setConfiguration(settings);
  for (const std::string& warning : calibration.warnings) addWarning(warning);
}

void RunRecord::setConfiguration(const std::vector<SettingInfo>& settings) {
  for (const SettingInfo& setting : settings)
    json_["configuration"][setting.key] = valueOf(setting);
}

void RunRecord::add(const FrameRecord& record) {
  ++frames_;
  ++frames_of_status_[toString(record.status)];
  outcomes_.set(record.frame, outcomeOf(record.status));
  for (const auto& [stage, stage_ms] : record.times) elapsed_ms_[stage] += stage_ms;
  frame_ms_.push_back(record.elapsed_ms());
  located_ += record.pose.found;
  scope_static_ += record.pose.found && record.pose.scope_static;
  if (record.join) {
    frames_of_map_[record.join->into] += frames_of_map_[record.join->from];
    frames_of_map_.erase(record.join->from);
  }
  if (!record.fused()) return;
  ++frames_of_map_[record.map];
  points_ = record.points;
  most_points_ = std::max(most_points_, points_);
  if (record.warp.nodes > 0) nodes_ = record.warp.nodes;
  doubtful_ += record.confidence() < kDoubtful;
  imprecise_ += record.depth.precise_share < kDoubtful;
  imprecise_tracks_ += record.precise_tracks_share < kDoubtful;
  if (record.status == FrameStatus::kStarted) return;
  matches_.push_back(record.pose.inliers);
  assumed_ += !record.pose.found;
  disagreeing_ += record.evidence.view.agreement() < kDoubtful;
  if (std::isfinite(record.fusion.corrected.mean_mm))
    backprojection_mm_.push_back(record.fusion.corrected.mean_mm);
  if (std::isfinite(record.evidence.predicted.mean_mm))
    prediction_mm_.push_back(record.evidence.predicted.mean_mm);
}

std::vector<std::string> RunRecord::conclusions() const {
  std::vector<std::string> all;
  const int left_out = frames_ - outcomes_.count(FusionOutcome::kFused);
  if (left_out > kWarnShare * frames_)
    all.push_back(std::to_string(left_out) + " of " + std::to_string(frames_) +
                  " frames were not fused (" + statusText() +
                  ") and did not update the model; the reasons are in frames.csv, column reason");
  const Json& rig = json_.at("rectified_rig");
  const double pixels = rig.at("width_px").get<double>() * rig.at("height_px").get<double>();
  if (outcomes_.count(FusionOutcome::kFused) > 0 && most_points_ < kFewPoints * pixels)
    all.push_back("the model has " + std::to_string(most_points_) +
                  " points, fewer than 1 % of the " + fixed(pixels, 0) +
                  " pixels of an image: it is no model of the tissue; possible causes: a "
                  "calibration of another scope (above all the rotation and translation of the "
                  "right camera), exchanged or mirrored views, images without texture");
  const auto warnOfImprecise = [&](int frames, const char* what) {
    if (frames <= kWarnShare * frames_) return;
    all.push_back(
        "in " + std::to_string(frames) + " of " + std::to_string(frames_) +
        " frames, less than half of the " + what + " accurate to " + fixed(kTolerableErrorMm, 0) +
        " mm (95 %), so their confidence is below " + fixed(kDoubtful, 1) +
        "; possible causes: distant tissue, a short baseline, small images, weak texture, a wrong "
        "calibration (`softscope info` measures by how much the rows of the images differ)");
  };
  warnOfImprecise(imprecise_, "depth is");
  warnOfImprecise(imprecise_tracks_, "tracked points in view are");
  if (disagreeing_ > kWarnShare * frames_)
    all.push_back(std::to_string(disagreeing_) + " of " + std::to_string(frames_) +
                  " frames were fused with a confidence below " + fixed(kDoubtful, 1) +
                  ": the model does not fit the image in many places; possible causes: blur, weak "
                  "texture, changing light");
  if (assumed_ > kWarnShare * frames_)
    all.push_back(
        std::to_string(assumed_) + " of " + std::to_string(frames_) +
        " frames were fused at the last pose, as their matches determined none "
        "(frames.csv, no pose_sigma_mm): where the scope moved, the tissue has its motion");
  const auto& each = outcomes_.each();
  const auto first = std::find_if(each.begin(), each.end(), [](const auto& frame) {
    return frame.second == FusionOutcome::kFused;
  });
  if (first != each.end() && first != each.begin())
    all.push_back("the model begins at frame " + std::to_string(first->first) + ", as " +
                  std::to_string(std::distance(each.begin(), first)) +
                  " before it could not be used: the world is the left camera there, and pixels "
                  "of --track are taken there, not in the first image");
  if (framesElsewhere() > 0)
    all.push_back(std::to_string(framesElsewhere()) +
                  " frames were fused with models of other places, begun where the first model was "
                  "not found and not recognised as a part of it since: their poses are not "
                  "relative to the first frame (frames.csv, column map; model_mapN.ply)");
  if (repeated_ > kWarnShare * frames_)
    all.push_back("both images of " + std::to_string(repeated_) + " of " + std::to_string(frames_) +
                  " frames are those of the frame before: the video stood still or repeats frames. "
                  "What moved meanwhile is unknown, and sigma takes each for a new measurement; "
                  "select other frames with `frames=`");
  const std::string overlay = overlayWarning(overlay_.found(), kOverlayFile);
  if (!overlay.empty()) all.push_back(overlay);
  if (located_ > 0 && scope_static_ == located_)
    all.push_back("no motion of the scope was detected; if it moved, state --scope moving");
  return all;
}

void RunRecord::addView(std::shared_ptr<const Frame> frame, const FrameRecord& record,
                        const RectifiedRig& rig) {
  if (!record.fused()) return;
  const double depth_mm = std::sqrt(record.depth.mm_per_px * rig.left.fx_px * rig.baseline_mm);
  overlay_.add(std::move(frame), rig.left, record.world_from_left, depth_mm);
}

Mask RunRecord::overlay() const {
  Mask found = overlay_.found();
  return overlayWarning(found, "").empty() ? Mask() : found;
}

int RunRecord::framesElsewhere() const {
  int frames = 0;
  for (const auto& [map, count] : frames_of_map_) frames += map == 0 ? 0 : count;
  return frames;
}

std::string RunRecord::statusText() const {
  std::string statuses;
  for (const auto& [status, count] : frames_of_status_)
    statuses += (statuses.empty() ? "" : ", ") + std::to_string(count) + " " + status;
  return statuses;
}

double RunRecord::meanOf(const std::vector<double>& values) const {
  if (values.empty()) return kUnknown;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Json RunRecord::json() const {
  Json all = json_;
  all["frames"] = frames_;
  all["frames_fused"] = outcomes_.count(FusionOutcome::kFused);
  all["frames_by_status"] = frames_of_status_;
  all["outcomes"] = outcomes_.json();
  all["maps"] = frames_of_map_.size();
  all["frames_in_other_maps"] = framesElsewhere();
  all["points"] = points_;
  all["nodes"] = nodes_;
  all["mean_inliers"] = orNull(meanOf(matches_));
  all["mean_backprojection_mm"] = orNull(meanOf(backprojection_mm_));
  all["mean_prediction_mm"] = orNull(meanOf(prediction_mm_));
  all["mean_frame_ms"] = orNull(meanOf(frame_ms_));
  std::vector<double> ms(4, Statistics::kNone);  // the metrics exist before the first frame
  if (!frame_ms_.empty()) ms = percentiles(frame_ms_, {50, 95, 99, 100});
  all["frame_ms"] = {{"p50", orNull(ms[0])},
                     {"p95", orNull(ms[1])},
                     {"p99", orNull(ms[2])},
                     {"slowest", orNull(ms[3])}};
  Json& stages = all["mean_stage_ms"] = Json::object();
  for (const auto& [stage, sum_ms] : elapsed_ms_) stages[stage] = sum_ms / std::max(1, frames_);
  all["frames_scope_static"] = scope_static_;
  all["frames_doubtful"] = doubtful_;
  all["warnings"] = warnings_;
  for (const std::string& conclusion : conclusions()) all["warnings"].push_back(conclusion);
  return all;
}

FactSheet RunRecord::text(const std::string& folder) const {
  FactSheet facts("reconstruction of " + std::to_string(frames_) + " frames");
  addOutcomeFacts(outcomes_, facts);
  facts.addLine("  by status", statusText());
  if (located_ > 0)
    facts.addLine("scope", "static in " + std::to_string(scope_static_) + " of " +
                               std::to_string(located_) + " frames");
  facts.addLine("model",
                std::to_string(points_) + " points on " + std::to_string(nodes_) + " nodes");
  if (framesElsewhere() > 0)
    facts.addLine("maps", std::to_string(frames_of_map_.size()) + ", " +
                              std::to_string(framesElsewhere()) +
                              " frames in others than the first");
  if (!matches_.empty())
    facts.addLine("matches", fixed(meanOf(matches_), 0) + " inliers of the pose per frame");
  if (!backprojection_mm_.empty())
    facts.addLine("back-projection",
                  fixed(meanOf(backprojection_mm_), 3) +
                      " mm mean distance of the model to the depth of each frame, " +
                      fixed(meanOf(prediction_mm_), 3) +
                      " mm before the fusion of the frame; over " +
                      std::to_string(backprojection_mm_.size()) + " frames");
  if (!frame_ms_.empty()) facts.addLine("time", fixed(meanOf(frame_ms_), 0) + " ms a frame");
  if (folder.empty()) return facts;
  facts.addLine("written to", folder);
  facts.addLine("look at", folder + "/model.ply (MeshLab), " + folder + "/models.pvd (ParaView)");
  return facts;
}

}  // namespace softscope
