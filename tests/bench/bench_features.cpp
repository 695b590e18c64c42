// tests/bench/bench_features.cpp: time and error of matching, as tables for docs/matching.md.
//   SOFTSCOPE_TEST_DATA=… build/release/tests/bench/bench_features
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>

#include "features/lift_matches.h"
#include "features/sequence_truth.h"
#include "pose/ransac_pose.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

/// Least wall and processor time (all threads) of three runs.
struct Times {
  double wall_ms = std::numeric_limits<double>::max(), processor_ms = wall_ms;
};

template <class Work>
Times timesOf(const Work& work) {
  Times least;
  for (int k = 0; k < 3; ++k) {
    const std::clock_t processor = std::clock();
    const auto wall = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - wall;
    least.wall_ms = std::min(least.wall_ms, elapsed.count());
    least.processor_ms = std::min(
        least.processor_ms, 1e3 * static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
  }
  return least;
}

struct Row {
  std::string name;
  MatcherOptions options;
  bool from_model_view;
};

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const bool view : {false, true})
    for (const char* method : {"dense-surf", "dis-flow", "sift"})
      for (const char* refinement : {"gauss-newton", "none"}) {
        const std::string m = method, r = refinement;
        if (m == "sift" && r != "none") continue;
        Row row{m + ", " + r, {}, view};
        row.options.method = m;
        row.options.subpixel.method = r;
        all.push_back(row);
      }
  return all;
}

ModelView viewOfFrame(const std::filesystem::path& folder, const SequenceTruth& truth, int frame) {
  const Eigen::Isometry3d pose = truth.poses[static_cast<std::size_t>(frame)].world_from_left;
  const auto depth = readDepth(folder / "groundtruth" / "depth" / (frameName(frame) + ".png"));
  return renderModelView(modelOfFrame(readLeft(folder, frame), depth, truth.camera, pose),
                         truth.camera, pose, {});
}

void printErrors(const char* name) {
  const auto folder = dataFolder(name);
  if (folder.empty()) return;
  const SequenceTruth truth(folder);
  std::printf(
      "\n%s\n| matched with the next frame | matches a frame | median px | P95 px | > 1 px %% | "
      "median error / sigma | processor ms |\n|---|---|---|---|---|---|---|\n",
      name);
  for (const Row& row : rows()) {
    FlowErrors errors;
    double processor_ms = 0;
    int frames = 0;
    const auto matcher = makeFeatureMatcher(row.options);
    for (int frame = 0; frame + 1 < truth.frames(); frame += 5, ++frames) {
      const MatchPicture model = row.from_model_view ? pictureOf(viewOfFrame(folder, truth, frame))
                                                     : pictureOf(readLeft(folder, frame));
      const MatchPicture live = pictureOf(readLeft(folder, frame + 1));
      const std::clock_t begin = std::clock();
      errors.add(matcher->match(model, live), TrueFlow(truth, frame, frame + 1));
      processor_ms += 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }
    std::printf("| %s: %s | %zu | %.3f | %.3f | %.2f | %.2f | %.0f |\n",
                row.from_model_view ? "model view" : "frame", row.name.c_str(),
                errors.matches / static_cast<std::size_t>(frames),
                FlowErrors::quantile(errors.error_px, 0.5),
                FlowErrors::quantile(errors.error_px, 0.95), 100 * errors.outlierShare(),
                FlowErrors::quantile(errors.in_sigmas, 0.5), processor_ms / frames);
  }
}

/// Counts of one matcher, a pair of neighbouring frames each.
struct MatchCounts {
  const char* name;
  std::unique_ptr<FeatureMatcher> matcher;
  std::vector<double> counts;

  void print() const {
    std::printf("| %s | %.0f | %.0f | %.0f |", name, FlowErrors::quantile(counts, 0),
                FlowErrors::quantile(counts, 0.5), FlowErrors::quantile(counts, 1));
    for (const double count : counts) std::printf(" %.0f", count);
    std::printf(" |\n");
  }
};

/// Every frame against the next one; `frames` of them, numbered from 0.
void printMatchCounts(const char* name, int frames) {
  const auto folder = dataFolder(name);
  if (folder.empty()) return;
  const auto pictureAt = [&](int frame) {
    const auto mask = folder / "mask" / (frameName(frame) + ".png");
    return pictureOf(readLeft(folder, frame), exists(mask) ? readMask(mask) : Mask());
  };
  MatcherOptions sift;
  sift.method = "sift";
  MatchCounts dense{"dense-surf", makeFeatureMatcher({}), {}},
      sparse{"sift", makeFeatureMatcher(sift), {}};
  double least_factor = std::numeric_limits<double>::max();
  MatchPicture before = pictureAt(0);
  for (int frame = 1; frame < frames; ++frame) {
    const MatchPicture after = pictureAt(frame);
    for (MatchCounts* one : {&dense, &sparse})
      one->counts.push_back(double(one->matcher->match(before, after).size()));
    least_factor =
        std::min(least_factor, dense.counts.back() / std::max(1.0, sparse.counts.back()));
    before = after;
  }
  std::printf(
      "\n%s, %d pairs; dense SURF finds at least %.1f times as many\n"
      "| matches | least | median | most | pair by pair |\n|---|---|---|---|---|\n",
      name, frames - 1, least_factor);
  dense.print();
  sparse.print();
}

void printStages(const char* name) {
  const auto folder = dataFolder(name);
  if (folder.empty()) return;
  const SequenceTruth truth(folder);
  const ColourImage colour = readLeft(folder, 0);
  const auto depth = readDepth(folder / "groundtruth" / "depth" / "000000.png");
  const Eigen::Isometry3d pose = truth.poses[0].world_from_left;
  const PointModel points = modelOfFrame(colour, depth, truth.camera, pose);
  const ModelView view = renderModelView(points, truth.camera, pose, {});
  const MatchPicture model = pictureOf(view), live = pictureOf(readLeft(folder, 1));
  const auto matcher = makeFeatureMatcher({});
  const auto matches = matcher->match(model, live);
  const DepthMap live_depth{depth, {}};
  const auto lifted = liftMatches(matches, view, live_depth, truth.camera);
  PointPairs pairs;
  for (const LiftedMatch& match : lifted) {
    pairs.sources_mm.push_back(match.target_left_mm);
    pairs.targets_mm.push_back(match.source_world_mm);
  }
  std::printf("\n%s, %zu points\n| stage | wall ms | processor ms |\n|---|---|---|\n", name,
              points.size());
  const auto line = [](const char* stage, const Times& t) {
    std::printf("| %s | %.1f | %.1f |\n", stage, t.wall_ms, t.processor_ms);
  };
  line("model view", timesOf([&] { renderModelView(points, truth.camera, pose, {}); }));
  line("dense SURF, one picture", timesOf([&] { denseSurf(live.gray, live.ignore, {}); }));
  line("matching, all", timesOf([&] { matcher->match(model, live); }));
  line("highlights", timesOf([&] { highlightMask(colour); }));
  line("lifting", timesOf([&] { liftMatches(matches, view, live_depth, truth.camera); }));
  line("rigid pose", timesOf([&] { estimateRigidPose(pairs, {}); }));
}

}  // namespace
}  // namespace softscope::test

int main() {
  for (const char* name : {"openhelp_heart", "openhelp_kidney_small"}) {
    softscope::test::printStages(name);
    softscope::test::printErrors(name);
  }
  softscope::test::printMatchCounts("endonerf_pulling", 63);
  softscope::test::printMatchCounts("openhelp_heart", 40);
  softscope::test::printMatchCounts("openhelp_kidney_small", 40);
}
