// toolkit/comparison/compare_record.cpp: keys, units and structure of the record.
#include "toolkit/comparison/compare_record.h"

#include <cmath>

#include "toolkit/record/metric_lists.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/record/version.h"
#include "vtk_views/drawing/fonts.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

Json directedJson(const DirectedErrors& errors) {
  Json json = statisticsJson(errors.vertices_mm, "_mm");
  json["by_area"] = statisticsJson(errors.area_mm, "_mm");
  return json;
}

/// In the order of the options.
Json scoresJson(const std::vector<ThresholdScores>& scores) {
  Json list = Json::array();
  for (const ThresholdScores& s : scores)
    list.push_back({{"tau_mm", s.tau_mm},
                    {"precision", s.precision},
                    {"recall", s.recall},
                    {"f_score", s.f_score},
                    {"surface_dice", s.surface_dice}});
  return list;
}

Json observedJson(const ObservedSplit& split) {
  return {{"reach_mm", split.reach_mm},
          {"reference_share", split.reference_share},
          {"test_share", split.test_share},
          {"test_beyond_border_share", split.beyond_share},
          {"accuracy", statisticsJson(split.observed_mm, "_mm")},
          {"predicted", statisticsJson(split.predicted_mm, "_mm")},
          {"completeness", statisticsJson(split.completeness_mm, "_mm")},
          {"not_reconstructed_share", split.not_reconstructed_share},
          {"hausdorff", metricsJson(hausdorffMetrics(), split.hausdorff)}};
}

/// A vertex whose closest point is on the border of the reference has no sign.
std::string signedText(const Statistics& signed_mm) {
  const std::string without =
      std::to_string(signed_mm.nan_count) + " vertices at the border of the reference have no sign";
  if (signed_mm.count == 0) return without;
  return "mean " + fixed(signed_mm.mean, 3) + " mm, + = outside; " + without;
}

void addObservedFacts(const ObservedSplit& split, FactSheet& facts) {
  facts.addLine("observed", fixed(100 * split.test_share, 1) + " % of the test, " +
                                fixed(100 * split.reference_share, 1) + " % of the reference");
  facts.addLine("  accuracy", spreadText(split.observed_mm));
  facts.addLine("  predicted", spreadText(split.predicted_mm) + ", of the test's other vertices");
  if (split.beyond_share > 0)
    facts.addLine("  beyond", fixed(100 * split.beyond_share, 1) +
                                  " % of the test, beyond the border of the reference: excluded");
  std::string completeness = spreadText(split.completeness_mm);
  if (std::isfinite(split.not_reconstructed_share))
    completeness += "; " + fixed(100 * split.not_reconstructed_share, 1) + " % not reconstructed";
  facts.addLine("  completeness", completeness);
}

}  // namespace

Json comparisonJson(const ComparisonResult& result) {
  const SurfaceComparison& c = result.comparison;
  Json json;
  json["schema_version"] = 1;
  json["softscope"] = versionText();
  json["command"] = "compare";
  json["inputs"] = {{"reference", result.reference}, {"test", result.test}};
  json["space"] = result.space;
  json["figures"] = {{"font", figureFont()}};
  json["alignment"] = surfaceFitJson(result.fit);
  json["accuracy"] = directedJson(c.accuracy);
  json["completeness"] = directedJson(c.completeness);
  json["signed"] = statisticsJson(c.signed_mm, "_mm");
  json["signed"]["border_vertices"] = c.signed_mm.nan_count;
  json["hausdorff"] = metricsJson(hausdorffMetrics(), c.hausdorff);
  json["scores"] = scoresJson(c.scores);
  if (result.observed) json["observed"] = observedJson(*result.observed);
  json["warnings"] = result.warnings;
  return json;
}

FactSheet comparisonFacts(const ComparisonResult& result) {
  const SurfaceComparison& c = result.comparison;
  FactSheet facts(result.test + " against " + result.reference);
  facts.addLine("space", result.space);
  addFitFacts(result.fit, facts);
  facts.addLine("accuracy", spreadText(c.accuracy.vertices_mm) + ", of the test's vertices");
  if (c.accuracy.area_mm.count > 0) facts.addLine("  by area", spreadText(c.accuracy.area_mm));
  facts.addLine("  signed", signedText(c.signed_mm));
  facts.addLine("completeness",
                spreadText(c.completeness.vertices_mm) + ", of the reference's vertices");
  facts.addLine("HD95", fixed(c.hausdorff.hd95_max_of_directed_mm, 2) +
                            " mm as the larger of both ways, " +
                            fixed(c.hausdorff.hd95_pooled_mm, 2) + " pooled, " +
                            fixed(c.hausdorff.hd95_mean_of_directed_mm, 2) + " as their mean");
  for (const ThresholdScores& s : c.scores)
    facts.addLine("within " + fixed(s.tau_mm, 2) + " mm",
                  "precision " + fixed(s.precision, 3) + ", recall " + fixed(s.recall, 3) + ", F " +
                      fixed(s.f_score, 3) +
                      (std::isnan(s.surface_dice) ? std::string()
                                                  : ", surface Dice " + fixed(s.surface_dice, 3)));
  if (result.observed) addObservedFacts(*result.observed, facts);
  for (const std::string& warning : result.warnings) facts.warn(warning);
  return facts;
}

}  // namespace softscope
