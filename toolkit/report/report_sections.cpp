// toolkit/report/report_sections.cpp: texts by kind of comparison.
#include "toolkit/report/report_sections.h"

#include <cmath>
#include <optional>

#include "toolkit/record/metric_lists.h"
#include "toolkit/record/version.h"
#include "toolkit/report/metric_paths.h"
#include "toolkit/report/report_alignment.h"
#include "toolkit/report/report_plots.h"
#include "toolkit/report/report_privacy.h"
#include "toolkit/report/report_truthless.h"
#include "toolkit/report/report_words.h"

namespace softscope {
namespace {

using Kind = ReportCase::Kind;

std::string whole(double count) {
  return std::isfinite(count) ? std::to_string(std::llround(count)) : "an unknown number of";
}

std::string testedText(const ReportCase& c) {
  if (c.kind == Kind::kPair)
    return "a 3-D model of " + whole(numberAt(c.record, "accuracy.n")) + " vertices";
  const double models = numberAt(c.record, c.mainPart() + ".models_judged");
  return "a 3-D model reconstructed from stereo-endoscopic video, evaluated at " + whole(models) +
         (models == 1 ? " frame" : " frames");
}

std::string referenceText(const ReportCase& c) {
  switch (c.kind) {
    case Kind::kSequence:
      return "ground truth of the video: the true surface, depth and camera pose of each frame";
    case Kind::kMesh:
      return "a static surface, for example from CT";
    case Kind::kPictures:
      return "none: there is no ground truth; the left images of the video are compared with the "
             "model";
    case Kind::kPair:
      return "a surface of " + whole(numberAt(c.record, "completeness.n")) + " vertices";
  }
  return {};
}

std::string frameText(const ReportCase& c) {
  if (c.kind == Kind::kSequence)
    return "each frame in its own left camera frame, so that a motion of the scope is not counted "
           "as an error of the surface";
  if (c.kind == Kind::kMesh) return "the reference's";
  if (c.kind == Kind::kPictures) return "the left image of each frame, from the estimated pose";
  const std::string space = textAt(c.record, "space");
  return "the reference's; space: " + (space.empty() ? "not said" : space);
}

std::vector<NamedPart> distanceParts(const ReportCase& c) {
  if (c.kind == Kind::kPair)
    return {{"model to reference, each vertex", "accuracy"},
            {"model to reference, by area", "accuracy.by_area"},
            {"reference to model, each vertex", "completeness"},
            {"reference to model, by area", "completeness.by_area"},
            {"signed, + = outside", "signed"},
            {"observed part: model to reference", "observed.accuracy"},
            {"predicted part: model to reference", "observed.predicted"},
            {"observed part: reference to model", "observed.completeness"}};
  return {{"all points", "surface"},
          {"visible now (observed)", "surface.observed"},
          {"not visible now (predicted)", "surface.predicted"},
          {"signed, + = outside", "surface.signed"},
          {"visible tissue to model", "surface.tissue_to_model"}};
}

ReportTable bothWaysTable(const ReportCase& c) {
  const std::string at =
      c.kind == Kind::kPair ? metric_paths::kHausdorffOfPair : metric_paths::kHausdorff;
  std::vector<NamedPart> parts;
  for (const Metric<HausdorffDistances>& metric : hausdorffMetrics())
    parts.push_back({metric.name, at + metric.key});
  return valueTable("Both ways", "mm", c.record, parts);
}

/// Of a comparison with an observed region.
std::vector<ReportTable> observedTables(const ReportCase& c) {
  std::vector<NamedPart> parts;
  for (const Metric<HausdorffDistances>& metric : hausdorffMetrics())
    parts.push_back({metric.name, metric_paths::kHausdorffObserved + std::string(metric.key)});
  return {valueTable("Both ways, observed part", "mm", c.record, parts),
          valueTable("Observed part", "share", c.record,
                     {{"vertices of the model that are observed", "observed.test_share"},
                      {"vertices of the model beyond the border of the reference",
                       "observed.test_beyond_border_share"},
                      {"vertices of the reference that are observed", "observed.reference_share"},
                      {"observed vertices of the reference that are not reconstructed",
                       "observed.not_reconstructed_share"}})};
}

ReportTable motionTable(const ReportCase& c) {
  return statisticsTable(
      "Motion [mm]", c.record,
      {{"material points (tracks)", "tracks"},
       {"control: no motion", "tracks.no_motion"},
       {"camera position, not aligned", "camera.pose"},
       {"camera position, path aligned (ATE)", "camera.ate"},
       {"camera step from frame to frame (RPE)", "camera.rpe"},
       {"back-projection, as reported by the run", metric_paths::kBackProjection}});
}

std::string shareText(double value) {
  return std::isfinite(value) ? fixed(value, 3) : numberText(value);
}

ReportTable scoresTable(const ReportCase& c) {
  ReportTable table{
      "Within a distance", {"", "precision", "recall", "F", "surface Dice"}, {}, false};
  if (!c.record.contains("scores") || !c.record["scores"].is_array()) return table;
  for (const auto& score : c.record["scores"])
    table.rows.push_back(
        {"within " + millimetresText(numberAt(score, "tau_mm")),
         shareText(numberAt(score, "precision")), shareText(numberAt(score, "recall")),
         shareText(numberAt(score, "f_score")), shareText(numberAt(score, "surface_dice"))});
  return table;
}

/// Number of frames, before any metric; none for a pair.
void addFrames(const ReportCase& c, std::vector<ReportPart>& parts) {
  const double all = numberAt(c.record, "outcomes.frames");
  const auto count = [&](const char* outcome) {
    return numberAt(c.record, std::string("outcomes.") + outcome);
  };
  if (!(all > 0)) return;
  parts.emplace_back(ReportParagraph{"Of " + whole(all) + " frames " + whole(count("fused")) +
                                     " were fused, " + whole(count("skipped")) + " skipped, " +
                                     whole(count("lost")) +
                                     " lost. All numbers below are of the fused frames only; the "
                                     "errors in other frames are unknown."});
  const OutcomeStripData strip = outcomeStrip(framesOf(c));
  if (strip.x.empty()) return;
  parts.emplace_back(ReportFigures{{{drawOutcomeStrip(strip), "The frames over time."}}});
}

ReportParagraph headline(const ReportCase& c) {
  if (!c.hasTruth()) return truthlessHeadline(c);
  std::string text = "The mean distance of the model is " +
                     millimetresText(c.main(metric_paths::kMean)) +
                     " from the reference; 95 % of its points are within " +
                     millimetresText(c.main(metric_paths::kP95)) + ".";
  const double completeness = numberAt(c.record, metric_paths::kCompleteness);
  if (std::isfinite(completeness))
    text += " Of the tissue visible to both cameras, " + percentText(completeness) +
            " is reconstructed.";
  return {text, /*important=*/true};
}

/// Share of the model within the requested distance nearest to 1 mm.
std::optional<ReportTile> withinTile(const ReportCase& c) {
  if (!c.record.contains("scores") || !c.record["scores"].is_array()) return std::nullopt;
  double best_mm = Statistics::kNone, precision = Statistics::kNone;
  for (const auto& score : c.record["scores"]) {
    const double tau_mm = numberAt(score, "tau_mm");
    if (!(std::abs(tau_mm - 1) >= std::abs(best_mm - 1))) {
      best_mm = tau_mm;
      precision = numberAt(score, "precision");
    }
  }
  if (!std::isfinite(best_mm) || !std::isfinite(precision)) return std::nullopt;
  return ReportTile{"Within " + millimetresText(best_mm), percentText(precision),
                    "of the model's points"};
}

ReportTiles tiles(const ReportCase& c) {
  if (!c.hasTruth()) return truthlessTiles(c);
  ReportTiles tiles;
  tiles.tiles.push_back({"Mean distance", millimetresText(c.main(metric_paths::kMean)),
                         "median " + millimetresText(c.main(metric_paths::kMedian))});
  tiles.tiles.push_back({"95th percentile", millimetresText(c.main(metric_paths::kP95)),
                         "largest " + millimetresText(c.main(metric_paths::kMax))});
  const std::string signed_mean =
      c.kind == Kind::kPair ? metric_paths::kSignedMeanOfPair : metric_paths::kSignedMean;
  tiles.tiles.push_back({"Bias (signed mean)", millimetresText(numberAt(c.record, signed_mean)),
                         "+ = outside the reference"});
  const double completeness = numberAt(c.record, metric_paths::kCompleteness);
  if (std::isfinite(completeness))
    tiles.tiles.push_back({"Reconstructed", percentText(completeness),
                           "of the tissue visible to both cameras, within 1 mm"});
  else if (auto within = withinTile(c))
    tiles.tiles.push_back(std::move(*within));
  return tiles;
}

ReportParagraph confidence(const ReportCase& c) {
  if (c.kind == Kind::kPair)
    return {
        "Uncertainty: this is one comparison, so it has no confidence interval; the table shows "
        "the distribution over the surface."};
  return {
      "Uncertainty: this is one video. Its frames are correlated, so an interval over them would "
      "be too narrow; a report of several videos has one, with equal weight per video."};
}

ReportTable thresholdsTable(const ReportCase& c) {
  ReportTable table{"Limits set at the comparison", {"fails if", "value", "outcome"}, {}, true};
  if (!c.record.contains("thresholds") || !c.record["thresholds"].is_array()) return table;
  for (const auto& t : c.record["thresholds"])
    table.rows.push_back(
        {textAt(t, "fail_if"), numberText(numberAt(t, "value")),
         t.is_object() && t.value("failed", FactSheet::Json()) == true ? "FAILED" : "kept"});
  return table;
}

}  // namespace

ReportTable comparedTable(const ReportCase& c, const ReportChoices& choices) {
  ReportTable table{"", {}, {}, /*words=*/true};
  table.rows = {{"Tested", testedText(c)},
                {"Reference", referenceText(c)},
                {"Compared in", frameText(c)},
                {"Alignment", alignmentText(c)}};
  if (!choices.with_paths) return table;
  for (const auto& [key, name] :
       {std::pair{"run", "Run"}, {"test", "Model"}, {"reference", "Reference from"}})
    if (const std::string path = textAt(c.record, std::string("inputs.") + key); !path.empty())
      table.rows.push_back({name, path});
  return table;
}

std::vector<ReportPart> resultParts(const ReportCase& c) {
  std::vector<ReportPart> parts;
  addFrames(c, parts);
  parts.emplace_back(headline(c));
  parts.emplace_back(tiles(c));
  parts.emplace_back(confidence(c));
  addTable(thresholdsTable(c), parts);
  if (!c.hasTruth()) {
    for (ReportTable& table : truthlessTables(c)) addTable(std::move(table), parts);
    return parts;
  }
  addTable(distancesTable(c, "Distances [mm]"), parts);
  addTable(bothWaysTable(c), parts);
  for (ReportTable& table : observedTables(c)) addTable(std::move(table), parts);
  addTable(scoresTable(c), parts);
  addTable(heldOutTable(c.record), parts);
  addTable(motionTable(c), parts);
  addTable(valueTable("Over time", "value", c.record,
                      {{"drift [mm/s]", "surface.drift_mm_per_s"},
                       {"drift [mm per frame]", "surface.drift_mm_per_frame"},
                       {"jitter, rms of second differences [mm]", "surface.jitter_rms_mm"}}),
           parts);
  return parts;
}

ReportTable distancesTable(const ReportCase& c, const std::string& caption) {
  return statisticsTable(caption, c.record, distanceParts(c));
}

std::vector<ReportPart> plotParts(const ReportCase& c) {
  ReportFigures figures;
  if (!c.hasTruth()) figures.figures = truthlessFigures(c);
  if (auto series = seriesFigure(c)) figures.figures.push_back(std::move(*series));
  if (auto spread = histogramFigure(c)) figures.figures.push_back(std::move(*spread));
  if (figures.figures.empty()) return {};
  return {figures};
}

ReportList limitsList(const ReportCase& c, const ReportChoices& choices) {
  ReportList list;
  if (!c.hasTruth()) list.items = truthlessLimits(c);
  if (c.kind == Kind::kMesh || c.kind == Kind::kPair)
    list.items.push_back(
        "A scope sees a part of an organ. If the model covers only a part of the reference, "
        "distances from the reference to the model, and derived values (HD95, Hausdorff, ASSD, "
        "recall, F, Dice), are not meaningful.");
  if (wasAligned(c))
    list.items.push_back(
        "The model was aligned to the reference: errors due to a rigid motion, for example of the "
        "calibration, are not included.");
  if (c.kind == Kind::kSequence)
    list.items.push_back(
        "Points not visible to the camera are moved by the estimated deformation; their errors are "
        "larger and are listed separately.");
  if (c.kind == Kind::kMesh)
    list.items.push_back(
        "The reference is static. Tissue motion between its scan and the video counts as an "
        "error.");
  if (!c.maps.empty())
    list.items.push_back(
        "The map shows a subset of the points (at most 20 000 per frame of a series, 60 000 of a "
        "single surface) and a decimated reference; the numbers are of the full data.");
  if (c.record.contains("warnings") && c.record["warnings"].is_array())
    for (const auto& warning : c.record["warnings"])
      if (warning.is_string()) {
        const std::string text = warning.get<std::string>();
        list.items.push_back("Warning: " +
                             (choices.with_paths ? text : withoutPaths(text, c.record)));
      }
  return list;
}

ReportList methodsList(const ReportCase& c) {
  const std::string all = "Every definition: docs/evaluation.md of softscope.";
  ReportList list;
  if (!c.hasTruth()) {
    list.items = truthlessMethods();
    list.items.push_back(all);
    return list;
  }
  list.items = {
      "Distance: from a point of the model to the closest point on the triangles of the reference, "
      "not to its nearest vertex. Signed: positive outside of the reference, by the angle-weighted "
      "pseudo-normal at the closest point; none if that is on the border of an open surface.",
      "SD over n; RMSE about zero; P95: 95 % of the values are smaller.",
      "HD95 has three common definitions that differ by a factor of two on some data; all three "
      "are given. ASSD: mean over the distances of both directions; MASD: mean of the two means."};
  if (c.kind != Kind::kPair)
    list.items.push_back(
        "Series: points pooled over all evaluated frames, at most 20 000 of each, so that every "
        "frame has the same weight. Drift: Theil-Sen slope of the means per frame.");
  if (c.kind == Kind::kSequence)
    list.items.push_back(
        "Observed: the closest true tissue is currently in view of the left camera. Reconstructed: "
        "a sample of tissue visible to both cameras has a model point within 1 mm. Tracks are "
        "compared with a control without motion.");
  if (c.kind == Kind::kPair)
    list.items.push_back(
        "By area: each vertex weighted by a third of the area of its triangles. Precision, recall: "
        "share of the vertices of the model, of the reference within the distance; F: their "
        "harmonic mean; surface Dice: area within the distance, both directions, over both areas. "
        "FRE is the residual at the landmarks used for the fit, TRE the error at a landmark not "
        "used.");
  list.items.push_back(all);
  return list;
}

ReportTable provenanceTable(const ReportCase& c, const ReportChoices& choices) {
  ReportTable table{"", {}, {}, /*words=*/true};
  table.rows = {{"Report", "softscope report " + versionText()},
                {"Measured by",
                 "softscope " + textAt(c.record, "command") + " " + textAt(c.record, "softscope")}};
  if (choices.with_paths)
    for (const auto& [key, name] :
         {std::pair{"run", "Run"}, {"test", "Model"}, {"reference", "Reference"}})
      if (const std::string path = textAt(c.record, std::string("inputs.") + key); !path.empty())
        table.rows.push_back({name, path});
  std::size_t listed = 0;
  for (const auto& [what, hash] : c.hashes)
    if (++listed <= 3) table.rows.push_back({"SHA-256 of " + what, hash});
  if (c.hashes.size() > 3)
    table.rows.push_back({"Further maps", std::to_string(c.hashes.size() - 3) +
                                              ", their SHA-256 in the embedded metrics"});
  return table;
}

}  // namespace softscope
