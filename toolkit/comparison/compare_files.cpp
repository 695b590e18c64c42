// toolkit/comparison/compare_files.cpp: alignment and measurement of two surfaces from files.
#include "toolkit/comparison/compare_files.h"

#include <cmath>

#include "core/error.h"
#include "io/files/file_hash.h"
#include "io/files/folder.h"
#include "io/text/message.h"
#include "mesh/mesh_check.h"
#include "toolkit/comparison/compare_inputs.h"
#include "toolkit/evaluation/evaluate_plots.h"
#include "toolkit/export/export_input.h"
#include "toolkit/run/run_reader.h"

namespace softscope {
namespace {

constexpr const char* kAccuracy = "accuracy";  // part of the record for metrics without path

void addMeshWarnings(const TriangleMesh& mesh, const std::string& name,
                     const std::string& unit_option, std::vector<std::string>& warnings) {
  if (mesh.empty()) return;
  for (const std::string& warning : meshWarnings(checkMesh(mesh), unit_option))
    warnings.push_back(name + ": " + warning);
}

ObservedSplit split(const CompareOptions& options, const FileComparison& compared) {
  TriangleMesh observed = readSurfaceOrPoints(options.observed, options.reference_unit_mm);
  matchSpaces(compared.reference, observed);
  return splitByObserved(compared.reference, observed, compared.result.comparison,
                         options.observed_reach_mm);
}

/// Of a part of a surface, the test may be another part.
void warnOfBorder(const std::string& reference, ComparisonResult* result) {
  constexpr double kFew = 0.05;  // as on the rim of two equal parts
  const Statistics& of_sign = result->comparison.signed_mm;
  const double share = static_cast<double>(of_sign.nan_count) /
                       static_cast<double>(of_sign.nan_count + of_sign.count);
  if (share > kFew)
    result->warnings.push_back(
        say(std::lround(100 * share), " % of the test's vertices lie at or beyond the border of ",
            "the reference, and count with their distance from it; --observed ", reference,
            " tells the values of the others"));
}

/// Every metric that these options give, without its value.
ComparisonResult unmeasured(const CompareOptions& options) {
  ComparisonResult result;
  for (const double tau_mm : options.taus_mm) {
    result.comparison.scores.emplace_back();
    result.comparison.scores.back().tau_mm = tau_mm;
  }
  if (!options.observed.empty()) result.observed.emplace();
  return result;
}

/// File of the test surface; for a run its selected model.
std::string testFile(const CompareOptions& options, std::vector<std::string>& warnings) {
  if (!isFolder(options.test)) return options.test;
  const JudgedRun run = openJudgedRun(options.test);
  for (const std::string& warning : run.warnings()) warnings.push_back(warning);
  if (options.frame >= 0 && !run.counts(options.frame))
    warnings.push_back(say("frame ", options.frame, " of ", options.test,
                           " was not fused: its model is that of an earlier frame"));
  return savedModel(options.test, options.frame).file.string();
}

void readSurfaces(const CompareOptions& options, const std::string& test,
                  FileComparison& compared) {
  compared.reference = readSurfaceOrPoints(options.reference, options.reference_unit_mm);
  if (compared.reference.empty())
    throw InputError(options.reference +
                     ": is a set of points, but the reference must be a surface; give a mesh");
  compared.test = readSurfaceOrPoints(test, options.test_unit_mm);
  std::vector<std::string>& warnings = compared.result.warnings;
  addMeshWarnings(compared.reference, options.reference, "--reference-unit-mm", warnings);
  addMeshWarnings(compared.test, options.test, "--test-unit-mm", warnings);
}

}  // namespace

void CompareOptions::validate() const {
  require(observed_reach_mm > 0 && std::isfinite(observed_reach_mm), "`observed_within_mm=`",
          observed_reach_mm, "must be above 0");
  if (frame >= 0 && !isFolder(test))
    throw OptionError("`frame=` is for a run, but `test=` " + test + " is no folder of one");
  if (!fit.transform.empty() && !fit.landmarks.empty())
    throw OptionError("`transform=` and `landmarks=` exclude each other; give one");
  for (const double tau_mm : taus_mm)
    require(tau_mm > 0 && std::isfinite(tau_mm), "`taus_mm=`", tau_mm, "must be above 0");
  checkThresholds(thresholds, comparisonJson(unmeasured(*this)), kAccuracy);
}

FileComparison compareFiles(const CompareOptions& options) {
  options.validate();
  FileComparison compared;
  ComparisonResult& result = compared.result;
  result.reference = options.reference;
  const std::string test = testFile(options, result.warnings);
  result.test = test;
  readSurfaces(options, test, compared);
  if (compared.reference.space.empty() != compared.test.space.empty())
    result.warnings.push_back((compared.test.space.empty() ? test : options.reference) +
                              ": names no space, unlike the other file; LPS is assumed. Write "
                              "SPACE=LPS or SPACE=RAS into its header");
  result.space = matchSpaces(compared.reference, compared.test);
  result.fit = fitSurface(compared.reference, compared.test.vertices_mm, options.fit);
  compared.test.vertices_mm = movePoints(result.fit.reference_from_test, compared.test.vertices_mm);
  for (const std::string& warning : result.fit.warnings) result.warnings.push_back(warning);
  result.comparison = compareSurfaces(compared.reference, compared.test, options.taus_mm);
  if (options.observed.empty()) {
    warnOfBorder(options.reference, &result);
  } else {
    result.observed = split(options, compared);
    if (result.observed->reference_share == 0)
      result.warnings.push_back(say(options.observed, ": nothing of the reference is within ",
                                    options.observed_reach_mm,
                                    " mm of it, so no value of the observed part is known; in "
                                    "another space or unit?"));
  }

  FactSheet::Json record = comparisonJson(result);
  record["inputs_sha256"] = {{"reference", sha256Of(options.reference)}, {"test", sha256Of(test)}};
  compared.outcomes = checkThresholds(options.thresholds, record, kAccuracy);
  record["thresholds"] = thresholdsJson(compared.outcomes);
  record["error_histogram"] = histogramJson(result.comparison.accuracy.each_mm);
  compared.record = options.paths.applyTo(record);
  return compared;
}

}  // namespace softscope
