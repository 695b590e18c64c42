// toolkit/face/evaluate.cpp: implementation of include/softscope/evaluate.h.
#include "softscope/evaluate.h"

#include <optional>

#include "toolkit/evaluation/evaluate_outputs.h"
#include "toolkit/evaluation/evaluate_run.h"
#include "toolkit/face/distances_of.h"
#include "toolkit/record/json_text.h"

namespace softscope::api {
namespace {

EvaluateOptions optionsOf(const Run& run, const std::string& reference,
                          const EvaluationOptions& options) {
  EvaluateOptions made;
  made.run = run.folder();
  made.reference = reference;
  made.alignment = meshAlignmentNamed(options.align, "align");
  made.each_model = options.each_model;
  made.reference_unit_mm = options.reference_unit_mm;
  made.views = options.views;
  return made;
}

}  // namespace

double Evaluation::metric(const std::string& path) const {
  const auto found = metrics.find(path);
  if (found == metrics.end())
    throw OptionError("`" + path + "` is no metric of this evaluation; `metrics` lists them");
  return found->second;
}

Evaluation evaluate(const Run& run, const std::string& reference,
                    const EvaluationOptions& options) {
  std::optional<EvaluateOutputs> outputs;
  if (!options.out.empty()) outputs.emplace(options.out, options.overwrite);
  const RunEvaluation found = evaluateRun(optionsOf(run, reference, options), options.progress);
  if (found.interrupted) throw Error("evaluate: stopped by progress(); no files were written");
  if (outputs) outputs->write(found);
  Evaluation evaluation;
  if (const auto* judged = std::get_if<EvaluationResult>(&found.result)) {
    const SurfaceSeries& surface = judged->surface;
    evaluation.surface = {distancesOf(surface.all_mm), distancesOf(surface.observed_mm),
                          distancesOf(surface.predicted_mm)};
    evaluation.warnings = judged->warnings;
  } else {
    evaluation.surface = {distancesOf({}), distancesOf({}), distancesOf({})};
    if (const auto* beside = std::get_if<TruthlessResult>(&found.result))
      evaluation.warnings = beside->warnings;
  }
  evaluation.metrics = metricMapOf(found.record);
  evaluation.record = jsonText(found.record);
  return evaluation;
}

}  // namespace softscope::api
