// toolkit/report/report_document.cpp: sections in clinical reading order.
#include "toolkit/report/report_document.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/files/file_hash.h"
#include "toolkit/record/version.h"
#include "toolkit/report/metric_paths.h"
#include "toolkit/report/report_alignment.h"
#include "toolkit/report/report_checklist.h"
#include "toolkit/report/report_cohort.h"
#include "toolkit/report/report_privacy.h"
#include "toolkit/report/report_truthless.h"
#include "toolkit/report/report_words.h"
#include "vtk_views/drawing/nice_ticks.h"
#include "vtk_views/scenes/error_map_figure.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

const char* const kNotice = "Research use only, not for diagnosis.";

/// Round number at or above the largest
/// 95th percentile, common to all cases.
double colourLimit(const std::vector<ReportCase>& cases) {
  double largest_mm = 0;
  for (const ReportCase& c : cases)
    if (std::isfinite(c.main(metric_paths::kP95)))
      largest_mm = std::max(largest_mm, c.main(metric_paths::kP95));
  return roundUp(largest_mm);
}

ReportPart outcomesTable(const ReportRequest& request) {
  ReportTable table{"Limits of this report (--fail-if)",
                    {"case", "fails if", "metric", "value", "outcome"},
                    {},
                    /*words=*/true};
  for (std::size_t i = 0; i < request.cases.size(); ++i)
    for (const ThresholdOutcome& o : request.outcomes[i])
      table.rows.push_back({request.cases[i].name, o.threshold.text(), o.path, numberText(o.value),
                            o.failed ? "FAILED" : "kept"});
  return table;
}

bool hasOutcomes(const ReportRequest& request) {
  return std::any_of(request.outcomes.begin(), request.outcomes.end(),
                     [](const auto& outcomes) { return !outcomes.empty(); });
}

void append(std::vector<ReportPart> more, std::vector<ReportPart>& parts) {
  for (ReportPart& part : more) parts.push_back(std::move(part));
}

std::vector<ReportPart> pictureParts(const ReportCase& c) {
  std::vector<ReportPart> parts;
  for (const auto& [caption, png] : c.pictures) parts.emplace_back(ReportPicture{png, caption});
  return parts;
}

ReportMapPlace mapPlace(const std::vector<ReportCase>& cases, double limit_mm) {
  const bool series = std::any_of(cases.begin(), cases.end(),
                                  [](const ReportCase& c) { return c.maps.size() > 1; });
  const std::string same = "Colours run to " + millimetresText(limit_mm) +
                           " for every case and frame, and are not shaded; ";
  return {"Error map. " + same + "grey is the reference without a model in front of it.",
          (series ? "Error maps, last frame. " : "Error maps. ") + same +
              "arrows at the bar: some values are outside of the range. Grey: the reference "
              "without a model in front of it."};
}

/// Both kinds of distance for one case, absolute distances
/// for several; none, with a warning, without a renderer.
std::optional<VectorDrawing> mapFigure(const std::vector<ReportMap>& maps, double limit_mm,
                                       std::vector<std::string>* warnings) {
  constexpr std::size_t kMostCells = 12;
  std::vector<ErrorMapCell> cells;
  for (const ReportMap& map : maps) {
    if (cells.size() == kMostCells) break;
    cells.push_back({maps.size() == 1 ? "Distance" : map.name, &map.moments.back(), false});
    if (maps.size() == 1) cells.push_back({"Signed distance", &map.moments.back(), true});
  }
  if (cells.empty()) return std::nullopt;
  ErrorMapFigureStyle style;
  style.limit_mm = limit_mm;
  style.columns = maps.size() <= 2 ? 2 : 3;
  try {
    return drawErrorMaps(cells, style);
  } catch (const BackendError& error) {
    warnings->push_back(std::string("the report has no image of its map: ") + error.what());
    return std::nullopt;
  }
}

/// Removes headings without content.
void removeEmpty(std::vector<ReportSection>& sections) {
  sections.erase(std::remove_if(sections.begin(), sections.end(),
                                [](const ReportSection& section) { return section.parts.empty(); }),
                 sections.end());
}

std::vector<ReportSection> caseSections(const ReportRequest& request, double limit_mm) {
  const ReportCase& c = request.cases.front();
  std::vector<ReportSection> sections;
  if (!c.drawn_view.empty())
    sections.push_back({"view",
                        "Image and model side by side",
                        {ReportPicture{c.drawn_view, drawnViewCaption(c)}}});
  sections.push_back({"compared", "What was compared", {comparedTable(c, request.choices)}});
  append(alignmentParts(c), sections.back().parts);
  sections.push_back({"result", "Result and uncertainty", {}});
  if (hasOutcomes(request)) sections.back().parts.push_back(outcomesTable(request));
  append(resultParts(c), sections.back().parts);
  sections.push_back({"pictures", "Pictures", {}});
  if (!c.maps.empty()) sections.back().parts.emplace_back(mapPlace(request.cases, limit_mm));
  append(plotParts(c), sections.back().parts);
  append(pictureParts(c), sections.back().parts);
  sections.push_back({"grading", "Review", {ReportReview{{c.name}}}});
  sections.push_back({"limits", "Limits", {limitsList(c, request.choices)}});
  sections.push_back({"methods", "Methods", {methodsList(c)}});
  sections.push_back({"provenance", "Provenance", {provenanceTable(c, request.choices)}});
  removeEmpty(sections);
  return sections;
}

std::vector<ReportPart> caseTables(const ReportCase& c) {
  if (c.hasTruth()) return {distancesTable(c, c.name)};
  std::vector<ReportPart> parts{truthlessHeadline(c)};
  std::get<ReportParagraph>(parts[0]).text.insert(0, c.name + ". ");
  for (ReportTable& table : truthlessTables(c))
    if (!table.rows.empty()) parts.emplace_back(std::move(table));
  return parts;
}

void addLimits(const ReportCase& c, const ReportChoices& choices, ReportList& list) {
  for (const std::string& item : limitsList(c, choices).items)
    if (std::find(list.items.begin(), list.items.end(), item) == list.items.end())
      list.items.push_back(item);
}

/// Once per kind of comparison.
ReportList methodsOf(const ReportRequest& request) {
  ReportList list;
  for (const ReportCase& c : request.cases)
    for (const std::string& item : methodsList(c).items)
      if (std::find(list.items.begin(), list.items.end(), item) == list.items.end())
        list.items.push_back(item);
  for (const std::string& item : cohortMethods(!request.versus.empty()).items)
    list.items.push_back(item);
  return list;
}

std::vector<ReportSection> cohortSections(const ReportRequest& request, double limit_mm) {
  const ReportChoices& choices = request.choices;
  std::vector<ReportSection> sections;
  sections.push_back({"compared", "What was compared", {cohortComparedTable(request.cases)}});
  sections.push_back({"result", "Result and uncertainty", {}});
  if (hasOutcomes(request)) sections.back().parts.push_back(outcomesTable(request));
  append(cohortParts(request.cases, choices), sections.back().parts);
  if (!request.versus.empty())
    append(pairedParts(request.cases, request.versus, choices), sections.back().parts);
  sections.push_back({"pictures", "Pictures", {}});
  ReportSection review{"grading", "Review", {}}, each{"each", "Each case", {}},
      provenance{"provenance", "Provenance", {}};
  ReportList limits;
  ReportReview reviewed;
  const bool mapped = std::any_of(request.cases.begin(), request.cases.end(),
                                  [](const ReportCase& c) { return !c.maps.empty(); });
  if (mapped) sections.back().parts.emplace_back(mapPlace(request.cases, limit_mm));
  for (const ReportCase& c : request.cases) {
    reviewed.cases.push_back(c.name);
    append(caseTables(c), each.parts);
    if (!c.drawn_view.empty())
      each.parts.emplace_back(ReportPicture{c.drawn_view, drawnViewCaption(c)});
    append(plotParts(c), each.parts);
    append(pictureParts(c), each.parts);
    addLimits(c, choices, limits);
    ReportTable table = provenanceTable(c, choices);
    table.caption = c.name;
    provenance.parts.emplace_back(std::move(table));
  }
  review.parts.emplace_back(reviewed);
  sections.push_back(std::move(review));
  sections.push_back(std::move(each));
  sections.push_back({"limits", "Limits", {limits}});
  sections.push_back({"methods", "Methods", {methodsOf(request)}});
  sections.push_back(std::move(provenance));
  removeEmpty(sections);
  return sections;
}

Json metricsOf(const ReportRequest& request, double limit_mm) {
  Json metrics{{"schema_version", 1},
               {"kind", "softscope_report"},
               {"softscope", versionText()},
               {"colour_limit_mm", limit_mm},
               {"seed", request.choices.seed}};
  metrics["cases"] = Json::array();
  for (std::size_t i = 0; i < request.cases.size(); ++i) {
    const ReportCase& c = request.cases[i];
    Json entry{{"name", c.name}};
    entry["record"] = request.choices.with_paths ? c.record : withoutPaths(c.record);
    entry["thresholds"] = thresholdsJson(request.outcomes[i]);
    for (const auto& [what, hash] : c.hashes) entry["sha256"][what] = hash;
    metrics["cases"].push_back(std::move(entry));
  }
  if (request.cases.size() > 1)
    metrics["cohort"] = cohortJson(request.cases, request.versus, request.choices);
  // identifies this report in a saved review
  metrics["content_sha256"] =
      sha256OfBytes(metrics.dump(-1, ' ', false, Json::error_handler_t::replace));
  return metrics;
}

std::string titleOf(const ReportRequest& request) {
  if (!request.title.empty()) return request.title;
  if (request.cases.size() > 1)
    return anyTruth(request.cases) ? "Surface accuracy of several cases"
                                   : "Several live surface models without ground truth";
  if (!request.cases.front().hasTruth()) return "A live surface model without ground truth";
  return request.cases.front().kind == ReportCase::Kind::kPair ? "Accuracy of a surface model"
                                                               : "Accuracy of a live surface model";
}

}  // namespace

ReportDocument makeReport(ReportRequest request) {
  fitIntoPage(request.cases);
  ReportDocument document;
  ReportPage& page = document.page;
  page.limit_mm = request.limit_mm > 0 ? request.limit_mm : colourLimit(request.cases);
  page.title = titleOf(request);
  page.notice = kNotice;
  page.subtitle = request.cases.size() == 1 ? request.cases.front().name
                                            : std::to_string(request.cases.size()) + " cases";
  page.sections = request.cases.size() == 1 ? caseSections(request, page.limit_mm)
                                            : cohortSections(request, page.limit_mm);
  if (const std::string& checklist = request.choices.checklist; !checklist.empty())
    page.sections.push_back({"checklist", "Reporting checklist", {checklistTable(checklist)}});
  document.metrics = metricsOf(request, page.limit_mm);
  page.metrics_json = document.metrics.dump(1, ' ', false, Json::error_handler_t::replace);
  document.facts = FactSheet(page.title + ", " + page.subtitle);
  for (ReportCase& c : request.cases) {
    document.facts.addLine(c.name, c.hasTruth()
                                       ? "mean " + millimetresText(c.main(metric_paths::kMean)) +
                                             ", P95 " + millimetresText(c.main(metric_paths::kP95))
                                       : truthlessSummary(c));
    if (!c.maps.empty()) page.maps.push_back({c.name, std::move(c.maps)});
  }
  page.map_figure = mapFigure(page.maps, page.limit_mm, &document.warnings);
  for (const auto& outcomes : request.outcomes)
    document.outcomes.insert(document.outcomes.end(), outcomes.begin(), outcomes.end());
  return document;
}

}  // namespace softscope
