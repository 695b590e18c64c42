// toolkit/study/study_file.cpp: expansion of cases, variants and levels of sweeps.
#include "toolkit/study/study_file.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/error.h"
#include "core/nearest_name.h"
#include "io/documents/toml_tree.h"
#include "io/text/message.h"
#include "toolkit/study/study_settings.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

const std::vector<std::string> kParts{"simulate", "reconstruct", "evaluate"};

/// For the table: last part of an absolute path.
std::string shortPath(const fs::path& path) {
  return shown(path.is_absolute() ? path.filename() : path) + " is not here";
}

/// Reader of one study; every error message begins with `where_`.
class StudyReader {
 public:
  explicit StudyReader(const fs::path& file)
      : file_(file), where_(shown(file)), tree_(readTomlTree(file)) {}

  Study read() const;

 private:
  [[noreturn]] void fail(const std::string& what) const { throw OptionError(where_ + ": " + what); }
  void requireKnown(const Json& table, const std::string& at, std::vector<std::string> known) const;
  std::string textAt(const Json& table, const std::string& key, const std::string& other) const;
  std::string nameAt(const Json& table, const std::string& at) const;
  std::vector<Json> listAt(const std::string& key) const;

  std::string expanded(std::string text, bool& known) const;
  std::string valueText(const Json& value, const std::string& key) const;
  StudyValues flat(const Json& table, const std::string& head) const;
  void overlay(StudyCase& target, const Json& table) const;
  void overlayLevel(StudyCase& target, const Json& sweep, std::size_t index) const;
  void resolvePaths(StudyCase& target) const;
  void resolveOrgan(StudyCase& target) const;

  StudySweep sweepOf(const Json& table) const;
  StudyMetric metricOf(const Json& table, const std::string& at) const;
  void addSweeps(const StudyCase& base, std::vector<StudyCase>& cases) const;
  void readColumns(Study& study) const;

  fs::path file_;
  std::string where_;
  Json tree_;
};

void StudyReader::requireKnown(const Json& table, const std::string& at,
                               std::vector<std::string> known) const {
  if (!table.is_object()) fail(at + " must be a table");
  for (const auto& [key, value] : table.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string nearest = nearestName(key, known);
    fail(at + " has an unknown key `" + key + "`" +
         (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)"));
  }
}

std::string StudyReader::textAt(const Json& table, const std::string& key,
                                const std::string& other) const {
  if (!table.contains(key)) return other;
  if (!table[key].is_string()) fail(key + " must be a text");
  return table[key];
}

/// Names are parts of folder names.
std::string StudyReader::nameAt(const Json& table, const std::string& at) const {
  const std::string name = table.is_object() ? textAt(table, "name", "") : "";
  const bool plain =
      !name.empty() && name[0] != '.' && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-';
      });
  if (!plain) fail("every " + at + " needs a name of letters, digits, `_`, `.` and `-`");
  return name;
}

std::vector<Json> StudyReader::listAt(const std::string& key) const {
  if (!tree_.contains(key)) return {};
  if (!tree_[key].is_array()) fail("write [[" + key + "]], one table each");
  return {tree_[key].begin(), tree_[key].end()};
}

/// Replaces ${NAME}; `known` becomes false for an undefined variable.
std::string StudyReader::expanded(std::string text, bool& known) const {
  for (std::size_t begin = text.find("${"); begin != std::string::npos;
       begin = text.find("${", begin)) {
    const std::size_t end = text.find('}', begin);
    if (end == std::string::npos) fail("`" + text + "` has a ${ without its }");
    const char* value = std::getenv(text.substr(begin + 2, end - begin - 2).c_str());
    if (value == nullptr) {
      known = false;
      begin = end;
    } else {
      text.replace(begin, end + 1 - begin, value);
      begin += std::string(value).size();
    }
  }
  return text;
}

std::string StudyReader::valueText(const Json& value, const std::string& key) const {
  if (value.is_string()) return value;
  if (value.is_boolean() || value.is_number()) return value.dump();
  fail(key + " must be true, false, a number or a text (lists are for [[sweep]])");
}

/// Nested tables as dotted keys.
StudyValues StudyReader::flat(const Json& table, const std::string& head) const {
  StudyValues values;
  for (const auto& [key, value] : table.items()) {
    const std::string path = head.empty() ? key : head + "." + key;
    if (value.is_object())
      values.merge(flat(value, path));
    else
      values[path] = valueText(value, path);
  }
  return values;
}

void StudyReader::overlay(StudyCase& target, const Json& table) const {
  StudyValues* const parts[] = {&target.simulate, &target.reconstruct, &target.evaluate};
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    if (!table.contains(kParts[i])) continue;
    if (!table[kParts[i]].is_object()) fail(kParts[i] + " must be a table");
    for (const auto& [key, value] : flat(table[kParts[i]], "")) (*parts[i])[key] = value;
  }
  target.sequence = textAt(table, "sequence", target.sequence);
  if (!table.contains("beside")) return;
  for (const auto& [heading, value] : table["beside"].items()) {
    if (!value.is_number()) fail("beside." + heading + " must be a number");
    target.beside[heading] = value;
  }
}

/// Keys of a sweep have lists with one value per level.
void StudyReader::overlayLevel(StudyCase& target, const Json& sweep, std::size_t index) const {
  const auto pick = [&](const Json& table, const std::string& path, const auto& self) -> Json {
    if (table.is_object()) {
      Json picked = Json::object();
      for (const auto& [key, value] : table.items())
        picked[key] = self(value, path + "." + key, self);
      return picked;
    }
    if (!table.is_array() || table.size() != sweep["levels"].size())
      fail("sweep " + sweep["name"].get<std::string>() + ": " + path +
           " must be a list with a value for each of its " +
           std::to_string(sweep["levels"].size()) + " levels");
    return table[index];
  };
  Json table = Json::object();
  for (const std::string& part : kParts)
    if (sweep.contains(part)) table[part] = pick(sweep[part], part, pick);
  overlay(target, table);
}

/// Relative paths are relative to the study file; a case with a missing file is skipped.
void StudyReader::resolvePaths(StudyCase& target) const {
  const auto resolved = [&](const std::string& text) {
    bool known = true;
    const std::string path = expanded(text, known);
    const fs::path place =
        fs::path(path).is_absolute() || !known ? fs::path(path) : file_.parent_path() / path;
    if ((!known || !fs::exists(place)) && target.skip.empty()) target.skip = shortPath(text);
    return place.string();
  };
  if (!target.sequence.empty()) target.sequence = resolved(target.sequence);
  for (StudyValues* values : {&target.simulate, &target.reconstruct, &target.evaluate})
    for (const char* key :
         {"scenario", "reference", "right", "calibration", "mask", "texture.picture"})
      if (values->count(key) > 0) (*values)[key] = resolved((*values)[key]);
  if (target.sequence.empty()) resolveOrgan(target);
}

/// `organ.otherwise` replaces a missing mesh, with a note in the table.
void StudyReader::resolveOrgan(StudyCase& target) const {
  const auto mesh = target.simulate.find("organ.mesh");
  const auto other = target.simulate.find("organ.otherwise");
  const std::string otherwise = other == target.simulate.end() ? "" : other->second;
  if (other != target.simulate.end()) target.simulate.erase(other);
  if (mesh == target.simulate.end() || mesh->second == "builtin") return;
  bool known = true;
  const std::string path = expanded(mesh->second, known);
  const fs::path place =
      fs::path(path).is_absolute() || !known ? fs::path(path) : file_.parent_path() / path;
  if (known && fs::exists(place)) {
    mesh->second = place.string();
  } else if (otherwise == "builtin") {
    target.notes.push_back("built-in organ, as " + shortPath(mesh->second));
    mesh->second = "builtin";
  } else {
    target.skip = shortPath(mesh->second);
  }
}

StudySweep StudyReader::sweepOf(const Json& table) const {
  StudySweep sweep;
  sweep.name = nameAt(table, "sweep");
  requireKnown(table, "sweep " + sweep.name,
               {"name", "label", "levels", "simulate", "reconstruct", "evaluate"});
  sweep.label = textAt(table, "label", sweep.name);
  if (!table.contains("levels") || !table["levels"].is_array() || table["levels"].empty())
    fail("sweep " + sweep.name + " needs levels, a list of numbers");
  for (const Json& level : table["levels"]) {
    if (!level.is_number()) fail("sweep " + sweep.name + ": levels must be numbers");
    if (!sweep.levels.empty() && level.get<double>() <= sweep.levels.back())
      fail("sweep " + sweep.name + ": levels must rise");
    sweep.levels.push_back(level);
  }
  return sweep;
}

void StudyReader::addSweeps(const StudyCase& base, std::vector<StudyCase>& cases) const {
  const auto sweeps = listAt("sweep");
  if (sweeps.empty()) cases.push_back(base);
  for (const Json& table : sweeps) {
    const StudySweep sweep = sweepOf(table);
    for (std::size_t i = 0; i < sweep.levels.size(); ++i) {
      StudyCase at_level = base;
      overlayLevel(at_level, table, i);
      at_level.sweep = sweep.name;
      at_level.level = sweep.levels[i];
      at_level.name +=
          (at_level.name.empty() ? "" : "-") + sweep.name + "-" + table["levels"][i].dump();
      cases.push_back(std::move(at_level));
    }
  }
}

StudyMetric StudyReader::metricOf(const Json& table, const std::string& at) const {
  StudyMetric metric;
  metric.path = textAt(table, "metric", "");
  if (metric.path.empty()) fail(at + " needs a metric, such as evaluation.tracks.mean_mm");
  metric.label = textAt(table, "label", metric.path);
  if (table.contains("decimals")) {
    if (!table["decimals"].is_number_integer() || table["decimals"] < 0 || table["decimals"] > 9)
      fail(at + ": decimals must be 0 to 9");
    metric.decimals = table["decimals"];
  }
  return metric;
}

void StudyReader::readColumns(Study& study) const {
  for (const Json& table : listAt("column")) {
    requireKnown(table, "column", {"metric", "label", "decimals"});
    study.columns.push_back(metricOf(table, "column"));
  }
  for (const Json& table : listAt("plot")) {
    StudyPlot plot;
    plot.name = nameAt(table, "plot");
    requireKnown(table, "plot " + plot.name, {"name", "metric", "label", "p95", "limit"});
    plot.metric = metricOf(table, "plot " + plot.name);
    plot.p95_path = textAt(table, "p95", "");
    if (table.contains("limit")) {
      if (!table["limit"].is_number()) fail("plot " + plot.name + ": limit must be a number");
      plot.limit = table["limit"];
    }
    study.plots.push_back(plot);
  }
}

Study StudyReader::read() const {
  requireKnown(tree_, "the study",
               {"title", "about", "sequence", "simulate", "reconstruct", "evaluate", "case",
                "variant", "sweep", "column", "plot"});
  Study study;
  study.file = file_;
  study.title = textAt(tree_, "title", file_.stem().string());
  study.about = textAt(tree_, "about", "");
  for (const Json& table : listAt("sweep")) study.sweeps.push_back(sweepOf(table));
  readColumns(study);
  std::vector<Json> bases = listAt("case"), variants = listAt("variant");
  const bool named_bases = !bases.empty(), named_variants = !variants.empty();
  if (!named_bases) bases.push_back(Json::object());
  if (!named_variants) variants.push_back(Json::object());
  const std::vector<std::string> known{"name",        "sequence", "simulate",
                                       "reconstruct", "evaluate", "beside"};
  for (const Json& base : bases)
    for (const Json& variant : variants) {
      StudyCase made;
      if (named_bases) made.base = nameAt(base, "case");
      if (named_variants) made.variant = nameAt(variant, "variant");
      requireKnown(base, "case " + made.base, known);
      requireKnown(variant, "variant " + made.variant, known);
      for (const Json* table : {&tree_, &base, &variant}) overlay(made, *table);
      made.name = made.base + (named_bases && named_variants ? "-" : "") + made.variant;
      addSweeps(made, study.cases);
    }
  std::set<std::string> names;
  for (StudyCase& made : study.cases) {
    if (made.name.empty()) made.name = "case";
    if (!names.insert(made.name).second) fail("two cases are called `" + made.name + "`");
    resolvePaths(made);
    if (made.skip.empty() && made.sequence.empty()) simulationText(made);
    reconstructionText(made);
    evaluationText(made);
  }
  return study;
}

}  // namespace

const StudyCase& Study::caseNamed(const std::string& name) const {
  std::vector<std::string> names;
  for (const StudyCase& one : cases) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  const std::string nearest = nearestName(name, names);
  throw OptionError(
      "`case=` `" + name + "`: " + shown(file) + " has no such case" +
      (nearest.empty() ? "; `list=` names them all" : " (did you mean `" + nearest + "`?)"));
}

Study readStudy(const fs::path& file) {
  const fs::path absolute = fs::absolute(file);
  Study study = StudyReader(absolute).read();
  study.file = file;
  return study;
}

}  // namespace softscope
