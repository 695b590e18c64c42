// toolkit/figures/draw_figure.cpp: reading, alignment, colours and rendering.
#include "toolkit/figures/draw_figure.h"

#include <filesystem>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/distance/triangle_tree.h"
#include "io/text/message.h"
#include "toolkit/figures/figure_kinds.h"
#include "toolkit/figures/figure_matches.h"
#include "toolkit/figures/figure_outputs.h"
#include "toolkit/figures/figure_run.h"
#include "toolkit/figures/scene_inputs.h"
#include "vtk_views/scenes/four_panels.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

class FigureMaker {
 public:
  explicit FigureMaker(const FigureRequest& request) : request_(request) {}

  DrawnFigure draw() const;

 private:
  const SceneSurface& requireSurface(const Scene& scene) const;
  DrawnFigure ofRuns() const;
  DrawnFigure finish(VectorDrawing drawing, const SceneInputs& inputs, Json record) const;
  void readFiles(SceneInputs& inputs) const;
  void fit(SceneInputs& inputs, FigureFoot& foot, Json& record) const;
  void addErrors(Scene& scene, FigureFoot& foot, Json& record) const;
  FourPanelOptions panelsFor(const Scene& scene) const;

  const FigureRequest& request_;
};

std::string legendOfFile(const std::string& path) {
  return shown(std::filesystem::path(path).filename());
}

void FigureMaker::readFiles(SceneInputs& inputs) const {
  if (!request_.ct.empty())
    inputs.addVolume(request_.ct, request_.page.window, request_.page.volume.options());
  if (!request_.reference.empty())
    inputs.addSurface(request_.reference, "reference", "reference", surfaceColour(0));
  if (!request_.test.empty()) inputs.addSurface(request_.test, "test", "model", surfaceColour(1));
  std::size_t colour = 2;
  for (const std::string& path : request_.surfaces)
    inputs.addSurface(path, "surface", legendOfFile(path), surfaceColour(colour++));
  for (const std::string& path : request_.scans)
    inputs.addSurface(path, "scan", "scan", kScanRed).mesh.triangles.clear();
}

/// Moves the test surface; the files of --surface and --scan keep their position.
void FigureMaker::fit(SceneInputs& inputs, FigureFoot& foot, Json& record) const {
  if (!request_.fit.moves()) return;
  const SurfaceFit fit = fitSurface(requireSurface(inputs.scene()).mesh,
                                    inputs.scene().surfaces[1].mesh.vertices_mm, request_.fit);
  inputs.move(1, fit.reference_from_test, fit.method);
  for (const std::string& warning : fit.warnings) inputs.warn(warning);
  foot.notes.push_back("Alignment: " + fit.method + " (mean distance before it " +
                       fixed(fit.before_mm->mean, 2) + " mm).");
  record["alignment"] = surfaceFitJson(fit);
}

const SceneSurface& FigureMaker::requireSurface(const Scene& scene) const {
  if (scene.surfaces[0].isPoints())
    throw InputError(request_.reference +
                     ": is a set of points, but the reference must be a surface; give a mesh");
  return scene.surfaces[0];
}

void FigureMaker::addErrors(Scene& scene, FigureFoot& foot, Json& record) const {
  if (request_.errors.kind == "none" || request_.reference.empty() || request_.test.empty()) return;
  const SceneSurface& reference = requireSurface(scene);
  const SurfaceErrorMap map =
      colourErrors(TriangleTree(reference.mesh).closestPoints(scene.surfaces[1].mesh.vertices_mm),
                   request_.errors);
  scene.surfaces[1].errors_mm = map.each_mm;
  map.explainIn(foot);
  record["errors"] = map.json;
  record["errors"]["alignment"] =
      record.contains("alignment") ? record["alignment"]["method"] : Json("none");
  for (std::size_t i = 2; i < scene.surfaces.size(); ++i) scene.surfaces[i].in_3d = false;
}

/// Target of --at model: the test surface, or the model of a run.
const SceneSurface* modelIn(const Scene& scene) {
  for (const SceneSurface& surface : scene.surfaces)
    if (surface.name == "model") return &surface;
  return nullptr;
}

FourPanelOptions FigureMaker::panelsFor(const Scene& scene) const {
  FourPanelOptions panels;
  panels.style = request_.page.figureStyle();
  panels.rule = request_.page.sideRule();
  panels.centre_mm = request_.page.centreIn(scene, modelIn(scene));
  panels.width_mm = request_.page.field_mm;
  panels.keep_centres = !request_.page.at.empty();
  panels.columns = request_.columns;
  if (scene.frame == SceneFrame::kCamera) panels.eye = {0.35, -0.4, -0.85};
  if (request_.eye) panels.eye = *request_.eye;
  return panels;
}

DrawnFigure FigureMaker::ofRuns() const {
  SceneInputs inputs(1);
  RunFigureOptions options;
  options.kind = request_.kind;
  options.run = request_.run;
  options.other = request_.other;
  options.names = request_.names;
  options.sequence = request_.reference;
  options.frames = request_.frames;
  if (request_.frame >= 0) options.frames = {request_.frame};
  options.observed_only = request_.observed_only;
  options.errors = request_.errors;
  if (options.errors.kind == "none") options.errors.kind = "absolute";
  if (request_.eye) options.eye = *request_.eye;
  options.panels.style = request_.page.figureStyle();
  options.panels.width_mm = request_.page.field_mm;
  options.panels.columns = request_.columns;
  RunFigure figure = request_.kind == "matches" ? drawMatchFigure(options, inputs)
                                                : drawRunFigure(options, inputs);
  Json record = figureRecord("figure", request_.page);
  record["kind"] = request_.kind;
  record.update(figure.record);
  record["inputs"] = inputs.inputsJson();
  return finish(std::move(figure.drawing), inputs, std::move(record));
}

DrawnFigure FigureMaker::finish(VectorDrawing drawing, const SceneInputs& inputs,
                                Json record) const {
  record["warnings"] = inputs.warnings();
  return {std::move(drawing), request_.page.paths.applyTo(record), inputs.warnings()};
}

DrawnFigure FigureMaker::draw() const {
  if (request_.kind != "four") return ofRuns();
  Json record = figureRecord("figure", request_.page);
  record["kind"] = request_.kind;
  SceneInputs inputs(request_.page.unit_mm);
  Scene& scene = inputs.scene();
  scene.dot_reach_mm = request_.page.dot_reach_mm;
  FigureFoot foot;
  if (request_.run.empty()) {
    readFiles(inputs);
    fit(inputs, foot, record);
    inputs.checkPlaces();
    addErrors(scene, foot, record);
  } else {
    record.update(addRunMoment(
        {request_.run, request_.reference, request_.frame, request_.observed_only, request_.errors},
        inputs, foot));
  }
  FourPanelOptions panels = panelsFor(scene);
  panels.foot = foot;
  VectorDrawing drawing;
  parallelInvoke([&] { record["inputs"] = inputs.inputsJson(); },
                 [&] { drawing = drawFourPanels(scene, panels); });
  record["volume"] = inputs.volumeJson();
  record["surfaces"] = inputs.surfacesJson();
  const PanelField field = fourViews(scene, panels);
  for (const ViewPlane& view : field.planes)
    record["views"].push_back(viewJson(view, scene.frame, field.width_mm));
  return finish(std::move(drawing), inputs, std::move(record));
}

std::string listedFrames(const std::vector<int>& frames) {
  std::string text;
  for (const int frame : frames) text += (text.empty() ? "" : ",") + std::to_string(frame);
  return text;
}

void validateKind(const FigureRequest& r) {
  const bool known = r.kind == "four" || r.kind == "frames" || r.kind == "series" ||
                     r.kind == "compare" || r.kind == "matches";
  require(known, "`kind=`", r.kind, "must be four, frames, series, compare or matches");
  const std::size_t frames = r.frames.size();
  require(r.frame < 0 || frames == 0, "`frame=`", r.frame, "excludes `frames=`; give one");
  require((r.kind != "compare" && r.kind != "matches") || frames < 2, "`frames=`",
          "`" + listedFrames(r.frames) + "`", "of `kind=` " + r.kind + " must be one frame");
  if (r.kind == "four") {
    require(r.frames.empty(), "`frames=`", listedFrames(r.frames),
            "needs `kind=` frames, series or compare");
    require(r.other.empty(), "`other=`", r.other, "needs `kind=` compare");
    require(r.names.empty(), "`names=`", r.names.empty() ? "" : r.names[0],
            "needs `kind=` compare");
    return;
  }
  if (r.run.empty()) throw OptionError("`kind=` " + r.kind + " needs a RUN");
  if (r.kind == "series" && r.reference.empty())
    throw OptionError("`kind=` series needs `reference=` SEQUENCE, with its ground truth");
  if (r.kind == "matches" && r.reference.empty())
    throw OptionError("`kind=` matches needs `reference=` SEQUENCE, with the run's images");
  require(r.names.empty() || (r.kind == "compare" && r.names.size() == 2), "`names=`",
          r.names.empty() ? "" : r.names[0], "belongs to `kind=` compare, which takes two");
  require((r.kind == "compare") == !r.other.empty(), "`other=`",
          r.other.empty() ? "missing" : r.other, "belongs to `kind=` compare, which needs it");
  if (!r.ct.empty() || !r.test.empty() || !r.surfaces.empty() || !r.scans.empty())
    throw OptionError("`kind=` " + r.kind +
                      " shows runs only; omit `ct=`, `test=`, `surfaces=` and `scans=`");
}

}  // namespace

void FigureRequest::validate() const {
  page.validate();
  errors.validate();
  require(columns == 0 || columns == 1 || columns == 2 || columns == 4, "`columns=`", columns,
          "must be 1, 2 or 4");
  require(frame >= -1, "`frame=`", frame, "must be 0 or more");
  if (eye && eye->norm() == 0) throw OptionError("`eye=` is `0,0,0`, but must be a direction");
  validateKind(*this);
  if (fit.moves() && (!run.empty() || test.empty() || reference.empty()))
    throw OptionError("`align=` moves `test=` to `reference=`; give both, and no RUN");
  if (kind != "four") return;
  if (run.empty()) {
    require(frame < 0, "`frame=`", frame, "needs a RUN");
    require(!observed_only, "`observed_only=`", "given",
            "needs a RUN, whose camera determines the visible points");
    if (ct.empty() && reference.empty() && test.empty() && surfaces.empty() && scans.empty())
      throw OptionError("there is nothing to show; give `ct=`, `reference=`, `test=` or a RUN");
    return;
  }
  if (reference.empty())
    throw OptionError("a RUN needs `reference=` SEQUENCE, the sequence with its ground truth");
  if (!ct.empty() || !test.empty())
    throw OptionError(
        "a RUN excludes `ct=` and `test=`: it is in its camera frame. Give `test=` RUN/model.ply "
        "to show it on CT");
}

DrawnFigure drawFigure(const FigureRequest& request) {
  request.validate();
  return FigureMaker(request).draw();
}

}  // namespace softscope
