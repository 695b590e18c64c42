// toolkit/figures/figure_kinds.cpp: one scene per panel, with common scale and colour range.
#include "toolkit/figures/figure_kinds.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <list>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "toolkit/evaluation/run_moment.h"
#include "toolkit/record/record_values.h"
#include "toolkit/record/statistics_json.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/model_surface.h"
#include "vtk_views/drawing/nice_ticks.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr std::size_t kPanels = 4;  // default number of panels
const Eigen::Vector3d kFromTheScope(0.25, -0.3, -0.9);

/// Up to kPanels frames, including the first and the last.
std::vector<int> spread(const std::vector<int>& frames) {
  if (frames.size() <= kPanels) return frames;
  std::vector<int> some;
  for (std::size_t i = 0; i < kPanels; ++i)
    some.push_back(frames[i * (frames.size() - 1) / (kPanels - 1)]);
  return some;
}

Scene sceneOf(TriangleMesh model) {
  Scene scene;
  scene.frame = SceneFrame::kCamera;
  scene.surfaces.push_back({"", std::move(model), surfaceColour(1), {}});
  scene.surfaces.back().in_focus = true;
  return scene;
}

TriangleMesh modelMesh(const std::filesystem::path& file) { return modelSurface(readModel(file)); }

Eigen::Vector3d eyeOf(const RunFigureOptions& options) {
  return options.eye.norm() > 0 ? options.eye : kFromTheScope;
}

/// Reason if the model at that frame is an older one.
std::string unfusedText(const JudgedRun& run, int frame) {
  const auto outcome = run.outcomes.each().find(frame);
  return run.counts(frame) ? "" : std::string(", ") + toString(outcome->second);
}

/// Frames to show; all must be in `there`.
std::vector<int> framesFor(const RunFigureOptions& options, const std::vector<int>& there) {
  for (const int frame : options.frames)
    if (!std::binary_search(there.begin(), there.end(), frame))
      throw OptionError(say("`frames=` names ", frame, ", but ", options.run,
                            " has no model to show there; its last one is of frame ",
                            there.back()));
  return options.frames.empty() ? spread(there) : options.frames;
}

std::vector<int> keysOf(const FrameFiles& files) {
  std::vector<int> keys;
  for (const auto& [frame, file] : files) keys.push_back(frame);
  return keys;
}

RunFigure drawFrames(const RunFigureOptions& options, SceneInputs& inputs) {
  const JudgedRun run = openJudgedRun(options.run);
  std::vector<int> there = keysOf(run.countedModels());
  if (there.empty() || !options.frames.empty()) there = keysOf(run.models);
  if (there.empty())
    throw InputError(options.run +
                     ": has no models of single frames; reconstruct with `save_every=` N");
  std::list<Scene> scenes;
  std::vector<ScenePanel> panels;
  const std::vector<int> frames = framesFor(options, there);
  for (const int frame : frames) {
    inputs.note("model", run.models.at(frame).string());
    scenes.push_back(sceneOf(modelMesh(run.models.at(frame))));
  }
  const Eigen::Vector3d centre_mm = sceneCentre(scenes.back());  // common for all panels
  auto scene = scenes.begin();
  for (const int frame : frames)
    panels.push_back({&*scene++, cameraView(centre_mm, eyeOf(options), SceneFrame::kCamera),
                      momentText(frame, run.timeOf(frame)) + unfusedText(run, frame)});
  return {drawScenes(panels, options.panels), {{"run", options.run}, {"frames", frames}}};
}

/// Truth in grey, model coloured by its errors.
Scene errorScene(const RunMoment& moment, const SurfaceErrorMap& map) {
  Scene scene = sceneOf(moment.model);
  scene.surfaces[0].errors_mm = map.each_mm;
  scene.surfaces.insert(scene.surfaces.begin(), {"", moment.truth, {175, 175, 175}, {}});
  return scene;
}

ScenePanel panelOf(const Scene& scene, const Eigen::Vector3d& eye, std::string caption) {
  return {&scene, cameraView(sceneCentre(scene), eye, scene.frame), std::move(caption)};
}

/// Common range for all panels.
ErrorColourOptions sharedRange(const RunFigureOptions& options,
                               const std::vector<const RunMoment*>& moments) {
  ErrorColourOptions errors = options.errors;
  std::vector<double> all_mm;
  for (const RunMoment* moment : moments) {
    const std::vector<double> each_mm = moment->distances(options.observed_only);
    all_mm.insert(all_mm.end(), each_mm.begin(), each_mm.end());
  }
  if (errors.range_mm == 0) errors.range_mm = roundUp(statistics(all_mm).p95);
  return errors;
}

/// Adds the bar of the map to a foot that contains other bars of the same range.
void addColourBar(const SurfaceErrorMap& map, FigureFoot& foot) {
  ColourBarText bar = map.bar;
  bar.any_above |= foot.bar.any_above;
  bar.any_below |= foot.bar.any_below;
  bar.any_missing |= foot.bar.any_missing;
  map.explainIn(foot);
  foot.bar = bar;
}

SurfaceErrorMap mapOf(const RunMoment& moment, bool observed_only,
                      const ErrorColourOptions& errors) {
  return colourErrors(moment.distances(observed_only), moment.signedDistances(observed_only),
                      errors);
}

void noteMoment(const RunMoment& moment, SceneInputs& inputs) {
  inputs.note("model", moment.model_file.string());
  inputs.note("reference", moment.truth_file.string());
}

RunFigure drawSeries(const RunFigureOptions& options, SceneInputs& inputs) {
  const JudgedPair pair(options.run, options.sequence);
  for (const std::string& warning : pair.warnings) inputs.warn(warning);
  const std::vector<int> shown_frames = framesFor(options, pair.frames());
  ErrorSeriesData series;
  std::list<RunMoment> moments;
  for (const int frame : pair.frames()) {
    const bool is_shown =
        std::find(shown_frames.begin(), shown_frames.end(), frame) != shown_frames.end();
    RunMoment moment = pair.moment(frame, is_shown);
    noteMoment(moment, inputs);
    const Statistics errors = statistics(moment.distances(options.observed_only));
    series.times.push_back(std::isfinite(moment.time_s) ? moment.time_s : frame);
    if (!std::isfinite(moment.time_s)) series.time_label = "frame";
    series.mean.push_back(errors.mean);
    series.median.push_back(errors.median);
    series.p95.push_back(errors.p95);
    if (is_shown) moments.push_back(std::move(moment));
  }
  std::vector<const RunMoment*> each;
  for (const RunMoment& moment : moments) each.push_back(&moment);
  const ErrorColourOptions errors = sharedRange(options, each);
  RunFigure figure;
  figure.record = {{"run", options.run}, {"sequence", options.sequence}, {"frames", shown_frames}};
  std::list<Scene> scenes;
  std::vector<ScenePanel> panels;
  FigureFoot foot;
  for (const RunMoment& moment : moments) {
    const SurfaceErrorMap map = mapOf(moment, options.observed_only, errors);
    addColourBar(map, foot);
    scenes.push_back(errorScene(moment, map));
    panels.push_back(
        panelOf(scenes.back(), eyeOf(options), momentText(moment.frame, moment.time_s)));
    figure.record["errors"].push_back(map.json);
  }
  PanelOptions sheet = options.panels;
  sheet.foot = foot;
  figure.drawing = drawScenes(panels, sheet);
  const PlotStyle plot{sheet.style.width_mm, 0.35 * std::max(sheet.style.width_mm, 120.0),
                       sheet.style.font_pt};
  series.title = std::string("(") + char('a' + panels.size()) + ") all evaluated frames";
  if (series.times.size() > 1)
    appendBelow(drawErrorSeries(series, plot), sheet.style.font_pt, figure.drawing);
  return figure;
}

/// "results/paper/run" and "results/default/run": "paper" and "default".
std::pair<std::string, std::string> namesOf(const RunFigureOptions& options) {
  namespace fs = std::filesystem;
  if (options.names.size() == 2) return {options.names[0], options.names[1]};
  const auto whole = [](const std::string& folder) {
    const fs::path path = fs::absolute(folder).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
  };
  const fs::path first = whole(options.run), second = whole(options.other);
  fs::path a = first, b = second;
  while (a.filename() == b.filename() && a.has_relative_path() && b.has_relative_path()) {
    a = a.parent_path();
    b = b.parent_path();
  }
  const bool same = a.filename().empty() || b.filename().empty();
  return same ? std::pair{shown(first.filename()), shown(second.filename())}
              : std::pair{shown(a.filename()), shown(b.filename())};
}

/// Default: the last frame of both runs.
int frameOfBoth(const RunFigureOptions& options, const std::vector<int>& first,
                const std::vector<int>& second) {
  std::vector<int> both;
  std::set_intersection(first.begin(), first.end(), second.begin(), second.end(),
                        std::back_inserter(both));
  if (both.empty())
    throw InputError(options.run + " and " + options.other +
                     ": have no frame in common; reconstruct with `save_every=` 1");
  if (options.frames.empty()) return both.back();
  const int frame = options.frames[0];
  if (!std::binary_search(both.begin(), both.end(), frame))
    throw OptionError(say("`frame=` is ", frame, ", but the last one that both runs have is ",
                          both.back(), "; reconstruct with `save_every=` 1 for all"));
  return frame;
}

/// By frame; the last model if none was saved.
FrameFiles allModels(const JudgedRun& run) {
  FrameFiles models = run.models;
  if (!run.last_model.empty() && !run.frames.empty())
    models.emplace(run.lastCounted(), run.last_model);
  return models;
}

/// Hash of the left images from run.json; empty if absent.
std::string clipOf(const std::string& run) {
  const std::filesystem::path file = std::filesystem::path(run) / "run.json";
  if (!isFile(file)) return {};
  return textAt(Json::parse(readBytes(file, kTextLimitBytes), nullptr, false),
                "inputs.left.sha256");
}

enum class Clips { kUnknown, kOne, kTwo };

Clips clipsOf(const RunFigureOptions& options) {
  const std::string first = clipOf(options.run), second = clipOf(options.other);
  if (first.empty() || second.empty()) return Clips::kUnknown;
  return first == second ? Clips::kOne : Clips::kTwo;
}

std::string twoRunsText(Clips clips, const std::string& moment) {
  if (clips == Clips::kTwo)
    return "Two reconstructions of two clips, each at " + moment + " of its own; common scale.";
  return std::string("Two reconstructions") + (clips == Clips::kOne ? " of one clip" : "") +
         ", each at " + moment + "; common viewpoint and scale.";
}

RunFigure compareWithTruth(const RunFigureOptions& options, SceneInputs& inputs) {
  const JudgedPair first(options.run, options.sequence), second(options.other, options.sequence);
  const int frame = frameOfBoth(options, first.frames(), second.frames());
  const RunMoment a = first.moment(frame, true), b = second.moment(frame, true);
  const ErrorColourOptions errors = sharedRange(options, {&a, &b});
  RunFigure figure;
  figure.record = {
      {"runs", {options.run, options.other}}, {"sequence", options.sequence}, {"frame", frame}};
  std::list<Scene> scenes;
  std::vector<ScenePanel> coloured, mapped;
  FigureFoot foot;
  const auto names = namesOf(options);
  for (const auto& [moment, name] : {std::pair{&a, names.first}, {&b, names.second}}) {
    noteMoment(*moment, inputs);
    const SurfaceErrorMap map = mapOf(*moment, options.observed_only, errors);
    addColourBar(map, foot);
    figure.record["errors"].push_back(map.json);
    scenes.push_back(sceneOf(moment->model));
    coloured.push_back(panelOf(scenes.back(), eyeOf(options), name));
    scenes.push_back(errorScene(*moment, map));
    mapped.push_back(panelOf(scenes.back(), eyeOf(options), name + ", errors"));
  }
  coloured.insert(coloured.end(), mapped.begin(), mapped.end());
  PanelOptions sheet = options.panels;
  sheet.foot = foot;
  sheet.foot.notes = {twoRunsText(clipsOf(options), momentText(frame, a.time_s))};
  figure.drawing = drawScenes(coloured, sheet);
  return figure;
}

RunFigure compareColoured(const RunFigureOptions& options, SceneInputs& inputs) {
  const auto names = namesOf(options);
  const FrameFiles first = allModels(openJudgedRun(options.run));
  const FrameFiles second = allModels(openJudgedRun(options.other));
  const int frame = frameOfBoth(options, keysOf(first), keysOf(second));
  const Clips clips = clipsOf(options);
  std::list<Scene> scenes;
  std::vector<ScenePanel> panels;
  for (const auto& [models, name] : {std::pair{&first, names.first}, {&second, names.second}}) {
    const std::filesystem::path file = models->at(frame);
    inputs.note("model", file.string());
    scenes.push_back(sceneOf(modelMesh(file)));
    panels.push_back(panelOf(scenes.back(), eyeOf(options), name));
    if (clips == Clips::kTwo) panels.back().world = static_cast<int>(panels.size());
  }
  PanelOptions sheet = options.panels;
  sheet.foot.notes = {
      twoRunsText(clips, momentText(frame, openJudgedRun(options.run).timeOf(frame)))};
  return {drawScenes(panels, sheet), {{"runs", {options.run, options.other}}, {"frame", frame}}};
}

}  // namespace

RunFigure drawRunFigure(const RunFigureOptions& options, SceneInputs& inputs) {
  if (options.kind == "frames") return drawFrames(options, inputs);
  if (options.kind == "series") return drawSeries(options, inputs);
  return options.sequence.empty() ? compareColoured(options, inputs)
                                  : compareWithTruth(options, inputs);
}

}  // namespace softscope
