// toolkit/study/study_outputs.cpp: figures, page, tables.
#include "toolkit/study/study_outputs.h"

#include <algorithm>
#include <cmath>

#include "core/not_measured.h"
#include "io/files/atomic_file.h"
#include "io/images/image_writer.h"
#include "toolkit/record/json_text.h"
#include "vtk_views/drawing/html_text.h"
#include "vtk_views/plots/level_plot.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr double kPageDotsPerInch = 200;

const char* const kStyle =
    "<style>body{font:15px/1.45 system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em;"
    "color:#222}table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums}"
    "th,td{border-bottom:1px solid #ddd;padding:.3em .7em;text-align:right}"
    "th:first-child,td:first-child{text-align:left}th{border-bottom:2px solid #888;"
    "vertical-align:bottom}.wide{overflow-x:auto}figure{display:inline-block;margin:1em 1.5em 0 0}"
    ".how{color:#555;font-size:13px}code{font-size:12px}</style>";

std::vector<StudyPlot> plotsOf(const Study& study) {
  if (!study.plots.empty()) return study.plots;
  return {{"points",
           {"evaluation.tracks.mean_mm", "error of material points [mm]", 3},
           "evaluation.tracks.p95_mm",
           0}};
}

bool anyFinite(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

LevelPlotData levelsOf(const Study& study, const std::vector<Json>& records,
                       const StudySweep& sweep, const StudyPlot& plot) {
  LevelPlotData data{study.title, sweep.label, plot.metric.label, {}, plot.limit};
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const StudyCase& one = study.cases[i];
    if (one.sweep != sweep.name || !wasRun(records[i])) continue;
    const std::string name = seriesName(one);
    auto curve = std::find_if(data.curves.begin(), data.curves.end(),
                              [&](const LevelCurve& c) { return c.name == name; });
    if (curve == data.curves.end()) curve = data.curves.insert(curve, LevelCurve{name, {}, {}, {}});
    curve->levels.push_back(one.level);
    curve->mean.push_back(valueAt(records[i], plot.metric.path));
    curve->p95.push_back(valueAt(records[i], plot.p95_path));
  }
  return data;
}

CaseBarsData barsOf(const Study& study, const std::vector<Json>& records, const StudyPlot& plot) {
  CaseBarsData data{study.title, plot.metric.label, "", {}};
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const StudyCase& one = study.cases[i];
    const double mean = valueAt(records[i], plot.metric.path);
    if (!std::isfinite(mean)) continue;
    const bool published = !one.beside.empty();
    if (published) data.published_label = one.beside.begin()->first;
    data.bars.push_back({seriesName(one), mean, valueAt(records[i], plot.p95_path),
                         published ? one.beside.begin()->second : kNotMeasured<double>});
  }
  return data;
}

bool anyMean(const LevelPlotData& data) {
  return std::any_of(data.curves.begin(), data.curves.end(),
                     [](const LevelCurve& c) { return anyFinite(c.mean); });
}

std::string pageTable(const StudyTable& table) {
  std::string html = "<div class=\"wide\"><table><thead><tr>";
  for (const std::string& heading : table.headings) html += "<th>" + htmlEscaped(heading) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + htmlEscaped(cell) + "</td>";
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (table.notes.empty()) return html;
  html += "<ul>";
  for (const std::string& note : table.notes) html += "<li>" + htmlEscaped(note) + "</li>\n";
  return html + "</ul>\n";
}

/// Without the XML declaration, which is invalid inside HTML.
std::string inlineSvg(const VectorDrawing& drawing) {
  const std::string svg = svgBytes(drawing);
  return svg.substr(svg.find("<svg"));
}

}  // namespace

std::vector<StudyFigure> studyFigures(const Study& study, const std::vector<Json>& records) {
  std::vector<StudyFigure> figures;
  for (const StudyPlot& plot : plotsOf(study)) {
    for (const StudySweep& sweep : study.sweeps) {
      const LevelPlotData data = levelsOf(study, records, sweep, plot);
      if (anyMean(data)) figures.emplace_back(sweep.name + "_" + plot.name, drawLevels(data));
    }
    if (!study.sweeps.empty()) continue;
    const CaseBarsData data = barsOf(study, records, plot);
    if (!data.bars.empty()) figures.emplace_back(plot.name, drawCaseBars(data));
  }
  return figures;
}

std::string studyPage(const Study& study, const StudyTable& table,
                      const std::vector<StudyFigure>& figures, const Json& record) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     htmlEscaped(study.title) + "</title>" + kStyle + "</head><body>\n<h1>" +
                     htmlEscaped(study.title) + "</h1>\n";
  if (!study.about.empty()) html += "<p>" + htmlEscaped(study.about) + "</p>\n";
  html += pageTable(table);
  for (const auto& [name, drawing] : figures)
    html += "<figure>" + inlineSvg(drawing) + "</figure>\n";
  html += "<p class=\"how\">softscope " + htmlEscaped(record["softscope"].get<std::string>()) +
          " (" + htmlEscaped(record["compiler"].get<std::string>()) + ") on " +
          htmlEscaped(record["machine"]["processor"].get<std::string>()) + ", " +
          record["machine"]["cores"].dump() + " cores: <code>" +
          htmlEscaped(record["command"].get<std::string>()) +
          "</code><br>Research use only, not for diagnosis.</p>\n</body></html>\n";
  return html;
}

void writeStudy(const Study& study, const std::vector<Json>& records, const std::string& command,
                const StudyFolder& folder) {
  const StudyTable table = studyTable(study, records);
  const Json record = studyJson(study, records, command);
  const auto figures = studyFigures(study, records);
  const auto put = [&](const fs::path& name, const std::string& bytes) {
    writeFile(folder.root / name, bytes, true);
  };
  fs::remove_all(folder.root / "plots");  // of an older state of the study file
  if (!figures.empty()) fs::create_directories(folder.root / "plots");
  for (const auto& [name, drawing] : figures) {
    put("plots/" + name + ".svg", svgBytes(drawing));
    put("plots/" + name + ".pdf", pdfBytes(drawing));
    writePng(folder.root / ("plots/" + name + ".png"), rasterise(drawing, kPageDotsPerInch),
             kPageDotsPerInch, true);
  }
  put("table.csv", table.csv());
  put("table.md", table.markdown());
  put("report.html", studyPage(study, table, figures, record));
  put("study.json", jsonText(record));
}

}  // namespace softscope
