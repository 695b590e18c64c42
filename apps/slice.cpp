// apps/slice.cpp: `softscope slice`: planes through a CT with contours of surfaces and models.
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "core/error.h"
#include "core/parallel.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/figures/figure_options.h"
#include "toolkit/figures/figure_outputs.h"
#include "toolkit/figures/scene_inputs.h"
#include "vtk_views/scenes/four_panels.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr std::size_t kMostSlices = 100;

const char* const kDetails =
    "Each --plane gives a panel: axial, coronal, sagittal, or oblique by its --normal. With\n"
    "--positions one plane gives a panel at each place along its axis (LPS, mm; an oblique one:\n"
    "along its normal from --at), so a stack of slices is one figure. Surfaces are contours,\n"
    "points within --dots-within-mm of a plane are dots, those of --scan red.\n"
    "Beside the figure lies a JSON file with inputs, hashes and views.";

class SliceCommand : public Command {
 public:
  std::string name() const override { return "slice"; }
  std::string summary() const override {
    return "axial, coronal, sagittal and oblique slices of a CT with contours of models";
  }
  std::string details() const override { return kDetails; }
  std::string example() const override {
    return "softscope slice ct.nii.gz --surface liver.ply --plane axial --out liver.png";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  void read(SceneInputs& inputs) const;
  ViewPlane planeNamed(const std::string& name, const Eigen::Vector3d& centre_mm) const;
  std::vector<ViewPlane> planesThrough(const Scene& scene) const;

  FigureOptions options_;
  std::string ct_, reference_, normal_, positions_;
  std::vector<std::string> surfaces_, scans_, planes_;
  int columns_ = 0;
};

void SliceCommand::declare(ArgumentList& arguments) {
  arguments.positional("VOLUME", ct_, "DICOM folder, NIfTI, NRRD or MetaImage; without it: white",
                       false);
  arguments.option("--reference", "MESH", reference_, "surface of the CT to outline");
  arguments.option("--surface", "MESH", surfaces_,
                   "model to outline; repeatable; --at model is the middle of the first");
  arguments.option("--scan", "POINTS", scans_, "points to draw in red; repeatable");
  arguments.option("--plane", "NAME", planes_,
                   "axial, coronal, sagittal or oblique; repeatable (default: the first three)");
  arguments.option("--normal", "X,Y,Z", normal_, "of the oblique plane");
  arguments.option("--positions", "LIST", positions_,
                   "places of one plane along its axis, mm: 10,20,30, or FIRST:LAST:STEP");
  arguments.option("--columns", "N", columns_, "panels in a row");
  softscope::declare(options_, arguments);
}

/// "10,20,30" or "10:30:10". Throws OptionError.
std::vector<double> parsePositions(std::string text) {
  const std::string given = text;
  const bool range = text.find(':') != std::string::npos;
  for (char& c : text)
    if (c == ':') c = ' ';
  std::vector<double> values;
  for (const std::string_view word : wordsOf(text)) {
    const auto value = numberOf(word);
    if (!value || !std::isfinite(*value)) {
      values.clear();
      break;
    }
    values.push_back(*value);
  }
  if (range && values.size() == 3 && values[2] != 0 && (values[1] - values[0]) / values[2] >= 0 &&
      (values[1] - values[0]) / values[2] < double(kMostSlices)) {
    const double first = values[0], step = values[2];
    const auto count = static_cast<int>((values[1] - first) / step + 1e-6) + 1;
    values.clear();
    for (int i = 0; i < count; ++i) values.push_back(first + i * step);
  } else if (range) {
    values.clear();
  }
  if (values.empty() || values.size() > kMostSlices)
    throw OptionError("--positions is `" + given +
                      "`, but must be 1 to 100 places in mm: 10,20,30, or FIRST:LAST:STEP");
  return values;
}

void SliceCommand::read(SceneInputs& inputs) const {
  if (!ct_.empty()) inputs.addVolume(ct_, options_.window, options_.volume.options());
  std::size_t colour = 0;
  if (!reference_.empty())
    inputs.addSurface(reference_, "reference", "reference", surfaceColour(colour++));
  for (const std::string& path : surfaces_)
    inputs.addSurface(path, "surface", shown(std::filesystem::path(path).filename()),
                      surfaceColour(colour++));
  for (const std::string& path : scans_)
    inputs.addSurface(path, "scan", "scan", kScanRed).mesh.triangles.clear();
  inputs.checkPlaces();
}

ViewPlane SliceCommand::planeNamed(const std::string& name,
                                   const Eigen::Vector3d& centre_mm) const {
  const SideRule rule = options_.sideRule();
  if (name == "axial") return axialView(centre_mm, SceneFrame::kPatient, rule);
  if (name == "coronal") return coronalView(centre_mm, SceneFrame::kPatient, rule);
  if (name == "sagittal") return sagittalView(centre_mm, SceneFrame::kPatient);
  if (name != "oblique")
    throw OptionError("--plane is `" + name + "`, but must be axial, coronal, sagittal or oblique");
  if (normal_.empty()) throw OptionError("--plane oblique needs --normal X,Y,Z");
  return obliqueView(centre_mm, parseVector(normal_, "--normal"), SceneFrame::kPatient, rule);
}

std::vector<ViewPlane> SliceCommand::planesThrough(const Scene& scene) const {
  const Eigen::Vector3d centre_mm = options_.centreIn(
      scene, surfaces_.empty() ? nullptr : &scene.surfaces[(reference_.empty() ? 0 : 1)]);
  std::vector<std::string> names = planes_;
  if (names.empty()) names = {"axial", "coronal", "sagittal"};
  std::vector<ViewPlane> planes;
  for (const std::string& name : names) planes.push_back(planeNamed(name, centre_mm));
  if (positions_.empty()) return planes;
  const ViewPlane plane = planes[0];
  Eigen::Vector3d axis = plane.towardsViewer().cwiseAbs();  // of a standard plane: x, y or z
  if (plane.name == "oblique") axis = parseVector(normal_, "--normal").normalized();
  planes.clear();
  for (const double place_mm : parsePositions(positions_)) {
    ViewPlane moved = plane;
    const double from_mm = plane.name == "oblique" ? 0 : axis.dot(plane.centre_mm);
    moved.centre_mm += (place_mm - from_mm) * axis;
    if (plane.name == "oblique") {
      char text[48];
      std::snprintf(text, sizeof text, "oblique, %+.1f mm", place_mm);
      moved.name = text;
    }
    planes.push_back(moved);
  }
  return planes;
}

int SliceCommand::run() {
  options_.validate();
  require(columns_ >= 0, "--columns", columns_, "must be 1 or more");
  if (ct_.empty() && reference_.empty() && surfaces_.empty() && scans_.empty())
    throw OptionError("there is nothing to slice; give a VOLUME, --reference or --surface");
  if (!positions_.empty() && planes_.size() != 1)
    throw OptionError("--positions needs one --plane");
  if (!positions_.empty()) parsePositions(positions_);
  for (const std::string& name : planes_) planeNamed(name, Eigen::Vector3d::Zero());
  SceneInputs inputs(options_.unit_mm);
  read(inputs);
  Scene& scene = inputs.scene();
  scene.dot_reach_mm = options_.dot_reach_mm;
  PanelOptions panels;
  panels.style = options_.figureStyle();
  panels.width_mm = options_.field_mm;
  panels.keep_centres = !options_.at.empty();
  panels.columns = columns_;
  const std::vector<ViewPlane> planes = planesThrough(scene);
  Json record = figureRecord("slice", options_);
  VectorDrawing drawing;
  parallelInvoke([&] { record["inputs"] = inputs.inputsJson(); },
                 [&] { drawing = drawSlices(scene, planes, panels); });
  record["volume"] = inputs.volumeJson();
  record["surfaces"] = inputs.surfacesJson();
  const PanelField field = sliceViews(scene, planes, panels);
  for (const ViewPlane& plane : field.planes)
    record["views"].push_back(viewJson(plane, scene.frame, field.width_mm));
  record["warnings"] = inputs.warnings();
  for (const std::string& warning : inputs.warnings()) spdlog::warn("{}", warning);
  record = options_.paths.applyTo(record);
  writeFigure(drawing, options_, record);
  tellWritten(options_.out, options_.recordFile());
  if (common.json) printJson(record);
  return kDone;
}

}  // namespace

std::unique_ptr<Command> makeSliceCommand() { return std::make_unique<SliceCommand>(); }

}  // namespace softscope
