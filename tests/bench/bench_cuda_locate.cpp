// tests/bench/bench_cuda_locate.cpp: model view and matching on the GPU: equal to the CPU, and how
// long.
//
// bench_cuda_locate LEFT.pgm RIGHT.pgm NEXT.pgm [LEFT.pgm RIGHT.pgm NEXT.pgm …] [--repeats N]
//   [--stride N] [--check]
// Binary 8-bit PGM, rectified, rows aligned. The depth of LEFT and RIGHT gives a model, whose view
// is matched with NEXT, a later left image. --stride: one point every N pixels (2). --check
// compares alone, for compute-sanitizer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "cuda/locate/locate.h"
#include "cuda/match/match.h"
#include "cuda/view/view.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/matching/elas_matcher.h"
#include "tests/bench/cuda_bench.h"

using namespace softscope;
using namespace softscope::bench;

namespace {

/// A scene: its model, the current camera pose, and the visible part.
struct Scene {
  PinholeCamera camera;
  PointModel model;
  ModelViewOptions view_options;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  MatchPicture live;
  DepthMap live_depth;  // that of the earlier pair
};

/// Points of every `stride`-th pixel in u and v.
Scene sceneOf(const std::string* files, int stride) {
  const GrayImage left = readPgm(files[0]), right = readPgm(files[1]);
  const RectifiedRig rig = rigOf(left);
  Scene scene;
  scene.camera = rig.left;
  scene.live = {readPgm(files[2]), Mask(left.width_px, left.height_px, 0)};
  const DepthMap depth = depthFromDisparity(ElasMatcher(StereoOptions()).match(left, right), rig);
  const NormalMap normals = normalsFromDepth(depth.depth_mm, rig.left);
  scene.live_depth = depth;
  std::vector<float> depths_mm;
  for (int v = 0; v < left.height_px; v += stride)
    for (int u = 0; u < left.width_px; u += stride) {
      const float z = depth.depth_mm.at(u, v);
      if (!(z > 0) || !normals.at(u, v).allFinite()) continue;
      const std::uint8_t gray = left.at(u, v);
      scene.model.add(liftPixel<float>(rig.left, static_cast<float>(u), static_cast<float>(v), z),
                      normals.at(u, v), {gray, gray, gray}, 1);
      depths_mm.push_back(z);
    }
  if (depths_mm.empty()) throw InputError(files[0] + ": no depth");
  std::nth_element(depths_mm.begin(), depths_mm.begin() + depths_mm.size() / 2, depths_mm.end());
  const double depth_mm = depths_mm[depths_mm.size() / 2];
  scene.view_options.point_spacing_mm = stride * depth_mm / rig.left.fx_px;
  scene.pose.translation() = Eigen::Vector3d(0.004, -0.003, 0.002) * depth_mm;
  return scene;
}

/// Prints how many pixels and matches differ; returns whether none does.
bool compare(const Scene& scene, const ModelView& view, const std::vector<PixelMatch>& matches,
             const MatchPicture& picture) {
  const double start = nowMs();
  const ModelView cpu = renderModelView(scene.model, scene.camera, scene.pose, scene.view_options);
  const double drawn = nowMs();
  const auto matcher = makeFeatureMatcher(MatcherOptions());
  const std::vector<PixelMatch> expected = matcher->match(picture, scene.live);
  const double matched = nowMs();
  long pixels = 0, seen = 0, differ = 0;
  for (std::size_t i = 0; i < cpu.colour.size(); ++i) {
    const float a = cpu.depth_mm.values[i], b = view.depth_mm.values[i];
    seen += a > 0;
    pixels += !(cpu.colour.values[i] == view.colour.values[i]) ||
              cpu.anchor.values[i] != view.anchor.values[i] ||
              cpu.point_index.values[i] != view.point_index.values[i] ||
              (std::memcmp(&a, &b, sizeof a) != 0 && !(std::isnan(a) && std::isnan(b)));
  }
  for (std::size_t i = 0; i < std::min(matches.size(), expected.size()); ++i)
    differ += matches[i].model_px != expected[i].model_px ||
              matches[i].live_px != expected[i].live_px ||
              matches[i].sigma_px != expected[i].sigma_px ||
              matches[i].similarity != expected[i].similarity;
  std::printf(
      "  differ from the CPU's: %ld of %ld pixels seen, %ld of %zu matches (CPU: %zu); CPU %.1f "
      "and "
      "%.1f ms\n",
      pixels, seen, differ, matches.size(), expected.size(), drawn - start, matched - drawn);
  return pixels == 0 && differ == 0 && matches.size() == expected.size();
}

/// Prints how many lifted matches differ; returns whether none does.
bool compareLifted(const Scene& scene, const cuda::LocatedMatches& found, const ModelView& view) {
  const std::vector<LiftedMatch> expected =
      liftMatches(found.pixels, view, scene.live_depth, scene.camera);
  long differ = 0;
  for (std::size_t i = 0; i < std::min(found.lifted.size(), expected.size()); ++i) {
    const LiftedMatch &a = found.lifted[i], &b = expected[i];
    differ += a.model_point != b.model_point || a.match != b.match ||
              a.source_world_mm != b.source_world_mm || a.target_left_mm != b.target_left_mm ||
              a.across_mm != b.across_mm ||
              (a.along_mm != b.along_mm && !(std::isnan(a.along_mm) && std::isnan(b.along_mm)));
  }
  std::printf("  differ from the CPU's: %ld of %zu lifted (CPU: %zu)\n", differ,
              found.lifted.size(), expected.size());
  return differ == 0 && found.lifted.size() == expected.size();
}

/// Times of `work` that waits, after some that warm up.
template <class Work>
std::vector<double> timesOf(int repeats, const Work& work) {
  std::vector<double> times_ms;
  for (int i = 0; i < repeats + 20; ++i) {
    const double start = nowMs();
    work();
    if (i >= 20) times_ms.push_back(nowMs() - start);
  }
  return times_ms;
}

void time(cuda::ModelRenderer& renderer, cuda::Matcher& matcher, cuda::Locator& locator,
          const Scene& scene, const MatchPicture& picture, int repeats) {
  print("view: draw, wait", timesOf(repeats, [&] {
          renderer.draw(scene.pose);
          renderer.wait();
        }));
  printStages(renderer, [&] { renderer.draw(scene.pose); });
  matcher.upload(picture, scene.live);
  matcher.wait();
  print("match: compute, wait", timesOf(repeats, [&] {
          matcher.compute();
          matcher.wait();
        }));
  print("match: upload, compute, download",
        timesOf(repeats / 4, [&] { matcher.match(picture, scene.live); }));
  printStages(matcher, [&] { matcher.compute(); });
  print("locate: view, match, lift, wait", timesOf(repeats, [&] {
          locator.locate(scene.pose);
          locator.wait();
        }));
  print("locate and download", timesOf(repeats / 4, [&] {
          locator.locate(scene.pose);
          locator.download();
        }));
}

int run(const std::vector<std::string>& files, int stride, int repeats, bool check_only) {
  bool all_equal = true;
  for (std::size_t i = 0; i + 2 < files.size(); i += 3) {
    const Scene scene = sceneOf(&files[i], stride);
    cuda::ModelRenderer renderer(scene.camera, scene.view_options,
                                 static_cast<int>(scene.model.size()));
    cuda::Matcher matcher(MatcherOptions(), scene.camera.width_px, scene.camera.height_px);
    std::printf("%s: %d x %d, %zu points, %.1f and %.1f MB on the device\n", files[i].c_str(),
                scene.camera.width_px, scene.camera.height_px, scene.model.size(),
                static_cast<double>(renderer.deviceBytes()) / 1e6,
                static_cast<double>(matcher.deviceBytes()) / 1e6);
    renderer.upload(scene.model);
    renderer.draw(scene.pose);
    const ModelView view = renderer.download();
    MatchPicture picture{toGray(view.colour), Mask(view.colour.width_px, view.colour.height_px, 0),
                         view.anchor};
    for (std::size_t k = 0; k < picture.ignore.size(); ++k)
      picture.ignore.values[k] = view.point_index.values[k] < 0;
    all_equal = compare(scene, view, matcher.match(picture, scene.live), picture) && all_equal;
    cuda::Locator locator(scene.camera, scene.view_options, MatcherOptions(),
                          static_cast<int>(scene.model.size()));
    locator.setModel(scene.model);
    locator.setLive(scene.live, scene.live_depth);
    locator.locate(scene.pose);
    all_equal = compareLifted(scene, locator.download(), view) && all_equal;
    if (!check_only) {
      time(renderer, matcher, locator, scene, picture, repeats);
      all_equal =
          compare(scene, renderer.download(), matcher.match(picture, scene.live), picture) &&
          all_equal;
    }
    std::fflush(stdout);
  }
  return all_equal ? 0 : 1;
}

int usage() {
  std::fprintf(stderr,
               "usage: bench_cuda_locate LEFT.pgm RIGHT.pgm NEXT.pgm [...] [--repeats N] "
               "[--stride N] [--check]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  int repeats = 400, stride = 2;
  bool check_only = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--check")
      check_only = true;
    else if (argument == "--repeats" && i + 1 < argc)
      repeats = std::max(4, std::atoi(argv[++i]));
    else if (argument == "--stride" && i + 1 < argc)
      stride = std::max(1, std::atoi(argv[++i]));
    else if (argument.rfind("--", 0) == 0)
      return usage();
    else
      files.push_back(argument);
  }
  if (files.empty() || files.size() % 3 != 0) return usage();
  return bench::onDevice([&] { return run(files, stride, repeats, check_only); });
}
