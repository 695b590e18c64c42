// apps/figure.cpp: `softscope figure`: axial, coronal, sagittal and 3-D in one picture.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "core/error.h"
#include "core/parallel.h"
#include "io/message.h"
#include "io/text_lines.h"
#include "toolkit/comparison/surface_fit.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/figures/figure_kinds.h"
#include "toolkit/figures/figure_matches.h"
#include "toolkit/figures/figure_options.h"
#include "toolkit/figures/figure_outputs.h"
#include "toolkit/figures/figure_run.h"
#include "toolkit/figures/scene_inputs.h"
#include "vtk_views/four_panels.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

const char* const kDetails =
    "Four panels: axial, coronal and sagittal slices with the contours of all surfaces, and the\n"
    "surfaces in 3-D, coloured by the test's distance to the reference where both are given.\n"
    "Points (a model of reconstruct) are dots near each plane, those of --scan in red. Without\n"
    "--ct contours lie on white. Views are radiological; letters come from the axes of the data.\n"
    "With a RUN and its sequence as --reference: the model beside the true surface, as the scope\n"
    "sees them at the last frame that has both, or at --frame.\n"
    "Of whole runs: --kind frames shows the model at some frames, --kind series its error maps\n"
    "over time with the series of all frames, --kind compare two runs side by side, --kind\n"
    "matches what dense SURF and SIFT find of the model in a new picture.\n"
    "Beside the figure lies a JSON file with inputs, hashes, views, range and counts. The same\n"
    "inputs give the same bytes. Research use only.";

class FigureCommand : public Command {
 public:
  std::string name() const override { return "figure"; }
  std::string summary() const override {
    return "axial, coronal, sagittal and 3-D views of CT, reference and model";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope figure --ct dicom --reference liver.ply --test run/model.ply --out four.png";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void validate() const;
  SurfaceFitOptions fitOptions() const;
  const SceneSurface& requireSurface(const Scene& scene) const;
  void validateKind() const;
  int runOfKind();
  int finish(const VectorDrawing& drawing, const SceneInputs& inputs, Json& record) const;
  void readFiles(SceneInputs& inputs) const;
  void fit(SceneInputs& inputs, FigureFoot& foot, Json& record) const;
  void addErrors(Scene& scene, FigureFoot& foot, Json& record) const;
  FourPanelOptions panelsFor(const Scene& scene) const;

  FigureOptions options_;
  std::string kind_ = "four", other_, frames_;
  std::vector<std::string> names_;
  std::string run_, ct_, reference_, test_, eye_, align_, align_landmarks_;
  std::vector<std::string> surfaces_, scans_;
  ErrorColourOptions errors_;
  int columns_ = 0, frame_ = -1;
  bool observed_ = false;
};

void FigureCommand::declare(ArgumentList& arguments) {
  arguments.positional("RUN", run_, "folder that reconstruct wrote, with its truth as --reference",
                       false);
  arguments.option("--ct", "VOLUME", ct_, "DICOM folder, NIfTI, NRRD or MetaImage");
  arguments.option("--reference", "MESH", reference_,
                   "surface of the CT (STL, PLY, OBJ, VTP); of a RUN the sequence with its truth");
  arguments.option("--test", "MODEL", test_, "surface or points to show with it");
  arguments.option("--surface", "MESH", surfaces_, "one more surface or model; repeatable");
  arguments.option("--scan", "POINTS", scans_, "points to draw in red; repeatable");
  arguments.option("--kind", "NAME", kind_,
                   "four (default), or of a RUN: frames, series, compare, matches");
  arguments.option("--other", "RUN", other_, "of --kind compare: the second run");
  arguments.option("--name", "TEXT", names_,
                   "of --kind compare: what the two runs are called; give it twice");
  arguments.option("--frames", "LIST", frames_,
                   "of the panels, e.g. 0,10,20 (default: up to four, evenly spread)");
  arguments.option("--frame", "N", frame_, "of a RUN (default: the last one that can be judged)");
  arguments.option("--align", "HOW", align_,
                   "the test to the reference: none (default), landmarks or icp, as compare does");
  arguments.option("--align-landmarks", "FILE", align_landmarks_,
                   "pairs of points, as compare's --landmarks; alone: --align landmarks");
  arguments.option("--errors", "KIND", errors_.kind,
                   "of the test from the reference: absolute (default), signed or none");
  arguments.flag("--observed", observed_,
                 "of a RUN: errors of the points seen now, grey for the others");
  arguments.option("--range-mm", "N", errors_.range_mm,
                   "end of the colour bar (default: a round number, not below the P95)");
  arguments.option("--eye", "X,Y,Z", eye_, "side that the 3-D panel is seen from");
  arguments.option("--columns", "N", columns_, "1, 2 or 4 panels in a row");
  softscope::declare(options_, arguments);
}

/// "0,10,20", rising whatever the order. Throws OptionError.
std::vector<int> parseFrames(const std::string& text) {
  std::vector<int> frames;
  for (const std::string_view word : wordsOf(text)) {
    const auto frame = numberOf(word);
    if (!frame || !(*frame >= 0 && *frame < 1e9) || *frame != std::floor(*frame))
      throw OptionError("--frames is `" + text + "`, but must be numbers of frames, e.g. 0,10,20");
    frames.push_back(static_cast<int>(*frame));
  }
  std::sort(frames.begin(), frames.end());
  if (const auto twice = std::adjacent_find(frames.begin(), frames.end()); twice != frames.end())
    throw OptionError(say("--frames names ", *twice, " twice; name each frame once"));
  return frames;
}

void FigureCommand::validate() const {
  options_.validate();
  errors_.validate();
  require(columns_ == 0 || columns_ == 1 || columns_ == 2 || columns_ == 4, "--columns", columns_,
          "must be 1, 2 or 4");
  require(frame_ >= -1, "--frame", frame_, "must be 0 or more");
  if (!eye_.empty() && parseVector(eye_, "--eye").norm() == 0)
    throw OptionError("--eye is `" + eye_ + "`, but must be a direction");
  validateKind();
  if (fitOptions().moves() && (!run_.empty() || test_.empty() || reference_.empty()))
    throw OptionError("--align moves --test to --reference; give both, and no RUN");
  if (kind_ != "four") return;
  if (run_.empty()) {
    require(frame_ < 0, "--frame", frame_, "needs a RUN");
    require(!observed_, "--observed", "given", "needs a RUN, whose scope sees a part");
    if (ct_.empty() && reference_.empty() && test_.empty() && surfaces_.empty() && scans_.empty())
      throw OptionError("there is nothing to show; give --ct, --reference, --test or a RUN");
    return;
  }
  if (reference_.empty())
    throw OptionError("a RUN needs --reference SEQUENCE, the sequence with its ground truth");
  if (!ct_.empty() || !test_.empty())
    throw OptionError(
        "a RUN excludes --ct and --test: it lies in its scope's frame. Give "
        "--test RUN/model.ply to show it on CT");
}

std::string legendOfFile(const std::string& path) {
  return shown(std::filesystem::path(path).filename());
}

void FigureCommand::readFiles(SceneInputs& inputs) const {
  if (!ct_.empty()) inputs.addVolume(ct_, options_.window, options_.volume.options());
  if (!reference_.empty())
    inputs.addSurface(reference_, "reference", "reference", surfaceColour(0));
  if (!test_.empty()) inputs.addSurface(test_, "test", "model", surfaceColour(1));
  std::size_t colour = 2;
  for (const std::string& path : surfaces_)
    inputs.addSurface(path, "surface", legendOfFile(path), surfaceColour(colour++));
  for (const std::string& path : scans_)
    inputs.addSurface(path, "scan", "scan", kScanRed).mesh.triangles.clear();
}

SurfaceFitOptions FigureCommand::fitOptions() const {
  return parseFit(align_, align_landmarks_, "--align-landmarks");
}

/// The test is moved; what --surface and --scan name stays.
void FigureCommand::fit(SceneInputs& inputs, FigureFoot& foot, Json& record) const {
  const SurfaceFitOptions options = fitOptions();
  if (!options.moves()) return;
  const SurfaceFit fit = fitSurface(requireSurface(inputs.scene()).mesh,
                                    inputs.scene().surfaces[1].mesh.vertices_mm, options);
  inputs.move(1, fit.reference_from_test, fit.method);
  for (const std::string& warning : fit.warnings) inputs.warn(warning);
  foot.notes.push_back("Alignment: " + fit.method + " (mean distance before it " +
                       fixed(fit.before_mm->mean, 2) + " mm).");
  record["alignment"] = surfaceFitJson(fit);
}

const SceneSurface& FigureCommand::requireSurface(const Scene& scene) const {
  if (scene.surfaces[0].isPoints())
    throw InputError(reference_ +
                     ": is a set of points, but a reference is a surface; give a mesh");
  return scene.surfaces[0];
}

void FigureCommand::addErrors(Scene& scene, FigureFoot& foot, Json& record) const {
  if (errors_.kind == "none" || reference_.empty() || test_.empty()) return;
  const SceneSurface& reference = requireSurface(scene);
  const SurfaceErrorMap map = colourErrors(
      TriangleTree(reference.mesh).closestPoints(scene.surfaces[1].mesh.vertices_mm), errors_);
  scene.surfaces[1].errors_mm = map.each_mm;
  map.explainIn(foot);
  record["errors"] = map.json;
  record["errors"]["alignment"] =
      record.contains("alignment") ? record["alignment"]["method"] : Json("none");
  for (std::size_t i = 2; i < scene.surfaces.size(); ++i) scene.surfaces[i].in_3d = false;
}

/// What --at model means: the test, or what a run reconstructed.
const SceneSurface* modelIn(const Scene& scene) {
  for (const SceneSurface& surface : scene.surfaces)
    if (surface.name == "model") return &surface;
  return nullptr;
}

FourPanelOptions FigureCommand::panelsFor(const Scene& scene) const {
  FourPanelOptions panels;
  panels.style = options_.figureStyle();
  panels.rule = options_.sideRule();
  panels.centre_mm = options_.centreIn(scene, modelIn(scene));
  panels.width_mm = options_.field_mm;
  panels.keep_centres = !options_.at.empty();
  panels.columns = columns_;
  if (scene.frame == SceneFrame::kCamera) panels.eye = {0.35, -0.4, -0.85};
  if (!eye_.empty()) panels.eye = parseVector(eye_, "--eye");
  return panels;
}

void FigureCommand::validateKind() const {
  const bool known = kind_ == "four" || kind_ == "frames" || kind_ == "series" ||
                     kind_ == "compare" || kind_ == "matches";
  require(known, "--kind", kind_, "must be four, frames, series, compare or matches");
  const std::size_t frames = parseFrames(frames_).size();
  require(frame_ < 0 || frames == 0, "--frame", frame_, "excludes --frames; give one");
  require((kind_ != "compare" && kind_ != "matches") || frames < 2, "--frames", "`" + frames_ + "`",
          "of --kind " + kind_ + " must be one frame");
  if (kind_ == "four") {
    require(frames_.empty(), "--frames", frames_, "needs --kind frames, series or compare");
    require(other_.empty(), "--other", other_, "needs --kind compare");
    require(names_.empty(), "--name", names_.empty() ? "" : names_[0], "needs --kind compare");
    return;
  }
  if (run_.empty()) throw OptionError("--kind " + kind_ + " needs a RUN");
  if (kind_ == "series" && reference_.empty())
    throw OptionError("--kind series needs --reference SEQUENCE, with its ground truth");
  if (kind_ == "matches" && reference_.empty())
    throw OptionError("--kind matches needs --reference SEQUENCE, with the run's pictures");
  require(names_.empty() || (kind_ == "compare" && names_.size() == 2), "--name",
          names_.empty() ? "" : names_[0], "belongs to --kind compare, which takes two");
  require((kind_ == "compare") == !other_.empty(), "--other", other_.empty() ? "missing" : other_,
          "belongs to --kind compare, which needs it");
  if (!ct_.empty() || !test_.empty() || !surfaces_.empty() || !scans_.empty())
    throw OptionError("--kind " + kind_ +
                      " shows runs alone; leave --ct, --test, --surface and "
                      "--scan out");
}

int FigureCommand::runOfKind() {
  SceneInputs inputs(1);
  RunFigureOptions options;
  options.kind = kind_;
  options.run = run_;
  options.other = other_;
  options.names = names_;
  options.sequence = reference_;
  options.frames = parseFrames(frames_);
  if (frame_ >= 0) options.frames = {frame_};
  options.observed_only = observed_;
  options.errors = errors_;
  if (options.errors.kind == "none") options.errors.kind = "absolute";
  if (!eye_.empty()) options.eye = parseVector(eye_, "--eye");
  options.panels.style = options_.figureStyle();
  options.panels.width_mm = options_.field_mm;
  options.panels.columns = columns_;
  RunFigure figure =
      kind_ == "matches" ? drawMatchFigure(options, inputs) : drawRunFigure(options, inputs);
  Json record = figureRecord("figure", options_);
  record["kind"] = kind_;
  record.update(figure.record);
  record["inputs"] = inputs.inputsJson();
  return finish(figure.drawing, inputs, record);
}

int FigureCommand::finish(const VectorDrawing& drawing, const SceneInputs& inputs,
                          Json& record) const {
  record["warnings"] = inputs.warnings();
  for (const std::string& warning : inputs.warnings()) spdlog::warn("{}", warning);
  record = options_.paths.applyTo(record);
  writeFigure(drawing, options_, record);
  if (common.json) printJson(record);
  return kDone;
}

int FigureCommand::run() {
  validate();
  if (kind_ != "four") return runOfKind();
  Json record = figureRecord("figure", options_);
  record["kind"] = kind_;
  SceneInputs inputs(options_.unit_mm);
  Scene& scene = inputs.scene();
  scene.dot_reach_mm = options_.dot_reach_mm;
  FigureFoot foot;
  if (run_.empty()) {
    readFiles(inputs);
    fit(inputs, foot, record);
    inputs.checkPlaces();
    addErrors(scene, foot, record);
  } else {
    record.update(addRunMoment({run_, reference_, frame_, observed_, errors_}, inputs, foot));
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
  return finish(drawing, inputs, record);
}

}  // namespace

std::unique_ptr<Command> makeFigureCommand() { return std::make_unique<FigureCommand>(); }

}  // namespace softscope
