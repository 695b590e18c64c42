#include "toolkit/benchmark/surgt_scores.h"

#include <cmath>

#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

/// Scores over all videos of one tracker.
struct SurgtPool {
  std::vector<BoxScores> videos;
  std::vector<std::vector<double>> overlaps;

  void add(const SurgtVideoScores& scores) {
    videos.push_back(mergeBoxScores(scores.targets));
    overlaps.insert(overlaps.end(), scores.overlaps.begin(), scores.overlaps.end());
  }
};

void addScores(const std::string& label, const std::string& key, const SurgtPool& pool,
               FactSheet* facts) {
  const BoxScores scores = mergeBoxScores(pool.videos);
  const double eao = expectedAverageOverlap(pool.overlaps);
  const auto text = [](double value, int digits) {
    return std::isfinite(value) ? fixed(value, digits) : std::string("-");
  };
  facts->addLine(label, "EAO " + text(eao, 3) + "  2-D: robustness " +
                            text(scores.robustness_2d, 3) + ", accuracy " +
                            text(scores.accuracy, 3) + ", error " + text(scores.error_px, 1) +
                            " px  3-D: robustness " + text(scores.robustness_3d, 3) + ", error " +
                            text(scores.error_mm, 2) + " mm");
  facts->addQuietly(key, {{"eao", orNull(eao)},
                          {"robustness_2d", orNull(scores.robustness_2d)},
                          {"accuracy", orNull(scores.accuracy)},
                          {"error_px", orNull(scores.error_px)},
                          {"error_sd_px", orNull(scores.error_sd_px)},
                          {"robustness_3d", orNull(scores.robustness_3d)},
                          {"error_mm", orNull(scores.error_mm)},
                          {"error_sd_mm", orNull(scores.error_sd_mm)},
                          {"frames", scores.frames_judged}});
}

}  // namespace

FactSheet surgtBenchmarkFacts(const SurgtBenchmarkResult& result) {
  SurgtPool found, control;
  std::vector<std::string> judged;
  std::vector<ExcludedClip> excluded;
  std::vector<double> latency_ms, gain, robustness, error_mm;
  std::size_t boxes = 0, frames = 0;
  int starts = 0, missing = 0;
  for (const SurgtClipResult& clip : result.clips) {
    if (!clip.excluded.empty()) {
      excluded.push_back({clip.name, clip.excluded});
      continue;
    }
    judged.push_back(clip.name);
    found.add(clip.found);
    control.add(clip.control);
    robustness.push_back(found.videos.back().robustness_2d);
    gain.push_back(robustness.back() - control.videos.back().robustness_2d);
    error_mm.push_back(found.videos.back().error_mm);
    latency_ms.insert(latency_ms.end(), clip.latency_ms.begin(), clip.latency_ms.end());
    boxes += clip.boxes;
    frames += clip.frames;
    starts += clip.starts;
    missing += clip.missing_starts;
  }
  FactSheet facts("SurgT");
  addClips(judged, excluded, &facts);
  facts.add("protocol", "protocol",
            std::string("trackers start with the true boxes every 50 frames and run to the "
                        "video's end; a miss: overlap not above 0.1 in a view (2-D), centres more "
                        "than 100 mm apart (3-D); 11 misses in succession: failure; EAO over ranks "
                        "150 to 828; rectified images, alpha = 0"));
  facts.add("starts", "starts", starts);
  if (missing > 0)
    facts.warn(std::to_string(missing) + " of " + std::to_string(starts) +
               " starts have no run and count as trackers without estimates");
  facts.addQuietly("missing_starts", missing);
  addScores("tracked", "scores", found, &facts);
  addScores("nothing moves", "control", control, &facts);
  if (!std::isfinite(expectedAverageOverlap(found.overlaps)))
    facts.addLine("EAO", "not defined: no track has 150 frames");
  const double coverage =
      frames == 0 ? Statistics::kNone : static_cast<double>(boxes) / static_cast<double>(frames);
  facts.add("coverage", fixed(100 * coverage, 1) + " % of the evaluated frames have an estimate",
            "coverage", orNull(coverage));
  addClusterMean("robustness 2-D per video", "clip_robustness_2d", "", "videos", robustness,
                 &facts);
  addClusterMean("over the control", "clip_robustness_2d_over_control", "", "videos", gain, &facts);
  addClusterMean("error per video", "clip_error_mm", " mm", "videos", error_mm, &facts);
  if (judged.size() < 3)
    facts.addLine("intervals", "none: a bootstrap over videos needs three or more");
  addLatency(latency_ms, "per frame, without the first of each run", &facts);
  return facts;
}

}  // namespace softscope
