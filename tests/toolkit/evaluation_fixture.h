// tests/toolkit/evaluation_fixture.h: a run, its truth, and their evaluation.
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "support/made_run.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/records.h"
#include "toolkit/evaluation/evaluate_outputs.h"
#include "toolkit/evaluation/evaluate_run.h"

namespace softscope::test {

class Evaluation : public WallTest {
 protected:
  /// Of the run against its sequence.
  EvaluateOptions options() const {
    EvaluateOptions options;
    options.run = at("run");
    options.reference = at("truth");
    return options;
  }
  /// Of the run against a mesh.
  EvaluateOptions against(const std::string& mesh) const {
    EvaluateOptions options = this->options();
    options.reference = mesh;
    return options;
  }
  RunEvaluation evaluate() const { return evaluateRun(options()); }
  Json evaluated() const { return written(evaluate().record); }
  static Json evaluated(const EvaluateOptions& options) {
    return written(evaluateRun(options).record);
  }
  /// The evaluation, with its files in a new folder of that name.
  RunEvaluation evaluateInto(const std::string& out) const {
    const EvaluateOutputs outputs(at(out), /*overwrite=*/false);
    RunEvaluation evaluation = evaluate();
    outputs.write(evaluation);
    return evaluation;
  }
  void expectRefused(const std::vector<std::string>& parts) const {
    expectError<InputError>([&] { evaluate(); }, parts);
  }
};

}  // namespace softscope::test
