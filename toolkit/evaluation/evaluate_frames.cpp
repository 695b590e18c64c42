// toolkit/evaluation/evaluate_frames.cpp: results
// of model, pose and track, joined by frame.
#include "toolkit/evaluation/evaluate_frames.h"

#include <cmath>
#include <functional>
#include <map>

#include "toolkit/record/metric_lists.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

constexpr double kNone = Statistics::kNone;
constexpr std::size_t kOutcomeAt = 2;  // after frame and time_s

/// Results of one frame; null or NaN if unknown.
struct FrameFacts {
  int frame = 0;
  double time_s = kNone;
  const ModelErrors* model = nullptr;
  const ViewErrors* view = nullptr;
  double second_difference_mm = kNone;
  double pose_mm = kNone, pose_deg = kNone, ate_mm = kNone, ate_deg = kNone;
  double rpe_mm = kNone, rpe_deg = kNone, backprojection_mm = kNone;
  double confidence = kNone, jump_mm = kNone, wrong = kNone;
  Statistics track_mm, control_mm;
};

struct Column {
  std::string heading;
  std::function<double(const FrameFacts&)> value;
};

Column ofModel(std::string heading, std::function<double(const ModelErrors&)> value) {
  return {std::move(heading), [value = std::move(value)](const FrameFacts& facts) {
            return facts.model == nullptr ? kNone : value(*facts.model);
          }};
}

std::vector<Column> surfaceColumns() {
  using E = const ModelErrors&;
  std::vector<Column> columns{
      ofModel("points", [](E e) { return static_cast<double>(e.distance_mm.count); })};
  for (const Metric<Statistics>& m : statisticsMetrics())
    columns.push_back(
        ofModel(m.key + std::string("_mm"), [m](E e) { return m.of(e.distance_mm); }));
  columns.push_back(ofModel("signed_mean_mm", [](E e) { return e.signed_mm.mean; }));
  columns.push_back(ofModel("signed_median_mm", [](E e) { return e.signed_mm.median; }));
  columns.push_back(
      ofModel("border_points", [](E e) { return static_cast<double>(e.border_count); }));
  columns.push_back(
      ofModel("beyond_border_points", [](E e) { return static_cast<double>(e.beyond_count); }));
  return columns;
}

std::vector<Column> viewColumns() {
  using E = const ModelErrors&;
  std::vector<Column> columns{
      ofModel("observed_share", [](E e) { return e.observed_share; }),
      ofModel("observed_mean_mm", [](E e) { return e.observed_mm.mean; }),
      ofModel("observed_median_mm", [](E e) { return e.observed_mm.median; }),
      ofModel("observed_p95_mm", [](E e) { return e.observed_mm.p95; }),
      ofModel("predicted_mean_mm", [](E e) { return e.predicted_mm.mean; }),
      ofModel("predicted_median_mm", [](E e) { return e.predicted_mm.median; }),
      ofModel("predicted_p95_mm", [](E e) { return e.predicted_mm.p95; })};
  for (const Metric<ModelErrors>& m : completenessMetrics())
    columns.push_back(ofModel(m.key, m.of));
  columns.push_back(
      ofModel("tissue_to_model_mean_mm", [](E e) { return e.both.distance_mm.mean; }));
  columns.push_back(ofModel("tissue_to_model_p95_mm", [](E e) { return e.both.distance_mm.p95; }));
  return columns;
}

Column ofView(std::string heading, std::function<double(const ViewErrors&)> value) {
  return {std::move(heading), [value = std::move(value)](const FrameFacts& facts) {
            return facts.view == nullptr ? kNone : value(*facts.view);
          }};
}

std::vector<Column> drawnColumns() {
  using V = const ViewErrors&;
  std::vector<Column> columns;
  for (const Metric<DepthErrors>& m : drawnDepthMetrics())
    columns.push_back(ofView("depth_" + std::string(m.key), [m](V v) { return m.of(v.depth); }));
  for (const Metric<PictureErrors>& m : drawnViewMetrics())
    columns.push_back(ofView("view_" + std::string(m.key), [m](V v) { return m.of(v.picture); }));
  columns.push_back(
      {"backprojection_mean_mm", [](const FrameFacts& f) { return f.backprojection_mm; }});
  return columns;
}

std::vector<Column> hausdorffColumns() {
  using E = const ModelErrors&;
  std::vector<Column> columns;
  for (const Metric<HausdorffDistances>& m : hausdorffMetrics())
    columns.push_back(ofModel(m.key, [m](E e) { return m.of(e.hausdorff); }));
  columns.push_back(
      {"second_difference_mm", [](const FrameFacts& f) { return f.second_difference_mm; }});
  return columns;
}

std::vector<Column> cameraAndTrackColumns() {
  using F = const FrameFacts&;
  return {{"pose_error_mm", [](F f) { return f.pose_mm; }},
          {"pose_error_deg", [](F f) { return f.pose_deg; }},
          {"ate_mm", [](F f) { return f.ate_mm; }},
          {"ate_deg", [](F f) { return f.ate_deg; }},
          {"rpe_mm", [](F f) { return f.rpe_mm; }},
          {"rpe_deg", [](F f) { return f.rpe_deg; }},
          {"track_count", [](F f) { return static_cast<double>(f.track_mm.count); }},
          {"track_mean_mm", [](F f) { return f.track_mm.mean; }},
          {"track_median_mm", [](F f) { return f.track_mm.median; }},
          {"track_p95_mm", [](F f) { return f.track_mm.p95; }},
          {"no_motion_mean_mm", [](F f) { return f.control_mm.mean; }},
          {"largest_jump_mm", [](F f) { return f.jump_mm; }},
          {"confidence", [](F f) { return f.confidence; }},
          {"wrong", [](F f) { return f.wrong; }}};
}

std::vector<Column> columnsFor(const EvaluationResult& result) {
  std::vector<Column> columns{
      {"frame", [](const FrameFacts& f) { return static_cast<double>(f.frame); }},
      {"time_s", [](const FrameFacts& f) { return f.time_s; }}};
  const auto append = [&](const std::vector<Column>& more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  append(surfaceColumns());
  if (!result.against_mesh) append(viewColumns());
  append(hausdorffColumns());
  if (result.against_mesh) return columns;
  append(drawnColumns());
  append(cameraAndTrackColumns());
  return columns;
}

using FactsByFrame = std::map<int, FrameFacts>;

void addCamera(const CameraResult& camera, FactsByFrame& facts) {
  for (std::size_t k = 0; k < camera.frames.size(); ++k) {
    FrameFacts& frame = facts[camera.frames[k]];
    frame.pose_mm = camera.errors.unaligned.each_mm[k];
    frame.pose_deg = camera.errors.unaligned.each_deg[k];
    frame.ate_mm = camera.errors.absolute.each_mm[k];
    frame.ate_deg = camera.errors.absolute.each_deg[k];
    if (k == 0) continue;  // a step belongs to its second frame
    frame.rpe_mm = camera.errors.relative.each_mm[k - 1];
    frame.rpe_deg = camera.errors.relative.each_deg[k - 1];
  }
}

void addTracks(const TrackErrors& tracks, FactsByFrame& facts) {
  std::map<int, std::pair<std::vector<double>, std::vector<double>>> by_frame;
  for (const TrackError& e : tracks.each) {
    by_frame[e.frame].first.push_back(e.errorMm());
    by_frame[e.frame].second.push_back(e.control_mm);
  }
  for (const auto& [frame, values] : by_frame) {
    facts[frame].track_mm = statistics(values.first);
    facts[frame].control_mm = statistics(values.second);
  }
}

FactsByFrame gather(const EvaluationResult& result) {
  FactsByFrame facts;
  if (!result.against_mesh)
    for (const auto& [number, time_s] : result.times_s) facts[number].time_s = time_s;
  const SurfaceSeries& surface = result.surface;
  for (std::size_t i = 0; i < surface.models.size(); ++i) {
    FrameFacts& frame = facts[surface.models[i].frame];
    frame.time_s = surface.models[i].time_s;
    frame.model = &surface.models[i].errors;
    if (surface.models[i].view) frame.view = &*surface.models[i].view;
    if (i < surface.second_differences_mm.size())
      frame.second_difference_mm = surface.second_differences_mm[i];
  }
  if (result.camera) addCamera(*result.camera, facts);
  if (result.tracks) addTracks(*result.tracks, facts);
  for (const auto& [frame, mean_mm] : result.backprojection_mm)
    facts[frame].backprojection_mm = mean_mm;
  for (const JudgedFrame& judged : result.judged_frames) {
    facts[judged.frame].confidence = judged.confidence;
    facts[judged.frame].jump_mm = judged.jump_mm;
    facts[judged.frame].wrong = isWrong(judged);
  }
  for (auto& [number, frame] : facts) frame.frame = number;
  return facts;
}

}  // namespace

FrameTable frameTable(const EvaluationResult& result) {
  const std::vector<Column> columns = columnsFor(result);
  FrameTable table;
  for (const Column& column : columns) table.headings.emplace_back(column.heading);
  for (const auto& [number, facts] : gather(result)) {
    table.rows.emplace_back();
    for (const Column& column : columns) table.rows.back().push_back(column.value(facts));
    const auto outcome = result.outcomes.each().find(number);
    table.outcomes.emplace_back(
        outcome == result.outcomes.each().end() ? "" : toString(outcome->second));
  }
  return table;
}

std::string FrameTable::csv() const {
  std::string text;
  for (std::size_t i = 0; i < headings.size(); ++i)
    text += (i > 0 ? "," : "") + headings[i] + (i + 1 == kOutcomeAt ? ",outcome" : "");
  text += "\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < rows[r].size(); ++i)
      text += (i > 0 ? "," : "") + csvCell(rows[r][i]) +
              (i + 1 == kOutcomeAt ? "," + outcomes[r] : std::string());
    text += "\n";
  }
  return text;
}

FactSheet::Json FrameTable::json() const {
  FactSheet::Json frames = FactSheet::Json::array();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto& row = rows[r];
    FactSheet::Json frame = FactSheet::Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == kOutcomeAt && !outcomes[r].empty()) frame["outcome"] = outcomes[r];
      if (row[i] == std::floor(row[i]) && std::abs(row[i]) < 1e15)
        frame[headings[i]] = static_cast<long long>(row[i]);
      else
        frame[headings[i]] = row[i];
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::string tracksCsv(const TrackErrors& tracks) {
  std::string text = "frame,id,error_mm,no_motion_mm,visible,sigma_mm\n";
  for (const TrackError& e : tracks.each)
    text += std::to_string(e.frame) + "," + std::to_string(e.id) + "," + csvCell(e.errorMm()) +
            "," + csvCell(e.control_mm) + "," + (e.visible ? "1," : "0,") + csvCell(e.sigma_mm) +
            "\n";
  return text;
}

}  // namespace softscope
