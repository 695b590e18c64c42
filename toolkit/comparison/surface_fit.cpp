// toolkit/comparison/surface_fit.cpp: landmark alignment followed by ICP.
#include "toolkit/comparison/surface_fit.h"

#include "core/error.h"
#include "eval/statistics/cohort.h"
#include "eval/surfaces/surface_errors.h"
#include "io/calibrations/calibration_parts.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/comparison/compare_inputs.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {

SurfaceFitOptions parseFit(const std::string& align, const std::string& landmarks,
                           const std::string& landmarks_option) {
  require(align.empty() || align == "none" || align == "landmarks" || align == "icp", "`align=`",
          align, "must be none, landmarks or icp");
  if (align == "landmarks" && landmarks.empty())
    throw OptionError("`align=` landmarks needs " + landmarks_option + " FILE");
  if (align == "none" && !landmarks.empty())
    throw OptionError("`align=` none and " + landmarks_option + " exclude each other; give one");
  return {landmarks, align == "icp", ""};
}

Eigen::Isometry3d readTransform(const std::string& file) {
  std::vector<double> numbers;
  const std::string text = readText(file, kTextLimitBytes);
  for (const std::string_view line : linesOf(text))
    for (const std::string_view word : wordsOf(line.substr(0, line.find('#')))) {
      const auto number = numberOf(word);
      if (!number)
        throw InputError(say(shown(file), ": ", excerpt(word),
                             " is no number; a matrix of 3 or 4 rows of 4 numbers is expected"));
      numbers.push_back(*number);
    }
  const bool closed = numbers.size() == 16 && numbers[12] == 0 && numbers[13] == 0 &&
                      numbers[14] == 0 && numbers[15] == 1;
  if (numbers.size() != 12 && !closed)
    throw InputError(say(shown(file), ": holds ", numbers.size(),
                         " numbers, but a rigid motion has 3 rows of 4, and maybe 0 0 0 1 below"));
  std::vector<double> rotation, translation;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      rotation.push_back(numbers[4 * row + column]);
    translation.push_back(numbers[4 * row + 3]);
  }
  return poseFrom(rotation, translation, shown(file) + ": the rotation",
                  shown(file) + ": the translation");
}

SurfaceFit fitSurface(const TriangleMesh& reference, const std::vector<Eigen::Vector3f>& test_mm,
                      const SurfaceFitOptions& options) {
  SurfaceFit fit;
  if (!options.moves()) return fit;
  const TriangleTree surface(reference);
  fit.before_mm = surfaceErrors(surface.closestPoints(test_mm)).distance_mm;
  if (!options.landmarks.empty()) {
    const Landmarks landmarks = readLandmarks(options.landmarks);
    fit.landmarks = landmarkErrors(landmarks.test_mm, landmarks.reference_mm);
    fit.reference_from_test = fit.landmarks->fit.target_from_source;
    fit.method = "landmarks";
  }
  if (!options.transform.empty()) {
    fit.reference_from_test = readTransform(options.transform);
    fit.method = "given";
  }
  if (!options.closest_points) return fit;
  fit.icp = alignToSurface(test_mm, surface, {}, fit.reference_from_test);
  fit.reference_from_test = fit.icp->surface_from_points;
  fit.method = fit.method == "none" ? "icp" : fit.method + ", then icp";
  if (!fit.icp->converged())
    fit.warnings.emplace_back(
        "the alignment did not converge; a better initial alignment may help: --landmarks");
  return fit;
}

FactSheet::Json surfaceFitJson(const SurfaceFit& fit) {
  FactSheet::Json json{{"method", fit.method},
                       {"reference_from_test", matrixJson(fit.reference_from_test.matrix())}};
  if (fit.before_mm) json["before"] = statisticsJson(*fit.before_mm, "_mm");
  if (fit.landmarks) {
    json["fre"] = statisticsJson(fit.landmarks->fre_mm, "_mm");
    json["tre_leave_one_out"] = statisticsJson(fit.landmarks->tre_mm, "_mm");
    const Interval interval_mm = meanInterval(fit.landmarks->tre_mm);
    json["tre_leave_one_out"]["mean_ci_95_mm"] = {orNull(interval_mm.low),
                                                  orNull(interval_mm.high)};
  }
  if (fit.icp)
    json["icp"] = {{"stop", stopText(fit.icp->stop)},
                   {"iterations", fit.icp->iterations},
                   {"free_directions", fit.icp->free_directions}};
  return json;
}

void addFitFacts(const SurfaceFit& fit, FactSheet& facts) {
  facts.addLine("alignment", fit.method);
  if (fit.before_mm) facts.addLine("  before", spreadText(*fit.before_mm));
  const Interval tre_ci_mm = fit.landmarks ? meanInterval(fit.landmarks->tre_mm) : Interval();
  if (fit.landmarks)
    facts.addLine("  landmarks", "FRE rmse " + fixed(fit.landmarks->fre_mm.rmse, 3) + " mm" +
                                     (fit.landmarks->tre_mm.count == 0
                                          ? std::string("; TRE takes four landmarks")
                                          : "; TRE, leaving one out, mean " +
                                                fixed(fit.landmarks->tre_mm.mean, 3) +
                                                " mm (95 % confidence " + fixed(tre_ci_mm.low, 3) +
                                                " to " + fixed(tre_ci_mm.high, 3) + " mm)"));
  if (fit.icp)
    facts.addLine("  icp", std::string(stopText(fit.icp->stop)) + " after " +
                               std::to_string(fit.icp->iterations) + " iterations");
}

}  // namespace softscope
