// toolkit/evaluation/thresholds.cpp: parsing, search of metrics, comparison.
#include "toolkit/evaluation/thresholds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/nearest_name.h"
#include "io/text/text_lines.h"
#include "toolkit/record/record_values.h"

namespace softscope {
namespace {

using Metrics = std::vector<std::pair<std::string, double>>;

constexpr const char* kTau = "tau_mm";

void collect(const FactSheet::Json& json, const std::string& path, Metrics& metrics);

/// Scores within a distance have a path by it: "scores.0.5mm.recall". Other lists have none.
void collectScores(const FactSheet::Json& list, const std::string& path, Metrics& metrics) {
  for (FactSheet::Json scores : list) {
    const double tau_mm = numberAt(scores, kTau);
    if (!std::isfinite(tau_mm)) continue;
    scores.erase(kTau);
    collect(scores, path + "." + exactText(tau_mm) + "mm", metrics);
  }
}

void collect(const FactSheet::Json& json, const std::string& path, Metrics& metrics) {
  for (const auto& [key, value] : json.items()) {
    const std::string here = path.empty() ? key : path + "." + key;
    if (value.is_object())
      collect(value, here, metrics);
    else if (value.is_array())
      collectScores(value, here, metrics);
    else if (value.is_number())
      metrics.emplace_back(here, value.get<double>());
    else if (value.is_null())
      metrics.emplace_back(here, std::numeric_limits<double>::quiet_NaN());
  }
}

bool endsWithPart(const std::string& path, const std::string& part) {
  return path.size() > part.size() &&
         path.compare(path.size() - part.size(), part.size(), part) == 0 &&
         path[path.size() - part.size() - 1] == '.';
}

[[noreturn]] void failUnknown(const std::string& name, const Metrics& metrics) {
  std::vector<std::string> names;
  for (const auto& [path, value] : metrics) names.push_back(path);
  const std::string nearest = nearestName(name, names);
  throw OptionError(
      "`fail_if=`: `" + name + "` is no metric of this evaluation" +
      (nearest.empty() ? "; `json=` shows what there is" : " (did you mean `" + nearest + "`?)"));
}

const std::pair<std::string, double>& find(const std::string& name, const Metrics& metrics,
                                           const std::string& preferred) {
  for (const std::string& path : {name, preferred + "." + name})
    for (const auto& metric : metrics)
      if (metric.first == path) return metric;
  const auto matches = [&](const auto& metric) { return endsWithPart(metric.first, name); };
  const auto first = std::find_if(metrics.begin(), metrics.end(), matches);
  if (first == metrics.end()) failUnknown(name, metrics);
  const auto second = std::find_if(first + 1, metrics.end(), matches);
  if (second != metrics.end())
    throw OptionError("`fail_if=`: `" + name + "` may be " + first->first + " or " + second->first +
                      "; write it in full");
  return *first;
}

}  // namespace

std::string Threshold::text() const {
  return metric + relation + exactText(percent ? 100 * limit : limit) + (percent ? "%" : "");
}

std::string Threshold::name() const {
  const std::string end = "_share";
  const bool is_share = metric.size() > end.size() &&
                        metric.compare(metric.size() - end.size(), end.size(), end) == 0;
  return percent && !is_share ? metric + end : metric;
}

bool Threshold::fails(double value) const {
  if (std::isnan(value)) return true;
  if (relation == ">") return value > limit;
  if (relation == ">=") return value >= limit;
  if (relation == "<") return value < limit;
  return value <= limit;
}

Threshold parseThreshold(const std::string& text) {
  const std::size_t begin = text.find_first_of("<>");
  const std::size_t end = begin == std::string::npos ? begin : text.find_first_not_of("<>=", begin);
  if (end != std::string::npos) {
    std::string_view number = trimmed(std::string_view(text).substr(end));
    Threshold threshold{std::string(trimmed(text.substr(0, begin))),
                        text.substr(begin, end - begin), 0,
                        /*percent=*/!number.empty() && number.back() == '%'};
    if (threshold.percent) number = trimmed(number.substr(0, number.size() - 1));
    threshold.limit = numberOf(number).value_or(std::numeric_limits<double>::quiet_NaN());
    if (threshold.percent) threshold.limit /= 100;
    const auto& relation = threshold.relation;
    const bool named = threshold.metric.find('=') == std::string::npos && !threshold.metric.empty();
    const bool known = relation == ">" || relation == ">=" || relation == "<" || relation == "<=";
    if (known && named && std::isfinite(threshold.limit)) return threshold;
  }
  throw OptionError(
      "`fail_if=` is `" + text +
      "`, but must be a metric, one of > >= < <=, and a number, or for a share per cent: "
      "p95_mm>2, lost>10%");
}

Metrics metricsOf(const FactSheet::Json& result) {
  Metrics metrics;
  collect(result, "", metrics);
  return metrics;
}

std::vector<ThresholdOutcome> checkThresholds(const std::vector<Threshold>& thresholds,
                                              const FactSheet::Json& result,
                                              const std::string& preferred) {
  const Metrics metrics = metricsOf(result);
  std::vector<ThresholdOutcome> outcomes;
  for (const Threshold& threshold : thresholds) {
    const auto& [path, value] = find(threshold.name(), metrics, preferred);
    outcomes.push_back({threshold, path, value, threshold.fails(value)});
  }
  return outcomes;
}

FactSheet::Json thresholdsJson(const std::vector<ThresholdOutcome>& outcomes) {
  FactSheet::Json list = FactSheet::Json::array();
  for (const ThresholdOutcome& outcome : outcomes)
    list.push_back({{"fail_if", outcome.threshold.text()},
                    {"metric", outcome.path},
                    {"value", outcome.value},
                    {"failed", outcome.failed}});
  return list;
}

}  // namespace softscope
