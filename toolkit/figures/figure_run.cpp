// toolkit/figures/figure_run.cpp: truth, scan and model, in drawing order.
#include "toolkit/figures/figure_run.h"

#include <utility>

#include "toolkit/evaluation/run_moment.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr double kScanLine = 2.6;  // drawn below the contour of the model, so wider

}  // namespace

Json addRunMoment(const RunMomentOptions& options, SceneInputs& inputs, FigureFoot& foot) {
  const JudgedPair pair(options.run, options.sequence);
  for (const std::string& warning : pair.warnings) inputs.warn(warning);
  RunMoment moment = pair.moment(pair.chooseFrame(options.frame), /*surface=*/true);
  const bool coloured = options.errors.kind != "none";
  inputs.scene().frame = SceneFrame::kCamera;
  inputs.addMade({"true surface", std::move(moment.truth), {170, 170, 170}, {}}, "reference",
                 moment.truth_file);
  foot.notes.push_back("Model and scan of " + momentText(moment.frame, moment.time_s) +
                       ", in the view of the scope.");
  SceneSurface& scan = inputs.addMade({"scan of this frame", std::move(moment.scan), kScanRed, {}},
                                      "scan", moment.scan_file);
  scan.dot_scale = kScanLine;
  scan.in_3d = !coloured;
  SceneSurface& model = inputs.addMade({"model", std::move(moment.model), surfaceColour(1), {}},
                                       "model", moment.model_file);
  model.mesh.colours.clear();  // the legend's colour
  model.in_focus = true;
  Json record{{"run", options.run}, {"sequence", options.sequence}, {"frame", moment.frame}};
  record["left_from_true_world"] = matrixJson(moment.left_from_true_world.matrix());
  record["observed_share"] = moment.errors.observed_share;
  if (!coloured) return record;
  const SurfaceErrorMap map =
      colourErrors(moment.distances(options.observed_only),
                   moment.signedDistances(options.observed_only), options.errors);
  model.errors_mm = map.each_mm;
  map.explainIn(foot);
  record["errors"] = map.json;
  record["errors"]["alignment"] = "by the true pose of the camera";
  record["errors"]["points"] = options.observed_only ? "seen now" : "all";
  return record;
}

}  // namespace softscope
