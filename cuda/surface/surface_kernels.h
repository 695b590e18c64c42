// cuda/surface/surface_kernels.h: kernel bodies for the model's surface around a few positions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cuda/device/arena.h"
#include "cuda/device/kernel.h"
#include "cuda/model/model_layout.h"
#include "fusion/surface_formulas.h"

namespace softscope::cuda {

/// Most model points that a piece has on the device.
constexpr int kMostOfPiece = 1024;
constexpr int kPieceSums = 5;  // weight, height, normal

struct PieceOfSurface {
  double sums[kPieceSums];
  std::int32_t points;  // more than kMostOfPiece: the sums are of no use
  std::int32_t unused;
};

struct SurfaceLayout {
  SurfaceLayout() = default;
  SurfaceLayout(Arena& arena, std::size_t count)
      : positions_mm(arena.array<Eigen::Vector3d>(count)),
        targets_mm(arena.array<Eigen::Vector3f>(count)),
        counts(arena.array<std::int32_t>(count)),
        lists(arena.array<std::int32_t>(count * kMostOfPiece)),
        pieces(arena.array<PieceOfSurface>(count)),
        nearest(arena.array<unsigned long long>(count)) {}

  Eigen::Vector3d* positions_mm;
  Eigen::Vector3f* targets_mm;
  std::int32_t *counts, *lists;  // of the model points around each position, in any order
  PieceOfSurface* pieces;
  unsigned long long* nearest;  // squared distance and number of the nearest model point
};

/// One thread per model point and block of positions: adds it to the lists of those around it.
struct ListPieceKernel {
  static constexpr int kThreads = 256, kPhases = 2, kPositions = 128;
  struct Shared {
    float x[kPositions], y[kPositions], z[kPositions], limit_sq[kPositions];
  };
  using Local = Nothing;
  ModelArrays model;
  int points;
  SurfaceLayout surface;
  int positions;

  Grid blocks() const { return {blocksFor(points, kThreads), blocksFor(positions, kPositions), 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int first = at.y * kPositions;
    const int count = positions - first < kPositions ? positions - first : kPositions;
    if constexpr (kPhase == 0) {
      if (at.thread >= count) return;
      const Eigen::Vector3d& position_mm = surface.positions_mm[first + at.thread];
      const float x = static_cast<float>(position_mm[0]), y = static_cast<float>(position_mm[1]),
                  z = static_cast<float>(position_mm[2]);
      // More than the rounding of the coordinates: the exact test follows.
      const float largest = std::fmax(std::fabs(x), std::fmax(std::fabs(y), std::fabs(z)));
      const float limit = static_cast<float>(kSurfacePieceMm) * 1.001f + 1e-6f * largest;
      shared.x[at.thread] = x;
      shared.y[at.thread] = y;
      shared.z[at.thread] = z;
      shared.limit_sq[at.thread] = limit * limit;
    } else {
      const int i = at.x * kThreads + at.thread;
      if (i >= points) return;
      const Eigen::Vector3f point_mm = model.positions_mm[i];
      for (int k = 0; k < count; ++k) {
        const float x = point_mm[0] - shared.x[k], y = point_mm[1] - shared.y[k],
                    z = point_mm[2] - shared.z[k];
        if (x * x + (y * y + z * z) < shared.limit_sq[k]) add(i, first + k);
      }
    }
  }

 private:
  SOFTSCOPE_HD void add(int point, int position) const {
    SurfaceShare share;
    if (!surfaceShare(model.positions_mm[point], model.normals[point], model.weights[point],
                      surface.positions_mm[position], &share))
      return;
    const std::int32_t place = atomicPlus(&surface.counts[position], 1);
    if (place < kMostOfPiece)
      surface.lists[static_cast<std::size_t>(position) * kMostOfPiece +
                    static_cast<std::size_t>(place)] = point;
  }
};

/// One block per position: sums over its list, in the order of the model.
struct SumPieceKernel {
  static constexpr int kThreads = 128, kPhases = 4;
  struct Shared {
    std::int32_t listed[kMostOfPiece], sorted[kMostOfPiece];
    double shares[kPieceSums][kThreads];
    double sums[kPieceSums];
  };
  using Local = Nothing;
  ModelArrays model;
  SurfaceLayout surface;
  int positions;

  Grid blocks() const { return {positions, 1, 1}; }
  SOFTSCOPE_HD int repeats(const Place& at) const {
    const int count = countOf(at);
    return count > kThreads ? (count + kThreads - 1) / kThreads : 1;
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int count = countOf(at);
    if constexpr (kPhase == 0) {
      if (at.repeat > 0) return;
      const std::int32_t* list = surface.lists + static_cast<std::size_t>(at.x) * kMostOfPiece;
      for (int k = at.thread; k < count; k += kThreads) shared.listed[k] = list[k];
    } else if constexpr (kPhase == 1) {
      if (at.repeat > 0) return;
      for (int k = at.thread; k < count; k += kThreads) {
        const std::int32_t own = shared.listed[k];
        int rank = 0;
        for (int other = 0; other < count; ++other) rank += shared.listed[other] < own;
        shared.sorted[rank] = own;
      }
    } else if constexpr (kPhase == 2) {
      const int k = at.repeat * kThreads + at.thread;
      if (k >= count) return;
      const std::int32_t point = shared.sorted[k];
      SurfaceShare share;
      surfaceShare(model.positions_mm[point], model.normals[point], model.weights[point],
                   surface.positions_mm[at.x], &share);
      shared.shares[0][at.thread] = share.weight;
      shared.shares[1][at.thread] = share.height_mm;
      for (int c = 0; c < 3; ++c) shared.shares[2 + c][at.thread] = share.normal[c];
    } else {
      if (at.thread >= kPieceSums) return;
      const int first = at.repeat * kThreads;
      const int here = count - first < kThreads ? count - first : kThreads;
      double sum = at.repeat == 0 ? 0 : shared.sums[at.thread];
      for (int k = 0; k < here; ++k) sum += shared.shares[at.thread][k];
      shared.sums[at.thread] = sum;
      PieceOfSurface& piece = surface.pieces[at.x];
      piece.sums[at.thread] = sum;
      if (at.thread > 0) return;
      piece.points = surface.counts[at.x];
      piece.unused = 0;
    }
  }

 private:
  SOFTSCOPE_HD int countOf(const Place& at) const {
    const int count = surface.counts[at.x];
    return count < kMostOfPiece ? count : kMostOfPiece;
  }
};

/// One block per part of the model and position: the nearest point, of equally near ones the first.
struct NearestPointKernel {
  static constexpr int kThreads = 256, kPhases = 3, kEach = 16;
  struct Shared {
    unsigned long long nearest;
  };
  using Local = Nothing;
  ModelArrays model;
  int points;
  SurfaceLayout surface;
  int positions;

  static constexpr unsigned long long kNone = ~0ULL;
  Grid blocks() const { return {blocksFor(points, kThreads * kEach), positions, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared.nearest = kNone;
    } else if constexpr (kPhase == 1) {
      const Eigen::Vector3f target_mm = surface.targets_mm[at.y];
      unsigned long long own = kNone;
      for (int k = 0; k < kEach; ++k) {
        const int i = (at.x * kEach + k) * kThreads + at.thread;
        if (i >= points) break;
        const float distance = squaredDistance(model.positions_mm[i], target_mm);
        if (!(distance < std::numeric_limits<float>::max())) continue;
        // Bits of floats that are not negative have their order.
        const unsigned long long key = static_cast<unsigned long long>(floatAsBits(distance))
                                           << 32 |
                                       static_cast<std::uint32_t>(i);
        if (key < own) own = key;
      }
      if (own != kNone) atomicLeast(&shared.nearest, own);
    } else {
      if (at.thread == 0 && shared.nearest != kNone)
        atomicLeast(&surface.nearest[at.y], shared.nearest);
    }
  }
};

}  // namespace softscope::cuda
