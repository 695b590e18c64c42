// tests/bench/bench_deform.cpp: time and error of deformation, as tables for docs/benchmarks.md.
//   build/release/tests/bench/bench_deform [frames|solves|growth]
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>

#include "core/parallel.h"
#include "deform/cholesky/block_cholesky.h"
#include "deform/graph/warp.h"
#include "deform/scenes.h"
#include "deform/solver/lm_solver.h"

namespace softscope {
namespace {

template <class Work>
double bestMs(int times, const Work& work) {
  double best = 1e9;
  for (int i = 0; i < times; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

/// A third of the tests' bend: about what tissue does from frame to frame.
Eigen::Vector3d frameMotion(const Eigen::Vector3d& p) {
  return p + (scenes::smoothBend(p) - p) / 3;
}

struct FrameCase {
  const char* name;
  int width_px, height_px;
  double f_px;
  double model_width_mm, model_height_mm;
  int max_points;
};

DeformSummary bestOf(DeformSolver* solver, const PointModel& model, const DeformObservation& seen,
                     const WarpGraph& start, WarpGraph* graph, double* total_ms) {
  DeformSummary best;
  *total_ms = 1e9;
  for (int i = 0; i < 5; ++i) {
    WarpGraph trial = start;
    DeformSummary summary;
    const double ms = bestMs(1, [&] { summary = solver->solve(model, seen, &trial); });
    if (ms >= *total_ms) continue;
    *total_ms = ms;
    best = summary;
    *graph = trial;
  }
  return best;
}

void printFrame(const FrameCase& c, const char* label, DeformOptions options) {
  PointModel model = scenes::makeHill(c.model_width_mm, c.model_height_mm, 0.2);
  const WarpGraph start = scenes::bindGraph(&model);
  const auto view = scenes::renderHill(scenes::makeCamera(c.width_px, c.height_px, c.f_px),
                                       frameMotion, c.model_width_mm, c.model_height_mm);
  options.association.max_points = c.max_points;
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  DeformObservation seen;
  seen.surface = &target;
  seen.matches = scenes::makeMatches(model, frameMotion, 80);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const auto solver = makeDeformSolver(options);
    WarpGraph graph;
    double total_ms = 0;
    const DeformSummary s = bestOf(solver.get(), model, seen, start, &graph, &total_ms);
    PointModel warped = model;
    const double warp_ms = bestMs(5, [&] {
      warped = model;
      warpModel(graph, &warped);
    });
    std::printf(
        "| %s, %s | %d | %d of %zu | %zu | %d | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | "
        "%.3f |\n",
        c.name, label, threads, s.points_after, model.size(), graph.size(), s.iterations,
        s.times.prepare_ms, s.times.associate_ms, s.times.evaluate_ms, s.times.assemble_ms,
        s.times.factor_ms, warp_ms, total_ms + warp_ms,
        scenes::meanError(model, warped, frameMotion));
  }
}

void printFrames() {
  std::printf(
      "| frame | threads | points pulled | nodes | steps | prepare ms | associate | evaluate | "
      "assemble | factor, solve | warp | all ms | mean error mm |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const FrameCase cases[] = {{"360x288", 360, 288, 380, 57, 45, 0},
                             {"640x480", 640, 480, 560, 69, 51, 0},
                             {"640x480, larger model", 640, 480, 560, 100, 75, 0},
                             {"640x480, larger model, 20 k points", 640, 480, 560, 100, 75, 20000}};
  for (const FrameCase& c : cases) printFrame(c, "rigid", DeformOptions());
  for (const FrameCase& c : cases) printFrame(c, "affine, paper", DeformOptions::paper());
}

/// Diagonally dominant numbers on the pattern of a real graph.
std::vector<double> randomBlocks(const BlockPattern& pattern, int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<double> values;
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b) {
      Eigen::MatrixXd block = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return value(random); });
      if (pattern.row[b] == j) block = (block + block.transpose()).eval();
      if (pattern.row[b] == j) block.diagonal().array() += 30 * n;
      values.insert(values.end(), block.data(), block.data() + n * n);
    }
  return values;
}

double eigenMs(const BlockPattern& pattern, const std::vector<double>& values, int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b)
      for (int c = 0; c < n; ++c)
        for (int r = 0; r < n; ++r)
          entries.emplace_back(pattern.row[b] * n + r, j * n + c,
                               values[static_cast<std::size_t>(b) * n * n + c * n + r]);
  Eigen::SparseMatrix<double> matrix(pattern.nodes() * n, pattern.nodes() * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver;
  solver.analyzePattern(matrix);
  const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(matrix.rows());
  Eigen::VectorXd x;
  return bestMs(3, [&] {
    solver.factorize(matrix);
    x = solver.solve(rhs);
  });
}

void printSolves() {
  std::printf(
      "| nodes | unknowns | analyse ms | factor, solve, 1 thread | 2 threads | Eigen LDLT | "
      "Gmultiply-adds | MB |\n|---|---|---|---|---|---|---|---|\n");
  for (const double width_mm : {45.0, 66.0, 96.0, 140.0}) {
    PointModel model = scenes::makeHill(width_mm, 0.75 * width_mm, 0.4);
    const BlockPattern pattern = makeBlockPattern(scenes::bindGraph(&model));
    for (const int n : {6, 12}) {
      const std::vector<double> values = randomBlocks(pattern, n);
      const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(pattern.nodes() * n);
      BlockCholesky cholesky;
      const double analyse_ms = bestMs(2, [&] { cholesky.analyse(pattern, n); });
      double solve_ms[2];
      for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        Eigen::VectorXd x;
        solve_ms[threads - 1] = bestMs(10, [&] {
          if (cholesky.factor(values, {})) x = cholesky.solve(rhs);
        });
      }
      std::printf("| %d | %d | %.1f | %.1f | %.1f | %.1f | %.3f | %.1f |\n", pattern.nodes(), n,
                  analyse_ms, solve_ms[0], solve_ms[1], eigenMs(pattern, values, n),
                  cholesky.operations() / 1e9, static_cast<double>(cholesky.storedBytes()) / 1e6);
    }
  }
}

/// Best of some runs, each from the same model and graph.
double growthMs(int threads, PointModel* model, WarpGraph* graph, GraphGrowth* growth) {
  const ThreadLimit limit(threads);
  const PointModel model_before = *model;
  const WarpGraph graph_before = *graph;
  double best_ms = 1e9;
  for (int run = 0; run < 15; ++run) {
    *model = model_before;
    *graph = graph_before;
    best_ms =
        std::min(best_ms, bestMs(1, [&] { *growth = growGraph(GraphOptions(), model, graph); }));
  }
  return best_ms;
}

void printGrowthOf(const PointModel& model, std::size_t before, WarpGraph* graph,
                   PointModel* grown) {
  GraphGrowth growth;
  const WarpGraph start = *graph;
  *grown = model;
  const double one_ms = growthMs(1, grown, graph, &growth);
  *grown = model;
  *graph = start;
  const double two_ms = growthMs(2, grown, graph, &growth);
  std::printf("| %zu | %zu | %d | %.1f | %.1f |\n", model.size(), model.size() - before,
              growth.nodes_added, one_ms, two_ms);
}

void printGrowth() {
  std::printf("| model points | new points | new nodes | 1 thread ms | 2 threads ms |\n");
  std::printf("|---|---|---|---|---|\n");
  const PointModel whole = scenes::makeHill(90, 60, 0.2);
  PointModel model;
  WarpGraph graph;
  double last_mm = -1e9;
  const auto add = [&](std::size_t i) {
    model.add(whole.positions_mm[i], whole.normals[i], whole.colours[i], 1);
  };
  for (const double edge_mm : {30.0, 31.0, 35.0}) {
    const std::size_t before = model.size();
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const float x = whole.positions_mm[i].x();
      if (x > last_mm && x <= edge_mm) add(i);
    }
    last_mm = edge_mm;
    const PointModel unbound = model;
    printGrowthOf(unbound, before, &graph, &model);
  }
  // As a model's second frame: points all over it that no node carries yet.
  const std::size_t before = model.size();
  for (std::size_t i = 0; i < before; i += 5)
    model.add(model.positions_mm[i], model.normals[i], model.colours[i], 1);
  const PointModel unbound = model;
  printGrowthOf(unbound, before, &graph, &model);
}

}  // namespace
}  // namespace softscope

int main(int argc, char** argv) {
  const auto asked = [&](const char* what) { return argc < 2 || std::strcmp(argv[1], what) == 0; };
  if (asked("frames")) softscope::printFrames();
  if (asked("solves")) softscope::printSolves();
  if (asked("growth")) softscope::printGrowth();
}
