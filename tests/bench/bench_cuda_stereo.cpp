// tests/bench/bench_cuda_stereo.cpp: stereo on the GPU: equal to the CPU, and how long.
//
// bench_cuda_stereo LEFT.pgm RIGHT.pgm [LEFT.pgm RIGHT.pgm …] [--repeats N] [--rows] [--check]
// Binary 8-bit PGM, rectified, rows aligned. --rows: the prior by rows. --check compares
// alone, for compute-sanitizer.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "cuda/device_info.h"
#include "cuda/stereo.h"
#include "stereo/depth_from_disparity.h"
#include "stereo/elas_matcher.h"

using namespace softscope;

namespace {

GrayImage readPgm(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, most = 0;
  file >> magic >> width >> height >> most;
  file.get();
  if (!file || magic != "P5" || most != 255)
    throw InputError(path + ": not a binary 8-bit PGM without comments");
  GrayImage image(width, height);
  file.read(reinterpret_cast<char*>(image.values.data()),
            static_cast<std::streamsize>(image.size()));
  if (!file) throw InputError(path + ": too short");
  return image;
}

/// Values that differ in a bit; NaN equals NaN.
long differing(const float* a, const float* b, std::size_t count) {
  long differ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool both_nan = a[i] != a[i] && b[i] != b[i];
    differ += !both_nan && std::memcmp(a + i, b + i, sizeof(float)) != 0;
  }
  return differ;
}

double nowMs() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

struct Percentiles {
  explicit Percentiles(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    p50 = at(0.5);
    p95 = at(0.95);
    p99 = at(0.99);
    most = values.back();
  }
  double p50, p95, p99, most;
};
void print(const char* what, const std::vector<double>& values) {
  const Percentiles p(values);
  std::printf("  %-34s p50 %.3f  p95 %.3f  p99 %.3f  max %.3f ms\n", what, p.p50, p.p95, p.p99,
              p.most);
}

RectifiedRig rigOf(const GrayImage& image) {
  RectifiedRig rig;
  rig.left = {image.width_px,
              image.height_px,
              600,
              600,
              image.width_px / 2.0 + 0.3,
              image.height_px / 2.0 - 0.2};
  rig.baseline_mm = 5;
  return rig;
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

void time(cuda::Stereo& stereo, const GrayImage& left, const GrayImage& right, int repeats) {
  std::vector<double> compute_ms, frame_ms, download_ms;
  for (int i = 0; i < repeats + 20; ++i) {
    const double start = nowMs();
    stereo.upload(left, right);
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
  stereo.timeStages(true);
  std::map<std::string, std::vector<double>> laps;
  std::vector<std::string> order;
  for (int i = 0; i < 60; ++i) {
    stereo.compute();
    for (const auto& [stage, elapsed_ms] : stereo.stageTimes()) {
      if (laps.find(stage) == laps.end()) order.push_back(stage);
      laps[stage].push_back(elapsed_ms);
    }
  }
  stereo.timeStages(false);
  std::printf("  stages launched one by one, p50 in us:");
  for (const std::string& stage : order)
    std::printf(" %s %.1f;", stage.c_str(), 1000 * Percentiles(laps[stage]).p50);
  std::printf("\n");
}

int run(const std::vector<std::string>& files, const StereoOptions& options, int repeats,
        bool check_only) {
  bool all_equal = true;
  for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
    const GrayImage left = readPgm(files[i]), right = readPgm(files[i + 1]);
    const RectifiedRig rig = rigOf(left);
    cuda::Stereo stereo(options, rig, left.width_px, left.height_px, planePrior);
    std::printf("%s: %d x %d, %.1f MB on the device\n", files[i].c_str(), left.width_px,
                left.height_px, static_cast<double>(stereo.deviceBytes()) / 1e6);
    stereo.upload(left, right);
    stereo.compute();
    all_equal = compare(stereo.download(), left, right, rig, options) && all_equal;
    if (!check_only) {
      time(stereo, left, right, repeats);
      all_equal = compare(stereo.download(), left, right, rig, options) && all_equal;
    }
    std::fflush(stdout);
  }
  return all_equal ? 0 : 1;
}

}  // namespace

namespace {

int usage() {
  std::fprintf(stderr,
               "usage: bench_cuda_stereo LEFT.pgm RIGHT.pgm [LEFT.pgm RIGHT.pgm ...] [--repeats N] "
               "[--rows] [--check]\n");
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
    if (argument == "--rows")
      options.elas.prior = PriorMethod::kRows;
    else if (argument == "--check")
      check_only = true;
    else if (argument == "--repeats" && i + 1 < argc)
      repeats = std::max(1, std::atoi(argv[++i]));
    else if (argument.rfind("--", 0) == 0)
      return usage();
    else
      files.push_back(argument);
  }
  if (files.empty() || files.size() % 2 != 0) return usage();
  try {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (!info.devices.empty())
      std::printf("%s, driver CUDA %s, runtime %s\n", info.devices.front().name.c_str(),
                  info.driver_version.c_str(), info.runtime_version.c_str());
    return run(files, options, repeats, check_only);
  } catch (const BackendError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
