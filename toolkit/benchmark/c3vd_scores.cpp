#include "toolkit/benchmark/c3vd_scores.h"

#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

double meanOver(const std::vector<DepthErrors>& frames, double (*value)(const DepthErrors&)) {
  std::vector<double> values;
  for (const DepthErrors& errors : frames) values.push_back(value(errors));
  return statistics(values).mean;
}

double rmseOf(const DepthErrors& errors) { return errors.absolute_mm.rmse; }

/// One value per clip with a result.
std::vector<double> perClip(const C3vdBenchmarkResult& result,
                            std::vector<DepthErrors> HeldOutDepths::*part,
                            double (*value)(const DepthErrors&)) {
  std::vector<double> clips;
  for (std::size_t i = 0; i < result.depths.size(); ++i)
    if (result.path.clips[i].excluded.empty())
      clips.push_back(meanOver(result.depths[i].*part, value));
  return clips;
}

void addHeldOutRow(const std::string& label, const std::string& key,
                   const C3vdBenchmarkResult& result, std::vector<DepthErrors> HeldOutDepths::*part,
                   FactSheet* facts) {
  const auto mean = [&](double (*value)(const DepthErrors&)) {
    return statistics(perClip(result, part, value)).mean;
  };
  const double rmse = mean(rmseOf),
               mae = mean([](const DepthErrors&errors) { return errors.absolute_mm.mean; }),
               median = mean([](const DepthErrors&errors) { return errors.absolute_mm.median; }),
               coverage = mean([](const DepthErrors&errors) { return errors.coverage_percent; });
  facts->addLine(label, "RMSE " + fixed(rmse, 3) + "  MAE " + fixed(mae, 3) + "  median " +
                            fixed(median, 3) + " mm  coverage " + fixed(coverage, 1) + " %");
  facts->addQuietly(key, {{"rmse_mm", orNull(rmse)},
                          {"mae_mm", orNull(mae)},
                          {"median_mm", orNull(median)},
                          {"coverage_percent", orNull(coverage)}});
}

}  // namespace

FactSheet c3vdBenchmarkFacts(const C3vdBenchmarkResult& result) {
  FactSheet facts = pathBenchmarkFacts(result.path);
  addHeldOutRow("depth", "depth", result, &HeldOutDepths::drawn, &facts);
  addHeldOutRow("depth, dense", "depth_dense", result, &HeldOutDepths::dense, &facts);
  addHeldOutRow("depth, nothing moves", "depth_control", result, &HeldOutDepths::control, &facts);
  std::size_t drawn = 0;
  int missing = 0;
  for (const HeldOutDepths& depths : result.depths) {
    drawn += depths.drawn.size();
    missing += depths.missing;
  }
  facts.addLine("held-out frames",
                std::to_string(drawn) + " drawn, " + std::to_string(missing) + " without a model");
  facts.addQuietly("held_out_frames", {{"drawn", drawn}, {"missing", missing}});
  addClusterMean("depth RMSE per clip", "clip_depth_rmse_mm", " mm", "clips",
                 perClip(result, &HeldOutDepths::drawn, rmseOf), &facts);
  return facts;
}

}  // namespace softscope
