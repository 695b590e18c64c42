// apps/figure.cpp: `softscope figure`: axial, coronal, sagittal and 3-D in one picture.
#include <spdlog/spdlog.h>

#include <cmath>

#include "apps/command.h"
#include "apps/evaluate_json.h"
#include "apps/exit_codes.h"
#include "apps/figure_options.h"
#include "apps/figure_outputs.h"
#include "apps/result_output.h"
#include "apps/scene_inputs.h"
#include "core/error.h"
#include "core/parallel.h"
#include "eval/surface_errors.h"
#include "vtk_views/four_panels.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

const char* const kDetails =
    "Four panels: axial, coronal and sagittal slices with the contours of all surfaces, and the\n"
    "surfaces in 3-D, coloured by the test's distance to the reference where both are given. "
    "Points\n"
    "(a model of reconstruct) are drawn as dots near each plane, those of --scan in red. Without\n"
    "--ct contours lie on white. Views are radiological; letters come from the axes of the data.\n"
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
  void read(SceneInputs& inputs) const;
  void addErrors(Scene& scene, FourPanelOptions& panels, Json& record) const;

  FigureOptions options_;
  std::string ct_, reference_, test_, errors_ = "absolute", eye_;
  std::vector<std::string> surfaces_, scans_;
  double range_mm_ = 0;
  int columns_ = 0;
};

void FigureCommand::declare(ArgumentList& arguments) {
  arguments.option("--ct", "VOLUME", ct_, "DICOM folder, NIfTI, NRRD or MetaImage");
  arguments.option("--reference", "MESH", reference_, "surface of the CT (STL, PLY, OBJ)");
  arguments.option("--test", "MODEL", test_, "surface or points to show with it");
  arguments.option("--surface", "MESH", surfaces_, "one more surface or model; repeatable");
  arguments.option("--scan", "POINTS", scans_, "points to draw in red; repeatable");
  arguments.option("--errors", "KIND", errors_,
                   "of the test from the reference: absolute (default), signed or none");
  arguments.option("--range-mm", "N", range_mm_,
                   "end of the colour bar (default: a round number above the P95)");
  arguments.option("--eye", "X,Y,Z", eye_, "side that the 3-D panel is seen from");
  arguments.option("--columns", "N", columns_, "1, 2 or 4 panels in a row");
  options_.declare(arguments);
}

std::string legendOf(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void FigureCommand::read(SceneInputs& inputs) const {
  if (!ct_.empty()) inputs.addVolume(ct_, options_.window);
  std::size_t colour = 0;
  if (!reference_.empty())
    inputs.addSurface(reference_, "reference", "reference", surfaceColour(colour++));
  if (!test_.empty()) inputs.addSurface(test_, "test", "model", surfaceColour(1));
  colour = 2;
  for (const std::string& path : surfaces_)
    inputs.addSurface(path, "surface", legendOf(path), surfaceColour(colour++));
  for (const std::string& path : scans_) {
    SceneSurface& scan = inputs.addSurface(path, "scan", "scan", kScanRed);
    scan.mesh.triangles.clear();
  }
  inputs.scene().dot_reach_mm = options_.dot_reach_mm;
  inputs.checkPlaces();
}

/// 1, 2 or 5 times a power of ten, not below `value`.
double roundUp(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double leading : {1.0, 2.0, 5.0})
    if (value <= leading * power * (1 + 1e-9)) return leading * power;
  return 10 * power;
}

void FigureCommand::addErrors(Scene& scene, FourPanelOptions& panels, Json& record) const {
  if (errors_ == "none" || reference_.empty() || test_.empty()) return;
  const TriangleMesh& reference = scene.surfaces[0].mesh;
  if (reference.empty())
    throw InputError(reference_ +
                     ": is a set of points, but a reference is a surface; give a mesh");
  const auto closest = TriangleTree(reference).closestPoints(scene.surfaces[1].mesh.vertices_mm);
  const SurfaceErrors errors = surfaceErrors(closest);
  ErrorColours colours;
  colours.with_sign = errors_ == "signed";
  colours.limit_mm = range_mm_ > 0 ? range_mm_ : roundUp(errors.distance_mm.p95);
  for (const ClosestPoint& c : closest) {
    const double error_mm = colours.with_sign ? c.signed_distance_mm : c.distance_mm;
    scene.surfaces[1].errors_mm.push_back(error_mm);
    panels.bar.any_above |= error_mm > colours.limit_mm;
    panels.bar.any_below |= error_mm < colours.low_mm();
    panels.bar.any_missing |= std::isnan(error_mm);
  }
  if (colours.with_sign) panels.bar.label = "signed distance, outside positive [mm]";
  panels.colours = colours;
  record["errors"] = {{"kind", errors_},
                      {"range_mm", {colours.low_mm(), colours.limit_mm}},
                      {"alignment", "none"},
                      {"distance", statisticsJson(errors.distance_mm, "_mm")}};
}

int FigureCommand::run() {
  options_.validate();
  require(errors_ == "absolute" || errors_ == "signed" || errors_ == "none", "--errors", errors_,
          "must be absolute, signed or none");
  require(columns_ == 0 || columns_ == 1 || columns_ == 2 || columns_ == 4, "--columns", columns_,
          "must be 1, 2 or 4");
  require(range_mm_ >= 0 && std::isfinite(range_mm_), "--range-mm", range_mm_, "must be above 0");
  SceneInputs inputs(options_.unit_mm);
  read(inputs);
  Scene& scene = inputs.scene();
  if (scene.surfaces.empty() && !scene.volume)
    throw OptionError("there is nothing to show; give --ct, --reference or --test");
  FourPanelOptions panels;
  panels.style = options_.figureStyle();
  panels.rule = options_.sideRule();
  panels.centre_mm = options_.centre().value_or(sceneCentre(scene));
  panels.width_mm = options_.field_mm > 0 ? options_.field_mm : sceneWidthMm(scene);
  panels.columns = columns_;
  if (!eye_.empty()) panels.eye = parseVector(eye_, "--eye");
  Json record = figureRecord("figure", options_);
  addErrors(scene, panels, record);
  VectorDrawing drawing;
  parallelInvoke([&] { record["inputs"] = inputs.inputsJson(); },
                 [&] { drawing = drawFourPanels(scene, panels); });
  record["volume"] = inputs.volumeJson();
  record["surfaces"] = inputs.surfacesJson();
  for (const ViewPlane& view : {axialView(panels.centre_mm, scene.frame, panels.rule),
                                coronalView(panels.centre_mm, scene.frame, panels.rule),
                                sagittalView(panels.centre_mm, scene.frame),
                                cameraView(sceneCentre(scene), panels.eye, scene.frame)})
    record["views"].push_back(viewJson(view, scene.frame, panels.width_mm));
  record["warnings"] = inputs.warnings();
  for (const std::string& warning : inputs.warnings()) spdlog::warn("{}", warning);
  writeFigure(drawing, options_, record);
  if (common.json) printJson(record);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeFigureCommand() { return std::make_unique<FigureCommand>(); }

}  // namespace softscope
