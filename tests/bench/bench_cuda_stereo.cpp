// tests/bench/bench_cuda_stereo.cpp: stereo on the GPU: equal to the CPU, and how long.
//
// bench_cuda_stereo LEFT.pgm RIGHT.pgm [LEFT.pgm RIGHT.pgm …] [--repeats N] [--check]
// Binary 8-bit PGM, rectified, rows aligned. --check compares
// alone, for compute-sanitizer.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "cuda/stereo/stereo.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/matching/elas_matcher.h"
#include "tests/bench/cuda_bench.h"

using namespace softscope;
using namespace softscope::bench;

namespace {

/// Values that differ in a bit; NaN equals NaN.
long differing(const float* a, const float* b, std::size_t count) {
  long differ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool both_nan = a[i] != a[i] && b[i] != b[i];
    differ += !both_nan && std::memcmp(a + i, b + i, sizeof(float)) != 0;
  }
  return differ;
}

/// Prints how many values differ; returns whether none does.
bool compare(const cuda::StereoDepth& found, const GrayImage& left, const GrayImage& right,
             const RectifiedRig& rig, const StereoOptions& options) {
  ElasMatcher matcher{options};
  const double start = nowMs();
  const DisparityMap disparity = matcher.match(left, right);
  const DepthMap depth = depthFromDisparity(disparity, rig);
  const NormalMap normals = normalsFromDepth(depth.depth_mm, rig.left);
  const double cpu_ms = nowMs() - start;
  const std::size_t count = left.size();
  const auto data = [](const Raster<float>& raster) { return raster.values.data(); };
  const auto normal_data = [](const NormalMap& map) { return map.values.front().data(); };
  const long differences[] = {
      differing(data(found.disparity.disparity_px), data(disparity.disparity_px), count),
      differing(data(found.disparity.sigma_px), data(disparity.sigma_px), count),
      differing(data(found.depth.depth_mm), data(depth.depth_mm), count),
      differing(data(found.depth.sigma_mm), data(depth.sigma_mm), count),
      differing(normal_data(found.normals), normal_data(normals), 3 * count)};
  const long measured = std::count_if(depth.depth_mm.values.begin(), depth.depth_mm.values.end(),
                                      [](float z) { return z == z; });
  std::printf(
      "  values that differ from the CPU's: disparity %ld, sigma %ld, depth %ld, depth sigma %ld, "
      "normals %ld; measured %ld of %zu; levels %d; CPU %.1f ms\n",
      differences[0], differences[1], differences[2], differences[3], differences[4], measured,
      count, found.levels, cpu_ms);
  return std::all_of(std::begin(differences), std::end(differences), [](long n) { return n == 0; });
}

void time(cuda::Stereo& stereo, const MatchableViews& views, int repeats) {
  std::vector<double> compute_ms, frame_ms, download_ms;
  for (int i = 0; i < repeats + 20; ++i) {
    const double start = nowMs();
    stereo.upload(views);
    stereo.wait();
    const double uploaded = nowMs();
    stereo.compute();
    stereo.wait();
    const double computed = nowMs();
    if (i < 20) continue;
    compute_ms.push_back(computed - uploaded);
    frame_ms.push_back(computed - start);
  }
  for (int i = 0; i < 20; ++i) {
    const double start = nowMs();
    stereo.download();
    download_ms.push_back(nowMs() - start);
  }
  print("compute, wait", compute_ms);
  print("upload of gray, compute, wait", frame_ms);
  print("download of everything", download_ms);
  printStages(stereo, [&] { stereo.compute(); });
}

int run(const std::vector<std::string>& files, const StereoOptions& options, int repeats,
        bool check_only) {
  bool all_equal = true;
  for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
    const GrayImage left = readPgm(files[i]), right = readPgm(files[i + 1]);
    const RectifiedRig rig = rigOf(left);
    cuda::Stereo stereo(options, rig, left.width_px, left.height_px);
    std::printf("%s: %d x %d, %.1f MB on the device\n", files[i].c_str(), left.width_px,
                left.height_px, static_cast<double>(stereo.deviceBytes()) / 1e6);
    const MatchableViews views = matchableViews(left, right, {});
    stereo.upload(views);
    stereo.compute();
    all_equal = compare(stereo.download(), left, right, rig, options) && all_equal;
    if (!check_only) {
      time(stereo, views, repeats);
      all_equal = compare(stereo.download(), left, right, rig, options) && all_equal;
    }
    std::fflush(stdout);
  }
  return all_equal ? 0 : 1;
}

int usage() {
  std::fprintf(stderr,
               "usage: bench_cuda_stereo LEFT.pgm RIGHT.pgm [LEFT.pgm RIGHT.pgm ...] [--repeats N] "
               "[--check]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  StereoOptions options;
  int repeats = 500;
  bool check_only = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--check")
      check_only = true;
    else if (argument == "--repeats" && i + 1 < argc)
      repeats = std::max(1, std::atoi(argv[++i]));
    else if (argument.rfind("--", 0) == 0)
      return usage();
    else
      files.push_back(argument);
  }
  if (files.empty() || files.size() % 2 != 0) return usage();
  return bench::onDevice([&] { return run(files, options, repeats, check_only); });
}
