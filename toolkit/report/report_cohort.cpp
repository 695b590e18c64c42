// toolkit/report/report_cohort.cpp: statistics over cases with equal weights.
#include "toolkit/report/report_cohort.h"

#include <algorithm>
#include <cmath>

#include "eval/statistics/cohort.h"
#include "toolkit/report/metric_paths.h"
#include "toolkit/report/report_words.h"
#include "vtk_views/plots/agreement_plot.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;
using Cases = std::vector<ReportCase>;

double valueOf(const ReportCase& c, const CohortMetric& metric) {
  return numberAt(c.record, c.kind == ReportCase::Kind::kPair ? metric.of_pair : metric.of_run);
}

std::vector<double> valuesOf(const Cases& cases, const CohortMetric& metric) {
  std::vector<double> values;
  for (const ReportCase& c : cases) values.push_back(valueOf(c, metric));
  return values;
}

bool measured(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::string spread(const CohortSummary& s) {
  return numberText(s.mean) + " \xC2\xB1 " + numberText(s.sd);
}

std::string quartiles(const CohortSummary& s) {
  return numberText(s.median) + " [" + numberText(s.quartile_1) + ", " + numberText(s.quartile_3) +
         "]";
}

ReportTable casesTable(const Cases& cases) {
  ReportTable table{"Case by case", {"case"}, {}, /*words=*/false};
  for (const ReportCase& c : cases) table.rows.push_back({c.name});
  for (const CohortMetric& metric : cohortMetrics()) {
    const std::vector<double> values = valuesOf(cases, metric);
    if (!measured(values)) continue;
    table.headings.emplace_back(metric.name);
    for (std::size_t i = 0; i < cases.size(); ++i) table.rows[i].push_back(numberText(values[i]));
  }
  return table;
}

ReportTable summaryTable(const Cases& cases, const ReportChoices& choices) {
  ReportTable table{"All cases together, with equal weights",
                    {"", "mean \xC2\xB1 SD", "median [quartiles]", "95 % CI of the mean", "n"},
                    {},
                    /*words=*/false};
  for (const CohortMetric& metric : cohortMetrics()) {
    const std::vector<double> values = valuesOf(cases, metric);
    if (!measured(values)) continue;
    const CohortSummary s = summariseCohort(values, choices.seed);
    table.rows.push_back(
        {metric.name, spread(s), quartiles(s), intervalText(s.mean_ci), std::to_string(s.count)});
  }
  return table;
}

AgreementLevel level(double value, const Interval& ci) { return {value, ci.low, ci.high}; }

ReportTable agreementTable(const std::string& caption, const BlandAltman& b) {
  ReportTable table{caption, {"", "mm", "95 % CI"}, {}, /*words=*/false};
  table.rows = {
      {"bias (mean difference)", numberText(b.bias), intervalText(b.bias_ci)},
      {"lower limit of agreement", numberText(b.limits.low), intervalText(b.low_limit_ci)},
      {"upper limit of agreement", numberText(b.limits.high), intervalText(b.high_limit_ci)},
      {"SD of the differences", numberText(b.sd), ""},
      {"cases", std::to_string(b.count), ""}};
  return table;
}

/// Adds nothing for fewer than two differences.
void addAgreement(AgreementData data, const std::string& caption, const std::string& figure_caption,
                  std::vector<ReportPart>& parts) {
  for (std::size_t i = 0; i < data.x.size(); ++i)
    if (!std::isfinite(data.x[i])) data.differences[i] = Statistics::kNone;
  const BlandAltman b = blandAltman(data.differences);
  if (b.count < 2) return;
  data.bias = level(b.bias, b.bias_ci);
  data.low_limit = level(b.limits.low, b.low_limit_ci);
  data.high_limit = level(b.limits.high, b.high_limit_ci);
  parts.emplace_back(agreementTable(caption, b));
  parts.emplace_back(ReportFigures{{{drawAgreement(data), figure_caption}}});
}

const CohortMetric& metricNamed(const std::string& key) {
  return *std::find_if(cohortMetrics().begin(), cohortMetrics().end(),
                       [&](const CohortMetric& m) { return key == m.key; });
}

std::vector<double> differencesOf(const Cases& cases, const Cases& versus,
                                  const CohortMetric& metric) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < cases.size(); ++i)
    differences.push_back(valueOf(cases[i], metric) - valueOf(versus[i], metric));
  return differences;
}

Json limitsJson(const Interval& i) { return {{"low", i.low}, {"high", i.high}}; }

Json agreementJson(const BlandAltman& b) {
  return {{"n", b.count},
          {"bias_mm", b.bias},
          {"sd_mm", b.sd},
          {"limits_mm", limitsJson(b.limits)},
          {"bias_ci_mm", limitsJson(b.bias_ci)},
          {"low_limit_ci_mm", limitsJson(b.low_limit_ci)},
          {"high_limit_ci_mm", limitsJson(b.high_limit_ci)}};
}

/// For cases that all lack distances.
std::vector<ReportPart> truthlessCohortParts(const Cases& cases, const ReportChoices& choices) {
  const auto summary = [&](const char* key) {
    return summariseCohort(valuesOf(cases, metricNamed(key)), choices.seed);
  };
  const CohortSummary psnr = summary(metric_paths::kCohortPsnr),
                      kept = summary(metric_paths::kCohortBackProjection);
  std::string text =
      "None of the " + std::to_string(cases.size()) +
      " cases has ground truth: the distance of the models from the tissue is unknown.";
  if (std::isfinite(psnr.mean))
    text += " Rendered from their own poses, they resemble the images with a PSNR of " +
            spread(psnr) + " dB.";
  if (std::isfinite(kept.mean))
    text += " Visible points are " + spread(kept) + " mm from the depth used for them.";
  return {ReportParagraph{text, /*important=*/true}, summaryTable(cases, choices),
          casesTable(cases)};
}

/// By P95; cases without P95 are excluded. Null if none has one.
const ReportCase* worstOf(const Cases& cases) {
  const ReportCase* worst = nullptr;
  for (const ReportCase& c : cases)
    if (std::isfinite(c.main(metric_paths::kP95)) &&
        (worst == nullptr || c.main(metric_paths::kP95) > worst->main(metric_paths::kP95)))
      worst = &c;
  return worst;
}

}  // namespace

const std::vector<CohortMetric>& cohortMetrics() {
  static const std::vector<CohortMetric> metrics{
      {"fused_share", "frames fused [share]", "outcomes.fused_share", ""},
      {metric_paths::kMean, "mean distance [mm]", "surface.mean_mm", "accuracy.mean_mm"},
      {metric_paths::kMedian, "median [mm]", "surface.median_mm", "accuracy.median_mm"},
      {metric_paths::kP95, "P95 [mm]", "surface.p95_mm", "accuracy.p95_mm"},
      {metric_paths::kMax, "largest [mm]", "surface.max_mm", "accuracy.max_mm"},
      {metric_paths::kCohortSignedMean, "signed mean [mm]", metric_paths::kSignedMean,
       metric_paths::kSignedMeanOfPair},
      {"hd95_max_of_directed_mm", "HD95, larger of both [mm]",
       "surface.hausdorff.hd95_max_of_directed_mm", "hausdorff.hd95_max_of_directed_mm"},
      {"completeness_1mm", "reconstructed [share]", metric_paths::kCompleteness, ""},
      {"track_mean_mm", "material points, mean [mm]", "tracks.mean_mm", ""},
      {metric_paths::kCohortBackProjection, "back-projection, mean [mm]",
       metric_paths::kBackProjectionMean, ""},
      {metric_paths::kCohortPsnr, "PSNR of the drawn view [dB]", metric_paths::kPsnr, ""},
      {"ssim", "SSIM of the drawn view", metric_paths::kSsim, ""}};
  return metrics;
}

ReportTable cohortComparedTable(const Cases& cases) {
  ReportTable table{"", {"case", "tested", "reference", "alignment"}, {}, /*words=*/true};
  for (const ReportCase& c : cases) {
    const bool pair = c.kind == ReportCase::Kind::kPair;
    const std::string how = c.alignment();
    table.rows.push_back({c.name, pair ? "surface model" : "live model of a video",
                          pair                                ? "surface"
                          : !c.hasTruth()                     ? "none: no ground truth"
                          : c.kind == ReportCase::Kind::kMesh ? "static surface"
                                                              : "ground truth of the video",
                          how.empty() ? "not said" : how});
  }
  return table;
}

bool anyTruth(const Cases& cases) {
  return std::any_of(cases.begin(), cases.end(), [](const ReportCase& c) { return c.hasTruth(); });
}

std::vector<ReportPart> cohortParts(const Cases& cases, const ReportChoices& choices) {
  if (!anyTruth(cases)) return truthlessCohortParts(cases, choices);
  const auto means = valuesOf(cases, metricNamed(metric_paths::kMean));
  const auto p95s = valuesOf(cases, metricNamed(metric_paths::kP95));
  const CohortSummary mean = summariseCohort(means, choices.seed);
  const CohortSummary p95 = summariseCohort(p95s, choices.seed);
  const ReportCase* worst = worstOf(cases);
  std::vector<ReportPart> parts;
  const std::size_t judged = static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(), [](const ReportCase& c) { return c.hasTruth(); }));
  parts.emplace_back(ReportParagraph{
      (judged == 1 ? std::string("In one case") : "Over " + std::to_string(judged) + " cases") +
          " the distance of the model is " + spread(mean) +
          " mm from the reference (mean and SD of the means of the cases); 95 % of the points of a "
          "case are within " +
          spread(p95) + " mm." +
          (judged == cases.size() ? ""
                                  : " " + std::to_string(cases.size() - judged) +
                                        " more have no ground truth: their distances are unknown."),
      /*important=*/true});
  parts.emplace_back(ReportTiles{
      {{"Mean distance", numberText(mean.mean) + " mm", "SD of the cases " + numberText(mean.sd)},
       {"95 % CI of that mean", intervalText(mean.mean_ci),
        std::isfinite(mean.mean_ci.low) ? "mm, bootstrap over the cases"
                                        : "needs three cases or more"},
       {"95th percentile", numberText(p95.mean) + " mm", "median " + numberText(p95.median)},
       {"Worst case by P95", worst == nullptr ? "not measured" : worst->name,
        worst == nullptr ? "" : millimetresText(worst->main(metric_paths::kP95))}}});
  parts.emplace_back(summaryTable(cases, choices));
  parts.emplace_back(casesTable(cases));
  AgreementData data;
  data.title = "Agreement of model and reference";
  data.x_label = "mean distance of the case [mm]";
  data.y_label = "signed mean [mm]";
  data.x = means;
  data.differences = valuesOf(cases, metricNamed(metric_paths::kCohortSignedMean));
  addAgreement(std::move(data), "Agreement with the reference (Bland-Altman, per case first)",
               "Each dot is a case: its mean signed distance, + = outside the reference. Bands: "
               "95 % confidence.",
               parts);
  return parts;
}

std::vector<ReportPart> pairedParts(const Cases& cases, const Cases& versus,
                                    const ReportChoices& choices) {
  ReportTable table{"Differences, these cases minus --versus",
                    {"", "these", "versus", "difference", "95 % CI", "signed-rank p"},
                    {},
                    /*words=*/false};
  for (const CohortMetric& metric : cohortMetrics()) {
    const std::vector<double> differences = differencesOf(cases, versus, metric);
    if (!measured(differences)) continue;
    const CohortSummary d = summariseCohort(differences, choices.seed);
    table.rows.push_back({metric.name,
                          numberText(summariseCohort(valuesOf(cases, metric), choices.seed).mean),
                          numberText(summariseCohort(valuesOf(versus, metric), choices.seed).mean),
                          numberText(d.mean), intervalText(d.mean_ci),
                          numberText(signedRankTest(differences).p_value)});
  }
  std::vector<ReportPart> parts{table};
  const CohortMetric& metric = metricNamed(metric_paths::kMean);
  AgreementData data;
  data.title = "Two methods, the same cases";
  data.x_label = "mean distance, both methods' mean [mm]";
  data.y_label = "difference [mm]";
  data.differences = differencesOf(cases, versus, metric);
  for (std::size_t i = 0; i < cases.size(); ++i)
    data.x.push_back((valueOf(cases[i], metric) + valueOf(versus[i], metric)) / 2);
  addAgreement(std::move(data), "Agreement of the two methods (Bland-Altman)",
               "Each dot is a case: its mean distance here minus that of --versus. Bands: 95 % "
               "confidence.",
               parts);
  return parts;
}

ReportList cohortMethods(bool paired) {
  ReportList list;
  list.items = {
      "Cohort: every case has the same weight, for any number of points. SD over n - 1; quartiles "
      "linear between ranks. Confidence interval of a mean: percentile bootstrap over the cases, "
      "2000 resamples, seeded; none below three cases.",
      "Bland-Altman: bias and bias \xC2\xB1 1.96 SD of one difference per case, intervals by "
      "Student's t (Bland and Altman 1999). For few cases the limits are wide: see the intervals."};
  if (paired)
    list.items.push_back(
        "Paired: Wilcoxon's signed-rank test, two-sided, without zeros, exact up to 25 cases; not "
        "corrected for the number of metrics.");
  return list;
}

Json cohortJson(const Cases& cases, const Cases& versus, const ReportChoices& choices) {
  Json json = Json::object();
  for (const CohortMetric& metric : cohortMetrics()) {
    const std::vector<double> values = valuesOf(cases, metric);
    if (!measured(values)) continue;
    const CohortSummary s = summariseCohort(values, choices.seed);
    json[metric.key] = {{"n", s.count},
                        {"mean", s.mean},
                        {"sd", s.sd},
                        {"median", s.median},
                        {"quartile_1", s.quartile_1},
                        {"quartile_3", s.quartile_3},
                        {"mean_ci", limitsJson(s.mean_ci)}};
    if (versus.empty()) continue;
    const std::vector<double> differences = differencesOf(cases, versus, metric);
    const CohortSummary d = summariseCohort(differences, choices.seed);
    json[metric.key]["versus"] = {{"mean_difference", d.mean},
                                  {"mean_difference_ci", limitsJson(d.mean_ci)},
                                  {"signed_rank_p", signedRankTest(differences).p_value}};
  }
  json["agreement"] =
      agreementJson(blandAltman(valuesOf(cases, metricNamed(metric_paths::kCohortSignedMean))));
  return json;
}

}  // namespace softscope
