// apps/compare.cpp: `softscope compare`: a model against a reference surface.
#include <cmath>
#include <optional>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "apps/threshold_exit.h"
#include "core/error.h"
#include "io/text/text_lines.h"
#include "toolkit/comparison/compare_files.h"
#include "toolkit/comparison/compare_outputs.h"

namespace softscope {
namespace {

const char* const kCompareDetails =
    "Distances in both directions, point to triangle: accuracy (test to reference), completeness\n"
    "(reference to test), by vertex and by area; signed distances; three definitions of HD95;\n"
    "precision, recall, F-score and surface Dice at each tau. The test is a mesh or a point "
    "model.\n"
    "Completeness and derived values are not meaningful if the test covers a part of the "
    "reference:\n"
    "--observed SCAN splits all values into the observed part and the rest.\n"
    "--out DIR writes comparison.json, metrics.csv, errors.vtp (the aligned test with the arrays\n"
    "Signed, Absolute and ToReference), error_histogram and error_map as SVG, PDF and PNG, and\n"
    "error_map.vtp; `softscope report DIR` makes a report of them.\n"
    "Landmarks: CSV test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm.\n"
    "docs/evaluation.md defines every value.";

/// "0.5,1,2". Throws OptionError.
std::vector<double> parseTaus(const std::string& text) {
  std::vector<double> taus_mm;
  for (const std::string_view word : wordsOf(text)) {
    const auto tau_mm = numberOf(word);
    if (!tau_mm || !std::isfinite(*tau_mm) || *tau_mm <= 0)
      throw OptionError("--tau is `" + text + "`, but must be lengths in mm above 0, e.g. 0.5,1,2");
    taus_mm.push_back(*tau_mm);
  }
  return taus_mm;
}

class CompareCommand : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string summary() const override {
    return "distances between a model and a reference surface, in both directions";
  }
  std::string details() const override { return kCompareDetails; }
  std::string example() const override {
    return "softscope compare --reference liver_ct.stl --test run/model.ply --align icp --out cmp";
  }
  void declare(ArgumentList& arguments) override;
  int run() override;

 private:
  CompareOptions options_;
  std::string out_, align_, landmarks_, transform_, taus_ = "0.5,1,2";
  std::vector<std::string> fail_if_;
  ErrorColourOptions picture_;
  bool force_ = false;
};

void CompareCommand::declare(ArgumentList& arguments) {
  arguments.option("--reference", "MESH", options_.reference,
                   "reference surface (STL, PLY, OBJ, VTP)", true);
  arguments.option("--test", "MODEL", options_.test,
                   "surface, or points as reconstruct writes them, or a run", true);
  arguments.option("--frame", "N", options_.frame, "for a run: its saved model of frame N");
  arguments.option(
      "--align", "HOW", align_,
      "none (the default), landmarks, or icp, which starts from the landmarks if given");
  arguments.option("--landmarks", "FILE", landmarks_, "pairs of points; alone: --align landmarks");
  arguments.option("--transform", "FILE", transform_,
                   "reference_from_test, a 4 x 4 matrix in mm; initial alignment of icp");
  arguments.option("--tau", "LIST", taus_, "thresholds in mm (default 0.5,1,2)");
  arguments.option("--out", "DIR", out_,
                   "folder for the results; without it they are only printed");
  arguments.option(
      "--observed", "SCAN", options_.observed,
      "observed part, points or surface in the space of the reference: splits the values");
  arguments.option("--observed-within-mm", "N", options_.observed_reach_mm,
                   "distance within which the reference counts as observed (default 2)");
  arguments.option("--errors", "KIND", picture_.kind,
                   "colours of error_map: absolute (default) or signed");
  arguments.option("--range-mm", "N", picture_.range_mm,
                   "end of the colour bar (default: a round number, at least the P95)");
  arguments.option("--fail-if", "LIMIT", fail_if_,
                   "e.g. accuracy.p95_mm>2: then exit code 1; repeatable");
  arguments.option("--reference-unit-mm", "N", options_.reference_unit_mm,
                   "mm per unit of the file: 1000 for metres (default: as it states, else 1)");
  arguments.option("--test-unit-mm", "N", options_.test_unit_mm, "the same for the test");
  softscope::declare(options_.paths, arguments);
  arguments.flag("--force", force_, "overwrite existing files");
}

int CompareCommand::run() {
  options_.fit = parseFit(align_, landmarks_, "--landmarks");
  options_.fit.transform = transform_;
  require(picture_.kind != "none", "--errors", picture_.kind, "must be absolute or signed");
  picture_.validate();
  options_.taus_mm = parseTaus(taus_);
  for (const std::string& text : fail_if_) options_.thresholds.push_back(parseThreshold(text));
  options_.validate();  // before the work
  std::optional<CompareOutputs> outputs;
  if (!out_.empty()) outputs.emplace(out_, force_);
  FileComparison compared = compareFiles(options_);
  if (outputs)
    if (const std::string problem = outputs->write(compared.result, compared.reference,
                                                   compared.test, picture_, compared.record);
        !problem.empty())
      compared.result.warnings.push_back(problem);
  printResult(compared.record, comparisonFacts(compared.result), {out_}, common.json);
  return exitCodeOf(compared.outcomes);
}

}  // namespace

std::unique_ptr<Command> makeCompareCommand() { return std::make_unique<CompareCommand>(); }

}  // namespace softscope
