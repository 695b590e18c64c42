// tests/bench/bench_stereo.cpp: time and error of depth, as tables for docs/benchmarks.md.
//   SOFTSCOPE_TEST_DATA=… build/release/tests/bench/bench_stereo [accuracy|times]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"
#include "io/images/image_reader.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/images/gradient_image.h"
#include "stereo/images/opencv_view.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/matching/support_points.h"
#include "stereo/rectification/row_alignment.h"
#include "stereo_study/study.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

void printPair(const PairScore& s) {
  std::printf("| %s | %.3f | %.2f | %.1f | %.3f | %.2f | %.1f | %.3f / %.3f |\n", s.name.c_str(),
              s.elas.absolute_px.median, s.elas.bad_percent[2], s.elas.coverage_percent,
              s.sgbm.absolute_px.median, s.sgbm.bad_percent[2], s.sgbm.coverage_percent,
              s.elas_common_median_px, s.sgbm_common_median_px);
}

void printPairs() {
  std::printf(
      "| pair | ELAS median px | bad-3 %% | coverage %% | SGBM median px | bad-3 %% | coverage %% "
      "| "
      "both measured: ELAS / SGBM |\n|---|---|---|---|---|---|---|---|\n");
  if (const auto folder = dataFolder("bdis_tissue"); !folder.empty()) {
    PairScore mean;
    const auto scores = scoreTissuePairs(folder);
    double sums[8] = {};
    for (const PairScore& s : scores) {
      printPair(s);
      const double values[] = {s.elas.absolute_px.median, s.elas.bad_percent[2],
                               s.elas.coverage_percent,   s.sgbm.absolute_px.median,
                               s.sgbm.bad_percent[2],     s.sgbm.coverage_percent,
                               s.elas_common_median_px,   s.sgbm_common_median_px};
      for (int i = 0; i < 8; ++i) sums[i] += values[i] / static_cast<double>(scores.size());
    }
    std::printf(
        "| **tissue, mean** | **%.3f** | **%.2f** | **%.1f** | %.3f | %.2f | %.1f | "
        "%.3f / %.3f |\n",
        sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], sums[7]);
  }
  if (const auto folder = dataFolder("libelas_pairs"); !folder.empty()) {
    printPair(scoreAloe(folder));
    for (const auto& [name, maximum] : {std::pair{"aloe", 212.5}, std::pair{"cones", 106.6}}) {
      const Agreement a = agreeWithLibelas(folder, name, maximum);
      std::printf(
          "\n%s: %.1f %% of the pixels measured by both agree with libelas' stored output "
          "to 1 px; measured %.1f %% of all pixels (libelas %.1f %%)\n",
          name, a.within_1px_percent, a.ours_percent, a.theirs_percent);
    }
  }
}

/// A real clip's frames with a usable reference, one by one.
void printFrames(const SequenceScore& score) {
  std::printf(
      "\n| real clip, frame | rows off px | median mm | signed median mm | P95 mm | coverage %% |\n"
      "|---|---|---|---|---|---|\n");
  for (const FrameScore& f : score.frames)
    if (f.errors.known_count > 0)
      std::printf("| %06d | %.2f | %.2f | %+.2f | %.1f | %.1f |\n", f.frame,
                  f.rows.mean_row_difference_px, f.errors.absolute_mm.median,
                  f.errors.signed_mm.median, f.errors.absolute_mm.p95, f.errors.coverage_percent);
}

void printSequences() {
  std::printf(
      "\n| sequence | frames | median mm | mean mm | P95 mm | coverage %% | worst frame: median "
      "mm, coverage %% |\n|---|---|---|---|---|---|---|\n");
  for (const auto& [name, truth] : {std::pair{"openhelp_heart", "groundtruth/depth"},
                                    std::pair{"openhelp_kidney_small", "groundtruth/depth"},
                                    std::pair{"endonerf_pulling", "reference_depth"}}) {
    const auto folder = dataFolder(name);
    if (folder.empty()) continue;
    const SequenceScore s = scoreSequence(folder, truth);
    const FrameScore* worst = nullptr;
    for (const FrameScore& f : s.frames)
      if (f.errors.known_count > 0 &&
          (worst == nullptr || f.errors.absolute_mm.median > worst->errors.absolute_mm.median))
        worst = &f;
    std::printf("| %s | %zu | %.3f | %.3f | %.3f | %.1f | %06d: %.3f, %.1f |\n", name,
                s.frames.size(), s.pooled_mm.median, s.pooled_mm.mean, s.pooled_mm.p95,
                s.mean_coverage_percent, worst->frame, worst->errors.absolute_mm.median,
                worst->errors.coverage_percent);
    if (name == std::string("endonerf_pulling")) printFrames(s);
  }
}

void printCt() {
  const auto folder = dataFolder("opencas_ct");
  if (folder.empty()) return;
  std::printf(
      "\n| OpenCAS pair against CT | points | rows off px | mean mm | median mm | P95 mm |\n"
      "|---|---|---|---|---|---|\n");
  for (const bool align : {true, false}) {
    const CtScore s = scoreOpencas(folder, align);
    const char* rows = align ? "rows aligned" : "rows kept";
    for (const auto& [when, errors] : {std::pair{"as measured", s.alignment.before},
                                       std::pair{"after rigid alignment", s.alignment.after}})
      std::printf("| %s, %s | %zu | %.2f | %.3f | %.3f | %.3f |\n", rows, when, s.points,
                  s.rows.mean_row_difference_px, errors.distance_mm.mean, errors.distance_mm.median,
                  errors.distance_mm.p95);
  }
}

double elapsedMs(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

GrayImage resized(const GrayImage& image, int width, int height) {
  GrayImage out(width, height);
  cv::Mat view = opencvView(out);
  cv::resize(opencvView(image), view, view.size(), 0, 0, cv::INTER_AREA);
  return out;
}

/// Medians of interleaved runs, so that a busy machine slows all of them alike.
void printTimes(const GrayImage& left, const GrayImage& right, int threads) {
  constexpr int kRuns = 9;
  const ThreadLimit limit(threads);
  cv::setNumThreads(threads);
  const auto elas = makeStereoMatcher({});
  const auto sgbm = [&](int mode) {
    const auto matcher = cv::StereoSGBM::create(0, 256, 5, 200, 800, 1, 63, 10, 100, 2, mode);
    cv::Mat found;
    return elapsedMs([&] { matcher->compute(opencvView(left), opencvView(right), found); });
  };
  std::map<std::string, std::vector<double>> runs;
  for (int run = 0; run < kRuns; ++run) {
    runs["total"].push_back(elapsedMs([&] { elas->match(left, right); }));
    double refine_ms = 0;
    for (const auto& [stage, ms] : elas->times()) refine_ms += stage == "refine" ? ms : 0;
    runs["elas"].push_back(runs["total"].back() - refine_ms);
    runs["sgbm"].push_back(sgbm(cv::StereoSGBM::MODE_SGBM));
    runs["3way"].push_back(sgbm(cv::StereoSGBM::MODE_SGBM_3WAY));
  }
  std::printf("| %d x %d | %d | %.1f | %.1f | %.1f | %.1f |\n", left.width_px, left.height_px,
              threads, median(runs["elas"]), median(runs["total"]), median(runs["sgbm"]),
              median(runs["3way"]));
}

ColourImage resized(const ColourImage& image, int width, int height) {
  ColourImage out(width, height);
  cv::Mat view = opencvView(out);
  cv::resize(opencvView(image), view, view.size(), 0, 0, cv::INTER_AREA);
  return out;
}

/// What a frame costs besides the matcher.
void printOtherStages(const StereoPair& pair, int threads) {
  constexpr int kRuns = 9;
  const ThreadLimit limit(threads);
  cv::setNumThreads(threads);
  RectifiedRig rig;
  rig.left = {pair.left.width_px, pair.left.height_px, 560, 560, 320, 240};
  rig.baseline_mm = 5;
  const DisparityMap disparity =
      makeStereoMatcher({})->match(toGray(pair.left), toGray(pair.right));
  std::vector<double> rows, depth, normals, cloud;
  for (int run = 0; run < kRuns; ++run) {
    DepthMap map;
    NormalMap normal_map;
    rows.push_back(elapsedMs([&] { alignRows(pair, 255); }));
    depth.push_back(elapsedMs([&] { map = depthFromDisparity(disparity, rig); }));
    normals.push_back(elapsedMs([&] { normal_map = normalsFromDepth(map.depth_mm, rig.left); }));
    cloud.push_back(
        elapsedMs([&] { pointCloud(map.depth_mm, normal_map, pair.left, rig.left, {}); }));
  }
  std::printf("| %d x %d | %d | %.1f | %.1f | %.1f | %.1f |\n", pair.left.width_px,
              pair.left.height_px, threads, median(rows), median(depth), median(normals),
              median(cloud));
}

void printAllTimes() {
  const auto folder = dataFolder("endonerf_pulling");
  if (folder.empty()) return;
  const ColourImage left = readColourImage(folder / "left" / "000000.jpg");
  const ColourImage right = readColourImage(folder / "right" / "000000.jpg");
  const GrayImage left_gray = toGray(left), right_gray = toGray(right);
  std::printf(
      "\n| in vivo, 256 disparities | cores | ELAS alone ms | with sub-pixel and errors ms | SGBM "
      "ms | SGBM_3WAY ms |\n|---|---|---|---|---|---|\n");
  for (const auto& [width, height] :
       {std::pair{360, 288}, std::pair{640, 480}, std::pair{1280, 1024}})
    for (const int threads : {1, 2})
      printTimes(resized(left_gray, width, height), resized(right_gray, width, height), threads);
  std::printf(
      "\n| the same pair | cores | align rows ms | depth ms | normals ms | points ms |\n"
      "|---|---|---|---|---|---|\n");
  for (const int threads : {1, 2})
    printOtherStages({resized(left, 640, 480), resized(right, 640, 480)}, threads);
}

}  // namespace
}  // namespace softscope::test

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "";
  const auto asked = [&](const char* part) { return what.empty() || what == part; };
  if (asked("accuracy")) {
    softscope::test::printPairs();
    softscope::test::printSequences();
    softscope::test::printCt();
  }
  if (asked("times")) softscope::test::printAllTimes();
}
