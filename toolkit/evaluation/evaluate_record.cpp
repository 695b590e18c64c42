// toolkit/evaluation/evaluate_record.cpp: names, units, nesting.
#include "toolkit/evaluation/evaluate_record.h"

#include <algorithm>
#include <cmath>

#include "toolkit/record/metric_lists.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

Json poseErrorsJson(const PoseErrors& errors) {
  Json json = statisticsJson(errors.translation_mm, "_mm");
  json.update(statisticsJson(errors.rotation_deg, "_deg"));
  return json;
}

Json sigmaJson(const JudgedSigma& judged) {
  Json json{{"points", judged.intervals.count},
            {"known_share", judged.known_share},
            {"within_50_share", judged.intervals.within_50},
            {"within_68_share", judged.intervals.within_68},
            {"within_95_share", judged.intervals.within_95},
            {"half_left_mm", judged.sparse.halfLeft()},
            {"ause", judged.sparse.area}};
  json["sparsification"] = {{"removed_share", judged.sparse.removed_share},
                            {"mean_left_mm", judged.sparse.mean_left},
                            {"best_left_mm", judged.sparse.best_left}};
  return json;
}

/// Means over the models of what is defined per model.
void addViewMeans(const SurfaceSeries& surface, Json& json) {
  using E = const ModelErrors&;
  for (const Metric<ModelErrors>& metric : completenessMetrics())
    json[metric.key] = surface.meanOf(metric.of);
  json["observed_share"] = surface.meanOf([](E e) { return e.observed_share; });
  json["observed"] = statisticsJson(surface.observed_mm, "_mm");
  json["predicted"] = statisticsJson(surface.predicted_mm, "_mm");
  json["tissue_to_model"] = {
      {"mean_mm", surface.meanOf([](E e) { return e.both.distance_mm.mean; })},
      {"median_mm", surface.meanOf([](E e) { return e.both.distance_mm.median; })},
      {"p95_mm", surface.meanOf([](E e) { return e.both.distance_mm.p95; })}};
  json["hausdorff"] = metricsJson(hausdorffMetrics(), [&](const Metric<HausdorffDistances>& m) {
    return surface.meanOf([&](E e) { return m.of(e.hausdorff); });
  });
}

const JudgedModel* worstOf(const SurfaceSeries& surface) {
  const auto worst = std::max_element(
      surface.models.begin(), surface.models.end(), [](const JudgedModel& a, const JudgedModel& b) {
        return a.errors.distance_mm.mean < b.errors.distance_mm.mean;
      });
  return worst == surface.models.end() ? nullptr : &*worst;
}

Json surfaceJson(const EvaluationResult& result) {
  const SurfaceSeries& surface = result.surface;
  const JudgedModel* worst = worstOf(surface);
  Json json = statisticsJson(surface.all_mm, "_mm");
  json["models_judged"] = surface.models.size();
  json["worst_frame"] = worst == nullptr ? Json() : Json(worst->frame);
  json["worst_frame_mean_mm"] =
      worst == nullptr ? Statistics::kNone : worst->errors.distance_mm.mean;
  json["signed"] = statisticsJson(surface.signed_mm, "_mm");
  json["sigma"] = sigmaJson(surface.all_sigma);
  if (!result.against_mesh) {
    json["sigma"]["observed"] = sigmaJson(surface.observed_sigma);
    json["sigma"]["predicted"] = sigmaJson(surface.predicted_sigma);
    addViewMeans(surface, json);
  }
  json["drift_mm_per_s"] = surface.drift_mm_per_s;
  json["drift_mm_per_frame"] = surface.drift_mm_per_frame;
  json["jitter_rms_mm"] = surface.jitter_rms_mm;
  return json;
}

Json drawnDepthJson(const SurfaceSeries& surface) {
  return metricsJson(drawnDepthMetrics(), [&](const Metric<DepthErrors>& m) {
    return surface.meanOfView([&](const ViewErrors& v) { return m.of(v.depth); });
  });
}

Json viewJson(const SurfaceSeries& surface) {
  Json json = metricsJson(drawnViewMetrics(), [&](const Metric<PictureErrors>& m) {
    return surface.meanOfView([&](const ViewErrors& v) { return m.of(v.picture); });
  });
  json["pixels"] = kPsnrMask;
  return json;
}

/// The run's own figure: statistics of its frames' means.
Statistics backprojectionOf(const EvaluationResult& result) {
  std::vector<double> means_mm;
  for (const auto& [frame, mean_mm] : result.backprojection_mm) means_mm.push_back(mean_mm);
  return statistics(means_mm);
}

Json cameraJson(const CameraResult& camera) {
  return {{"poses", camera.frames.size()},
          {"pose", poseErrorsJson(camera.errors.unaligned)},
          {"ate", poseErrorsJson(camera.errors.absolute)},
          {"rpe", poseErrorsJson(camera.errors.relative)},
          {"ate_alignment",
           {{"method", "rigid, least squares over all positions, no scale"},
            {"unique", camera.errors.alignment_unique},
            {"truth_from_run", matrixJson(camera.errors.truth_from_estimate.matrix())}}}};
}

Json tracksJson(const TrackErrors& tracks) {
  Json json = statisticsJson(tracks.error_mm, "_mm");
  json["last_frame_mean_mm"] = tracks.last_frame_mm.mean;
  json["no_motion_control_mm"] = tracks.control_mm.mean;
  json["no_motion"] = statisticsJson(tracks.control_mm, "_mm");
  json["visible"] = statisticsJson(tracks.visible_mm, "_mm");
  json["hidden"] = statisticsJson(tracks.hidden_mm, "_mm");
  json["observed"] = statisticsJson(tracks.observed_mm, "_mm");
  json["predicted"] = statisticsJson(tracks.predicted_mm, "_mm");
  json["sigma"] = {{"points", tracks.sigma.count},
                   {"error_over_sigma_rms", tracks.sigma.error_over_sigma},
                   {"within_2_sigma_share", tracks.sigma.within_2_sigma_share}};
  json["reported"] = tracks.reported_share;
  json["lost"] = tracks.lost;
  json["without_truth"] = tracks.without_truth;
  return json;
}

Json revisitsJson(const Revisits& revisits) {
  return {{"count", revisits.count},
          {"first_visit_mean_mm", revisits.first_mm},
          {"revisit_mean_mm", revisits.again_mm},
          {"growth_mm", revisits.growth_mm}};
}

std::vector<int> silentlyWrong(const EvaluationResult& result) {
  std::vector<int> frames;
  for (const JudgedFrame& judged : result.judged_frames)
    if (isSilentlyWrong(judged)) frames.push_back(judged.frame);
  return frames;
}

std::size_t countWrong(const EvaluationResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.judged_frames.begin(), result.judged_frames.end(), isWrong));
}

Json wrongJson(const EvaluationResult& result) {
  const std::vector<int> silent = silentlyWrong(result);
  return {{"frames", countWrong(result)},
          {"silent_frames", silent.size()},
          {"silent_frame_numbers", silent}};
}

Json alignmentJson(const SurfaceAlignment& alignment) {
  return {{"mesh_from_run", matrixJson(alignment.surface_from_points.matrix())},
          {"stop", stopText(alignment.stop)},
          {"iterations", alignment.iterations},
          {"pairs", alignment.pair_count},
          {"free_directions", alignment.free_directions},
          {"before", statisticsJson(alignment.before.distance_mm, "_mm")},
          {"after", statisticsJson(alignment.after.distance_mm, "_mm")}};
}

Json surfacesJson(const EvaluationResult& result) {
  Json json{{"reference_kind", result.against_mesh ? "mesh" : "sequence"},
            {"frame", result.against_mesh ? "the mesh's" : "the current left camera's"},
            {"alignment", toString(result.alignment)}};
  if (!result.against_mesh) return json;
  json["alignments"] = Json::array();
  for (const SurfaceAlignment& alignment : result.alignments)
    json["alignments"].push_back(alignmentJson(alignment));
  return json;
}

std::string percent(double share) {
  return std::isnan(share) ? "unknown" : fixed(100 * share, 1) + " %";
}

void addSigmaFacts(const char* label, const JudgedSigma& judged, FactSheet& facts) {
  if (judged.intervals.count == 0) return;
  facts.addLine(
      label, percent(judged.intervals.within_50) + ", " + percent(judged.intervals.within_68) +
                 ", " + percent(judged.intervals.within_95) +
                 " of the distances within its 50, 68, 95 % intervals; mean " +
                 fixed(judged.sparse.halfLeft(), 3) + " mm without the least sure half; known of " +
                 percent(judged.known_share) + " of the points");
}

void addViewFacts(const SurfaceSeries& surface, FactSheet& facts) {
  using E = const ModelErrors&;
  const auto hd95 = [&](auto value) { return fixed(surface.meanOf(value), 2); };
  facts.addLine("  observed", spreadText(surface.observed_mm) + "; " +
                                  percent(surface.meanOf([](E e) { return e.observed_share; })) +
                                  " of the points");
  addSigmaFacts("    sigma", surface.observed_sigma, facts);
  facts.addLine("  predicted", spreadText(surface.predicted_mm));
  addSigmaFacts("    sigma", surface.predicted_sigma, facts);
  facts.addLine("completeness",
                percent(surface.meanOf([](E e) { return e.both.share; })) +
                    " of the tissue that both cameras see has a model point within 1 mm; " +
                    percent(surface.meanOf([](E e) { return 1 - e.both.share; })) +
                    " is not reconstructed");
  facts.addLine("HD95", hd95([](E e) { return e.hausdorff.hd95_max_of_directed_mm; }) +
                            " mm as the larger of both ways, " +
                            hd95([](E e) { return e.hausdorff.hd95_pooled_mm; }) + " pooled, " +
                            hd95([](E e) { return e.hausdorff.hd95_mean_of_directed_mm; }) +
                            " as their mean");
}

void addSurfaceFacts(const EvaluationResult& result, FactSheet& facts) {
  const SurfaceSeries& surface = result.surface;
  const JudgedModel* worst = worstOf(surface);
  if (worst == nullptr) return facts.addLine("surface", "no model was evaluated");
  facts.addLine("surface", spreadText(surface.all_mm) + " over " +
                               std::to_string(surface.models.size()) +
                               (surface.models.size() == 1 ? " model" : " models"));
  facts.addLine("  signed", "mean " + fixed(surface.signed_mm.mean, 3) + " mm, + = outside");
  if (!result.against_mesh)
    addViewFacts(surface, facts);
  else
    addSigmaFacts("  sigma", surface.all_sigma, facts);
  facts.addLine("worst", "frame " + std::to_string(worst->frame) + ", mean " +
                             fixed(worst->errors.distance_mm.mean, 3) + " mm");
  if (!std::isnan(surface.drift_mm_per_frame))
    facts.addLine("drift", fixed(1000 * surface.drift_mm_per_frame, 3) + " um a frame" +
                               (std::isnan(surface.drift_mm_per_s)
                                    ? std::string()
                                    : ", " + fixed(surface.drift_mm_per_s, 4) + " mm/s"));
  if (!std::isnan(surface.jitter_rms_mm))
    facts.addLine("jitter", fixed(surface.jitter_rms_mm, 4) + " mm rms of second differences");
}

void addCameraFacts(const CameraResult& camera, FactSheet& facts) {
  const auto rmse = [](const PoseErrors& errors) {
    return fixed(errors.translation_mm.rmse, 3) + " mm" +
           (errors.rotation_deg.count == 0 ? std::string()
                                           : ", " + fixed(errors.rotation_deg.rmse, 3) + " deg");
  };
  facts.addLine("camera", "rmse " + rmse(camera.errors.unaligned) + " unaligned; ATE " +
                              fixed(camera.errors.absolute.translation_mm.rmse, 3) + " mm; RPE " +
                              rmse(camera.errors.relative) + " a frame; over " +
                              std::to_string(camera.frames.size()) + " fused frames");
}

void addTrackFacts(const TrackErrors& tracks, FactSheet& facts) {
  facts.addLine("tracks", spreadText(tracks.error_mm) + "; " + percent(tracks.reported_share) +
                              " of the true positions have an estimate");
  if (tracks.sigma.count > 0)
    facts.addLine("  sigma", "errors are " + fixed(tracks.sigma.error_over_sigma, 2) +
                                 " times the prediction (root mean square); " +
                                 percent(tracks.sigma.within_2_sigma_share) + " within twice that");
  facts.addLine("  no motion", spreadText(tracks.control_mm) + ", had nothing been tracked");
}

void addWrongFacts(const EvaluationResult& result, FactSheet& facts) {
  std::string silent;
  for (const int frame : silentlyWrong(result)) silent += " " + std::to_string(frame);
  facts.addLine("wrong", std::to_string(countWrong(result)) + " of " +
                             std::to_string(result.judged_frames.size()) + " fused frames; " +
                             (silent.empty() ? "none" : "frames" + silent) +
                             " with a confidence above one half");
}

void addRevisitFacts(const RevisitResult& revisits, FactSheet& facts) {
  const auto add = [&](const char* label, const Revisits& of) {
    if (of.count > 0)
      facts.addLine(label, "mean " + fixed(of.first_mm, 3) + " mm at the first visit, " +
                               fixed(of.again_mm, 3) + " mm when the scope is back, " +
                               std::to_string(of.count) + " times");
  };
  add("revisits", revisits.surface);
  add("  tracks", revisits.tracks);
}

void addDrawnFacts(const EvaluationResult& result, FactSheet& facts) {
  using V = const ViewErrors&;
  const SurfaceSeries& surface = result.surface;
  const double depth_mm = surface.meanOfView([](V v) { return v.depth.absolute_mm.mean; });
  const double psnr_db = surface.meanOfView([](V v) { return v.picture.psnr_db; });
  if (!std::isnan(depth_mm))
    facts.addLine("drawn depth",
                  "mean " + fixed(depth_mm, 3) + " mm over " +
                      fixed(surface.meanOfView([](V v) { return v.depth.coverage_percent; }), 1) +
                      " % of the tissue in view");
  if (!std::isnan(psnr_db))
    facts.addLine("drawn view",
                  "PSNR " + fixed(psnr_db, 1) + " dB, SSIM " +
                      fixed(surface.meanOfView([](V v) { return v.picture.ssim; }), 3) +
                      " over the pixels that the model covers, " +
                      percent(surface.meanOfView([](V v) { return v.picture.judged_share; })) +
                      " of the tissue (without masks and black borders)");
  addHeldOutFacts(result.held_out, facts);
  const Statistics backprojection = backprojectionOf(result);
  if (backprojection.count > 0)
    facts.addLine("back-projection", "mean " + fixed(backprojection.mean, 3) + " mm over " +
                                         std::to_string(backprojection.count) +
                                         " frames, as reported by the run");
}

void addAlignmentFacts(const EvaluationResult& result, FactSheet& facts) {
  facts.addLine("alignment", toString(result.alignment));
  if (result.alignments.empty()) return;
  const SurfaceAlignment& first = result.alignments.front();
  facts.addLine("  before", spreadText(first.before.distance_mm));
  facts.addLine("  after", spreadText(first.after.distance_mm) + "; " + stopText(first.stop) +
                               " after " + std::to_string(first.iterations) + " iterations");
}

}  // namespace

FactSheet::Json evaluationJson(const EvaluationResult& result) {
  Json json;
  json["schema_version"] = 1;
  json["softscope"] = versionText();
  json["command"] = "evaluate";
  json["inputs"] = {{"run", result.run}, {"reference", result.reference}};
  json["comparison"] = surfacesJson(result);
  json["outcomes"] = result.outcomes.json();
  json["surface"] = surfaceJson(result);
  if (!result.against_mesh) {
    json["camera"] = cameraJson(result.camera.value_or(CameraResult()));
    json["tracks"] = tracksJson(result.tracks.value_or(TrackErrors()));
    json["revisit"] = {{"surface", revisitsJson(result.revisits.surface)},
                       {"tracks", revisitsJson(result.revisits.tracks)}};
    json["wrong"] = wrongJson(result);
    json["depth"] = drawnDepthJson(result.surface);
    json["view"] = viewJson(result.surface);
    if (result.held_out.every > 0) json["held_out"] = heldOutJson(result.held_out);
    json["backprojection"] = statisticsJson(backprojectionOf(result), "_mm");
  }
  json["warnings"] = result.warnings;
  return json;
}

FactSheet evaluationFacts(const EvaluationResult& result) {
  FactSheet facts(result.run + " against " + result.reference +
                  (result.against_mesh ? "" : ", in the current camera frame"));
  addOutcomeFacts(result.outcomes, facts);
  if (result.against_mesh) addAlignmentFacts(result, facts);
  addSurfaceFacts(result, facts);
  if (result.camera) addCameraFacts(*result.camera, facts);
  if (result.tracks) addTrackFacts(*result.tracks, facts);
  if (!result.against_mesh) addWrongFacts(result, facts);
  addRevisitFacts(result.revisits, facts);
  if (!result.against_mesh) addDrawnFacts(result, facts);
  for (const std::string& warning : result.warnings) facts.warn(warning);
  return facts;
}

}  // namespace softscope
