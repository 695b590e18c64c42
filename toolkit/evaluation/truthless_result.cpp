// toolkit/evaluation/truthless_result.cpp: values reported by the run, models against images.
#include "toolkit/evaluation/truthless_result.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "io/calibrations/calibration_files.h"
#include "io/sequences/sequence_paths.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/evaluation/evaluate_view.h"
#include "toolkit/record/metric_lists.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/record/version.h"
#include "toolkit/run/dataset_truth.h"
#include "toolkit/run/sequence_calibration.h"
#include "vtk_views/plots/value_series_plot.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;
using Value = std::function<double(const TruthlessFrame&)>;

constexpr double kDegPerRad = 57.29577951308232;

/// Values that cannot be measured without truth.
const std::vector<std::string> kMissing{
    "surface errors: they need true meshes, groundtruth/mesh/NNNNNN.ply, or a mesh as --reference",
    "errors of material points: they need groundtruth/tracks.csv",
    "errors of the camera path: they need groundtruth/trajectory.txt",
    "errors of the rendered depth: they need groundtruth/depth/NNNNNN.png"};

double angleDeg(const Eigen::Isometry3d& motion) {
  return kDegPerRad * Eigen::AngleAxisd(motion.linear()).angle();
}

void addPath(const JudgedRun& run, TruthlessResult& result) {
  std::vector<double> squares;
  const auto counts = [&](std::size_t k) {
    return k < run.frames.size() && run.isPlaced(run.frames[k]);
  };
  std::vector<std::size_t> counted;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    TruthlessFrame& frame = result.frames[run.frames[k]];
    frame.time_s = run.timeOf(run.frames[k]);
    if (!counts(k)) continue;
    counted.push_back(k);
    const Eigen::Isometry3d& here = run.trajectory[k].world_from_left;
    if (k > 0 && counts(k - 1)) {
      const Eigen::Isometry3d step = run.trajectory[k - 1].world_from_left.inverse() * here;
      frame.step_mm = step.translation().norm();
      frame.step_deg = angleDeg(step);
    }
    if (k == 0 || !counts(k - 1) || !counts(k + 1)) continue;
    const Eigen::Vector3d before = run.trajectory[k - 1].world_from_left.translation(),
                          after = run.trajectory[k + 1].world_from_left.translation();
    frame.second_difference_mm = (before - 2 * here.translation() + after).norm();
    squares.push_back(frame.second_difference_mm * frame.second_difference_mm);
  }
  result.jitter_rms_mm = std::sqrt(statistics(squares).mean);
  if (counted.size() < 2) return;
  const Eigen::Isometry3d motion = run.trajectory[counted.front()].world_from_left.inverse() *
                                   run.trajectory[counted.back()].world_from_left;
  result.moved_mm = motion.translation().norm();
  result.turned_deg = angleDeg(motion);
}

/// Empty for a sequence with a calibration.
std::string calibrationWarning(const SequencePaths& paths) {
  try {
    locateCalibration(paths.calibration);
    return {};
  } catch (const InputError& error) {
    return std::string(error.what()) +
           " Without a calibration no model is rendered: PSNR and SSIM are not measured";
  }
}

void addDrawnViews(const JudgedRun& run, const std::filesystem::path& sequence,
                   const std::function<bool()>& after_model, TruthlessResult& result) {
  SequenceTruth pictures;
  pictures.folder = sequence;
  pictures.rig = Rectifier(sequenceCalibration(sequence)).rig();
  ViewJudge judge(pictures);
  const PinholeCamera& left = pictures.rig.left;
  const Raster<float> no_depth(left.width_px, left.height_px, std::nanf(""));
  for (const auto& [frame, file] : run.countedModels()) {
    const auto at = std::lower_bound(run.frames.begin(), run.frames.end(), frame);
    if (at == run.frames.end() || *at != frame) continue;
    const auto& pose = run.trajectory[static_cast<std::size_t>(at - run.frames.begin())];
    DrawnPair drawn;
    const ViewErrors errors =
        judge.judge(readModel(file), pose.world_from_left, frame, no_depth, &drawn);
    result.frames[frame].picture = errors.picture;
    if (std::isfinite(errors.picture.judged_share)) {
      result.drawn.push_back(frame);
      result.last_drawn = std::move(drawn);
    }
    result.interrupted = !after_model();
    if (result.interrupted) return;
  }
  result.held_out = judgeHeldOut(run, pictures);
  for (std::string& warning : heldOutWarnings(result.held_out))
    result.warnings.push_back(std::move(warning));
  if (run.models.empty())
    result.warnings.push_back(
        "the run has no models of single frames, so no rendered view; reconstruct with "
        "--save-every 1");
}

Statistics overFrames(const TruthlessResult& result, const Value& value) {
  std::vector<double> values;
  for (const auto& [number, frame] : result.frames)
    if (result.outcomes.fused(number)) values.push_back(value(frame));
  return statistics(values);
}

const Value kPsnr = [](const TruthlessFrame& f) { return f.picture.psnr_db; };
const Value kSsim = [](const TruthlessFrame& f) { return f.picture.ssim; };
const Value kJudged = [](const TruthlessFrame& f) { return f.picture.judged_share; };
const Value kBackProjection = [](const TruthlessFrame& f) { return f.backprojection_mm; };
const Value kCoverage = [](const TruthlessFrame& f) { return f.coverage; };
const Value kStep = [](const TruthlessFrame& f) { return f.step_mm; };
const Value kStepDeg = [](const TruthlessFrame& f) { return f.step_deg; };
const Value kSecondDifference = [](const TruthlessFrame& f) { return f.second_difference_mm; };

struct TruthlessColumn {
  std::string heading;
  Value value;
};

std::vector<TruthlessColumn> truthlessColumns() {
  std::vector<TruthlessColumn> columns;
  for (const Metric<PictureErrors>& m : drawnViewMetrics())
    columns.push_back(
        {"view_" + std::string(m.key), [m](const TruthlessFrame& f) { return m.of(f.picture); }});
  columns.insert(columns.end(), {{"backprojection_mean_mm", kBackProjection},
                                 {"coverage", kCoverage},
                                 {"step_mm", kStep},
                                 {"step_deg", kStepDeg},
                                 {"second_difference_mm", kSecondDifference}});
  return columns;
}

/// Times of a clip without timestamps are NaN.
bool hasTimes(const TruthlessResult& result) {
  return std::all_of(result.frames.begin(), result.frames.end(),
                     [](const auto& frame) { return std::isfinite(frame.second.time_s); });
}

void addPlot(const TruthlessResult& result, const char* label, const Value& value,
             const PlotStyle& style, char* letter, VectorDrawing& drawing) {
  const bool over_time = hasTimes(result);
  ValueSeriesData data{over_time ? "time [s]" : "frame", label, {}, {}};
  for (const auto& [number, frame] : result.frames) {
    const bool at_end =
        number == result.frames.begin()->first || number == result.frames.rbegin()->first;
    if (!std::isfinite(value(frame)) && result.outcomes.fused(number) && !at_end) continue;
    data.x.push_back(over_time ? frame.time_s : number);
    data.y.push_back(result.outcomes.fused(number) ? value(frame) : Statistics::kNone);
  }
  if (statistics(data.y).count == 0) return;
  VectorDrawing plot = drawValueSeries(data, style);
  DrawnText panel;
  panel.at = {0.3 * style.font_pt, 1.4 * style.font_pt};
  panel.text = std::string("(") + (*letter)++ + ")";
  panel.size_pt = style.font_pt;
  plot.parts.emplace_back(std::move(panel));
  appendBelow(plot, 0, drawing);
}

Json viewJson(const TruthlessResult& result) {
  Json json = metricsJson(drawnViewMetrics(), [&](const Metric<PictureErrors>& m) {
    return overFrames(result, [&](const TruthlessFrame& f) { return m.of(f.picture); }).mean;
  });
  json["pixels"] = kPsnrMask;
  json["models_judged"] = result.drawn.size();
  return json;
}

/// Facts of drawn_view.png: its frame, the share of tissue
/// covered by the model, and the number of later frames.
Json drawnViewJson(const TruthlessResult& result) {
  if (result.drawn.empty()) return nullptr;
  const int frame = result.drawn.back();
  const auto at = result.frames.find(frame);
  const auto later = std::distance(result.frames.upper_bound(frame), result.frames.end());
  return {{"frame", frame},
          {"time_s", at->second.time_s},
          {"covers_share", at->second.picture.judged_share},
          {"psnr_db", at->second.picture.psnr_db},
          {"age_frames", later}};
}

Json framesJson(const TruthlessResult& result) {
  const std::vector<TruthlessColumn> columns = truthlessColumns();
  Json frames = Json::array();
  for (const auto& [number, frame] : result.frames) {
    Json row{{"frame", number}, {"time_s", frame.time_s}};
    if (const auto at = result.outcomes.each().find(number); at != result.outcomes.each().end())
      row["outcome"] = toString(at->second);
    for (const TruthlessColumn& column : columns) row[column.heading] = column.value(frame);
    frames.push_back(std::move(row));
  }
  return frames;
}

}  // namespace

TruthlessResult judgeWithoutTruth(const JudgedRun& run, const std::filesystem::path& sequence,
                                  bool views, const std::function<bool()>& after_model) {
  const SequencePaths paths = findSequence(sequence);
  TruthlessResult result;
  result.outcomes = run.outcomes;
  result.warnings = run.warnings();
  if (!paths.form.empty())
    if (const std::string truth = describeTruth(*recogniseDataset(sequence)); !truth.empty())
      result.warnings.push_back("truth of the data set: " + truth);
  addPath(run, result);
  for (const auto& [frame, mean_mm] : run.backprojection_mm)
    result.frames[frame].backprojection_mm = mean_mm;
  for (const auto& [frame, share] : run.coverage) result.frames[frame].coverage = share;
  if (!views) return result;
  if (const std::string warning = calibrationWarning(paths); !warning.empty())
    result.warnings.push_back(warning);
  else
    addDrawnViews(run, sequence, after_model, result);
  return result;
}

Json truthlessJson(const TruthlessResult& result) {
  Json camera{{"poses", overFrames(result, [](const TruthlessFrame&) { return 0.0; }).count},
              {"moved_mm", result.moved_mm},
              {"turned_deg", result.turned_deg},
              {"jitter_rms_mm", result.jitter_rms_mm}};
  camera["step"] = statisticsJson(overFrames(result, kStep), "_mm");
  camera["step"].update(statisticsJson(overFrames(result, kStepDeg), "_deg"));
  Json json{{"schema_version", 1},
            {"softscope", versionText()},
            {"command", "evaluate"},
            {"inputs", {{"run", result.run}, {"reference", result.sequence}}},
            {"comparison", {{"reference_kind", "pictures"}, {"alignment", "none"}}},
            {"outcomes", result.outcomes.json()},
            {"missing", kMissing},
            {"view", viewJson(result)},
            {"drawn_view", drawnViewJson(result)},
            {"backprojection", statisticsJson(overFrames(result, kBackProjection), "_mm")},
            {"coverage",
             {{"mean_share", overFrames(result, kCoverage).mean},
              {"n", overFrames(result, kCoverage).count}}},
            {"camera", camera},
            {"warnings", result.warnings}};
  if (result.held_out.every > 0) json["held_out"] = heldOutJson(result.held_out);
  json["frames"] = framesJson(result);
  return json;
}

FactSheet truthlessFacts(const TruthlessResult& result) {
  FactSheet facts(result.run + " beside the images of " + result.sequence +
                  ", which has no ground truth in groundtruth/");
  addOutcomeFacts(result.outcomes, facts);
  const auto mean = [&](const Value& value, int decimals) {
    return fixed(overFrames(result, value).mean, decimals);
  };
  if (!result.drawn.empty())
    facts.addLine("drawn view", "PSNR " + mean(kPsnr, 1) + " dB, SSIM " + mean(kSsim, 3) +
                                    " over the pixels that the model covers, " +
                                    fixed(100 * overFrames(result, kJudged).mean, 1) +
                                    " % of the tissue (without masks and black borders), of " +
                                    std::to_string(result.drawn.size()) + " models");
  addHeldOutFacts(result.held_out, facts);
  const Statistics backprojection = overFrames(result, kBackProjection);
  if (backprojection.count > 0)
    facts.addLine("back-projection", spreadText(backprojection) + " over " +
                                         std::to_string(backprojection.count) +
                                         " frames, as reported by the run");
  if (overFrames(result, kCoverage).count > 0)
    facts.addLine("coverage", fixed(100 * overFrames(result, kCoverage).mean, 1) +
                                  " % of the tissue has depth, mean of " +
                                  std::to_string(overFrames(result, kCoverage).count) + " frames");
  facts.addLine(
      "scope", "moved " + fixed(result.moved_mm, 2) + " mm and turned " +
                   fixed(result.turned_deg, 2) +
                   " deg from the first fused frame to the last; for a static scope this is drift");
  facts.addLine("  jitter", fixed(result.jitter_rms_mm, 4) + " mm rms of second differences");
  for (const std::string& missing : kMissing) facts.addLine("missing", missing);
  for (const std::string& warning : result.warnings) facts.warn(warning);
  return facts;
}

std::string truthlessCsv(const TruthlessResult& result) {
  std::string text = "frame,time_s,outcome";
  const std::vector<TruthlessColumn> columns = truthlessColumns();
  for (const TruthlessColumn& column : columns) text += "," + column.heading;
  text += "\n";
  for (const auto& [number, frame] : result.frames) {
    const auto outcome = result.outcomes.each().find(number);
    text += std::to_string(number) + "," + csvCell(frame.time_s) + "," +
            (outcome == result.outcomes.each().end() ? "" : toString(outcome->second));
    for (const TruthlessColumn& column : columns) text += "," + csvCell(column.value(frame));
    text += "\n";
  }
  return text;
}

VectorDrawing truthlessPlots(const TruthlessResult& result) {
  PlotStyle style;
  style.height_mm = 42;
  VectorDrawing drawing;
  drawing.width_pt = style.width_mm * kPtPerMm;
  OutcomeStripData strip;
  for (const auto& [number, outcome] : result.outcomes.each()) {
    const auto frame = result.frames.find(number);
    if (frame == result.frames.end()) continue;
    strip.x.push_back(hasTimes(result) ? frame->second.time_s : number);
    strip.outcomes.push_back(outcome);
  }
  if (!strip.x.empty()) appendBelow(drawOutcomeStrip(strip, style), 0, drawing);
  char letter = 'a';
  addPlot(result, "PSNR [dB]", kPsnr, style, &letter, drawing);
  addPlot(result, "SSIM", kSsim, style, &letter, drawing);
  addPlot(result, "back-projection [mm]", kBackProjection, style, &letter, drawing);
  addPlot(result, "camera step [mm]", kStep, style, &letter, drawing);
  return drawing;
}

}  // namespace softscope
