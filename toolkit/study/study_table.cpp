// toolkit/study/study_table.cpp: from records to cells.
#include "toolkit/study/study_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "core/nearest_name.h"
#include "core/not_measured.h"
#include "io/text/message.h"
#include "toolkit/record/machine.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr double kLeastFusedShare = 0.5;

/// "0.30000000000000004" is 0.3.
std::string shortest(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

std::string cell(double value, int decimals) {
  return std::isfinite(value) ? fixed(value, decimals) : "";
}

std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string markdownCell(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return safe;
}

bool anyValue(const std::vector<Json>& records, const std::string& path) {
  return std::any_of(records.begin(), records.end(),
                     [&](const Json& r) { return std::isfinite(valueAt(r, path)); });
}

std::string statusOf(const Json& record) {
  return record.is_object() ? record.value("status", "unknown") : "not run";
}

/// Headings of published values directly after the name, then those of this study.
std::vector<std::string> publishedHeadings(const Study& study) {
  std::set<std::string> headings;
  for (const StudyCase& one : study.cases)
    for (const auto& [heading, value] : one.beside) headings.insert(heading);
  return {headings.begin(), headings.end()};
}

std::string listed(const std::vector<double>& levels) {
  std::string text;
  for (const double level : levels) text += (text.empty() ? "" : ", ") + shortest(level);
  return text;
}

/// Cases without a result neither hold nor break.
std::string breakText(const StudyBreak& found) {
  const std::string unknown = found.not_run.empty() ? "" : "; not run: " + listed(found.not_run);
  if (found.broken) return "breaks at " + shortest(found.level) + unknown;
  return found.not_run.empty() ? "holds at all levels" : "holds at " + listed(found.held) + unknown;
}

/// Dotted paths of all numbers and nulls.
void addPaths(const Json& record, const std::string& head, std::vector<std::string>& paths) {
  if (record.is_number() || record.is_null()) paths.push_back(head);
  if (!record.is_object()) return;
  for (const auto& [key, value] : record.items())
    addPaths(value, head.empty() ? key : head + "." + key, paths);
}

std::string unknownMetric(const std::string& at, const std::string& path,
                          const std::vector<std::string>& known) {
  const bool spelt = std::find(known.begin(), known.end(), path) != known.end();
  const std::string nearest = spelt ? "" : nearestName(path, known);
  return at + ": no case has a value of `" + path + "`" +
         (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)");
}

std::vector<std::string> notesOf(const Study& study, const std::vector<Json>& records) {
  std::vector<std::string> notes = metricWarnings(study, records);
  std::set<std::string> builds;
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const StudyCase& one = study.cases[i];
    for (const std::string& note : one.notes) notes.push_back(one.name + ": " + note);
    if (!records[i].is_object()) continue;
    if (const std::string reason = records[i].value("reason", ""); !reason.empty())
      notes.push_back(one.name + ": " + reason);
    if (records[i].contains("executable_sha256"))
      builds.insert(records[i]["executable_sha256"].get<std::string>());
  }
  for (const StudyBreak& found : breaksOf(study, records))
    notes.push_back(found.plot + ", " + found.sweep +
                    (found.series.empty() ? "" : ", " + found.series) + ": " + breakText(found));
  if (builds.size() > 1)
    notes.push_back("the cases were run by " + std::to_string(builds.size()) +
                    " different builds of softscope; --force runs all of them again");
  return notes;
}

Json sweepsJson(const Study& study) {
  Json sweeps = Json::array();
  for (const StudySweep& sweep : study.sweeps)
    sweeps.push_back({{"name", sweep.name}, {"label", sweep.label}, {"levels", sweep.levels}});
  return sweeps;
}

Json caseJson(const StudyCase& one, const Json& record) {
  Json json = record;
  if (!json.is_object())
    json = {
        {"name", one.name}, {"case", one.base}, {"variant", one.variant}, {"status", "not run"}};
  json["beside"] = one.beside;
  return json;
}

bool breaks(const Json& record, const StudyPlot& plot) {
  const double value = valueAt(record, plot.metric.path);
  return !std::isfinite(value) || value > plot.limit ||
         valueAt(record, "run.fused_share") < kLeastFusedShare;
}

/// Levels are ascending: the first that breaks is kept.
void addLevel(const StudyCase& one, const Json& record, const StudyPlot& plot,
              std::vector<StudyBreak>& found) {
  const std::string series = seriesName(one);
  auto entry = std::find_if(found.begin(), found.end(), [&](const StudyBreak& b) {
    return b.plot == plot.name && b.series == series && b.sweep == one.sweep;
  });
  if (entry == found.end()) {
    found.push_back({plot.name, series, one.sweep, false, 0, {}, {}});
    entry = std::prev(found.end());
  }
  if (!wasRun(record)) {
    entry->not_run.push_back(one.level);
  } else if (!breaks(record, plot)) {
    entry->held.push_back(one.level);
  } else if (!entry->broken) {
    entry->broken = true;
    entry->level = one.level;
  }
}

}  // namespace

const std::vector<StudyMetric>& usualColumns() {
  static const std::vector<StudyMetric> columns{
      {"run.fused_share", "frames fused [share]", 2},
      {"evaluation.tracks.reported", "material points reported [share]", 2},
      {"evaluation.tracks.mean_mm", "material points mean [mm]", 3},
      {"evaluation.tracks.p95_mm", "material points P95 [mm]", 3},
      {"evaluation.tracks.no_motion_control_mm", "had nothing been tracked [mm]", 2},
      {"evaluation.surface.mean_mm", "surface mean [mm]", 3},
      {"evaluation.surface.p95_mm", "surface P95 [mm]", 3},
      {"evaluation.surface.completeness_1mm", "completeness [share]", 3},
      {"evaluation.camera.pose.rmse_mm", "scope [mm]", 2},
      {"run.mean_backprojection_mm", "back-projection [mm]", 3}};
  return columns;
}

double valueAt(const Json& record, const std::string& path) {
  const Json* at = &record;
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    if (!at->is_object() || !at->contains(part)) return kNotMeasured<double>;
    at = &(*at)[part];
  }
  return at->is_number() ? at->get<double>() : kNotMeasured<double>;
}

std::string seriesName(const StudyCase& one) {
  return one.base + (one.base.empty() || one.variant.empty() ? "" : ", ") + one.variant;
}

bool wasRun(const Json& record) {
  const std::string status = statusOf(record);
  return status == "done" || status == "failed";
}

std::vector<StudyBreak> breaksOf(const Study& study, const std::vector<Json>& records) {
  std::vector<StudyBreak> found;
  for (const StudyPlot& plot : study.plots) {
    if (!(plot.limit > 0)) continue;
    for (std::size_t i = 0; i < study.cases.size(); ++i) {
      const StudyCase& one = study.cases[i];
      if (!one.sweep.empty()) addLevel(one, records[i], plot, found);
    }
  }
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const StudyBreak& b) { return !b.broken && b.held.empty(); }),
              found.end());
  return found;
}

std::vector<std::string> metricWarnings(const Study& study, const std::vector<Json>& records) {
  std::vector<std::string> known;
  for (const Json& record : records)
    if (statusOf(record) == "done") addPaths(record, "", known);
  if (known.empty()) return {};
  std::vector<std::string> warnings;
  const auto check = [&](const std::string& at, const std::string& path, const char* effect) {
    if (!path.empty() && !anyValue(records, path))
      warnings.push_back(unknownMetric(at, path, known) + effect);
  };
  for (const StudyMetric& column : study.columns) check("column", column.path, "");
  for (const StudyPlot& plot : study.plots) {
    const bool judges = plot.limit > 0 && !study.sweeps.empty();
    check("plot " + plot.name, plot.metric.path, judges ? "; every level counts as broken" : "");
    check("plot " + plot.name, plot.p95_path, "");
  }
  return warnings;
}

Json studyJson(const Study& study, const std::vector<Json>& records, const std::string& command) {
  const Machine machine = describeMachine();
  Json json{{"schema_version", 1},
            {"softscope", versionText()},
            {"compiler", compilerText()},
            {"command", command},
            {"title", study.title},
            {"about", study.about},
            {"machine", {{"processor", machine.processor}, {"cores", machine.cores}}}};
  json["sweeps"] = sweepsJson(study);
  json["breaks"] = Json::array();
  for (const StudyBreak& found : breaksOf(study, records))
    json["breaks"].push_back({{"plot", found.plot},
                              {"series", found.series},
                              {"sweep", found.sweep},
                              {"level", found.broken ? Json(found.level) : Json()},
                              {"levels_not_run", found.not_run}});
  json["cases"] = Json::array();
  for (std::size_t i = 0; i < records.size(); ++i)
    json["cases"].push_back(caseJson(study.cases[i], records[i]));
  const StudyTable table = studyTable(study, records);
  json["table"] = {{"headings", table.headings}, {"rows", table.rows}, {"notes", table.notes}};
  return json;
}

StudyTable studyTable(const Study& study, const std::vector<Json>& records) {
  StudyTable table;
  table.headings = {"case"};
  const std::vector<std::string> beside = publishedHeadings(study);
  table.headings.insert(table.headings.end(), beside.begin(), beside.end());
  std::vector<StudyMetric> columns = study.columns.empty() ? usualColumns() : study.columns;
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                               [&](const StudyMetric& c) { return !anyValue(records, c.path); }),
                columns.end());
  for (const StudyMetric& column : columns) table.headings.push_back(column.label);
  table.headings.emplace_back("status");
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const StudyCase& one = study.cases[i];
    std::vector<std::string> row{one.name};
    for (const std::string& heading : beside)
      row.push_back(one.beside.count(heading) == 0 ? "" : shortest(one.beside.at(heading)));
    for (const StudyMetric& column : columns)
      row.push_back(cell(valueAt(records[i], column.path), column.decimals));
    row.push_back(statusOf(records[i]));
    table.rows.push_back(std::move(row));
  }
  table.notes = notesOf(study, records);
  return table;
}

std::string StudyTable::csv() const {
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + csvCell(cells[i]);
    text += "\n";
  };
  add(headings);
  for (const auto& row : rows) add(row);
  return text;
}

std::string StudyTable::markdown() const {
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    for (const std::string& one : cells) text += "| " + markdownCell(one) + " ";
    text += "|\n";
  };
  add(headings);
  add(std::vector<std::string>(headings.size(), "---"));
  for (const auto& row : rows) add(row);
  for (const std::string& note : notes) text += "\n- " + note;
  return notes.empty() ? text : text + "\n";
}

}  // namespace softscope
