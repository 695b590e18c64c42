// cuda/match/match_surf.h: kernel bodies of dense SURF.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "features/surf_formulas.h"

namespace softscope::cuda {

/// 64 bytes in the order of DenseDescriptors.
struct alignas(16) Descriptor {
  struct alignas(16) Quarter {
    std::uint32_t words[4];
  };
  Quarter quarters[4];
};
SOFTSCOPE_HD inline std::uint32_t quarterDistance(const Descriptor::Quarter& a,
                                                  const Descriptor::Quarter& b, std::uint32_t sum) {
  for (int k = 0; k < 4; ++k) sum = byteDifferences(a.words[k], b.words[k], sum);
  return sum;
}

/// Descriptors of one image, node by node.
struct SurfNodes {
  int columns = 0, rows = 0;
  Descriptor* descriptors = nullptr;
  std::uint8_t* valid = nullptr;

  SOFTSCOPE_HD int at(int column, int row) const { return row * columns + column; }
};

/// Sums of the wavelets of one grid square.
struct alignas(16) SurfSquare {
  std::int32_t sums[kSurfSums];
};
struct SurfSquares {
  int columns = 0, rows = 0;
  SurfSquare* sums = nullptr;
  std::int32_t* valid = nullptr;
};

/// One thread per grid square; z: model, live.
struct SurfSquaresBody {
  static constexpr int kGrid = DenseSurfOptions::kGridPx, kWavelet = DenseSurfOptions::kWaveletPx;
  static constexpr int kHalf = kWavelet / 2, kSide = kGrid + kWavelet - 1;
  View<const std::uint8_t> gray[2], ignore[2];
  SurfSquares squares[2];

  SOFTSCOPE_HD void operator()(int column, int row, int image) const {
    int pixels[kSide][kSide], ignored[kSide][kSide];
    const int u0 = column * kGrid - kHalf, v0 = row * kGrid - kHalf;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const bool inside = gray[image].contains(u0 + x, v0 + y);
        pixels[y][x] = inside ? gray[image].at(u0 + x, v0 + y) : 0;
        ignored[y][x] = inside ? ignore[image].at(u0 + x, v0 + y) : 1;
      }
    SurfSquare sums{};
    int valid = 0;
    for (int y = 0; y < kGrid; ++y) {
      int all[kSide], upper[kSide], marked[kSide];
      for (int x = 0; x < kSide; ++x) {
        all[x] = upper[x] = marked[x] = 0;
        for (int k = 0; k < kWavelet; ++k) {
          all[x] += pixels[y + k][x];
          if (k < kHalf) upper[x] += pixels[y + k][x];
          marked[x] |= ignored[y + k][x];
        }
      }
      for (int x = 0; x < kGrid; ++x) addWavelet(all + x, upper + x, marked + x, &sums, &valid);
    }
    const int at = row * squares[image].columns + column;
    squares[image].sums[at] = sums;
    squares[image].valid[at] = valid;
  }

 private:
  /// From sums of its columns. A wavelet that exceeds the image counts as ignored.
  SOFTSCOPE_HD static void addWavelet(const int* all, const int* upper, const int* marked,
                                      SurfSquare* sums, int* valid) {
    int whole = 0, left = 0, above = 0, ignored = 0;
    for (int k = 0; k < kWavelet; ++k) {
      whole += all[k];
      if (k < kHalf) left += all[k];
      above += upper[k];
      ignored |= marked[k];
    }
    if (ignored != 0) return;
    const int du = haarResponse(whole, left), dv = haarResponse(whole, above);
    sums->sums[0] += du;
    sums->sums[1] += du < 0 ? -du : du;
    sums->sums[2] += dv;
    sums->sums[3] += dv < 0 ? -dv : dv;
    ++*valid;
  }
};

/// One thread per node; one block: 16 x 8 nodes; z: model, live.
struct DescribeKernel {
  static constexpr int kWidth = 16, kHeight = 8, kThreads = kWidth * kHeight, kPhases = 3;
  static constexpr int kReach = 2;  // grid squares per side of a cell
  static constexpr int kLost = (kSurfCells - 1) * kReach;
  static constexpr int kCellColumns = kWidth + kLost, kCellRows = kHeight + kLost;
  static constexpr int kSquareColumns = kCellColumns + kReach - 1,
                       kSquareRows = kCellRows + kReach - 1;
  struct alignas(16) Cell {
    float sums[kSurfSums];
  };
  struct Shared {
    SurfSquare squares[kSquareRows][kSquareColumns];
    Cell cells[kCellRows][kCellColumns];
    int valid_squares[kSquareRows][kSquareColumns], valid_cells[kCellRows][kCellColumns];
  };
  using Local = Nothing;
  SurfSquares squares[2];
  SurfNodes nodes[2];
  SurfRules rules;

  Grid blocks() const {
    return {blocksFor(nodes[0].columns, kWidth), blocksFor(nodes[0].rows, kHeight), 2};
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < kSquareColumns * kSquareRows; i += kThreads)
        load(at, i % kSquareColumns, i / kSquareColumns, shared);
    } else if constexpr (kPhase == 1) {
      for (int i = at.thread; i < kCellColumns * kCellRows; i += kThreads)
        sumCell(i % kCellColumns, i / kCellColumns, shared);
    } else {
      const int x = at.thread % kWidth, y = at.thread / kWidth;
      const int column = at.x * kWidth + x, row = at.y * kHeight + y;
      if (column < nodes[at.z].columns && row < nodes[at.z].rows)
        describe(x, y, nodes[at.z].at(column, row), nodes[at.z], shared);
    }
  }

 private:
  SOFTSCOPE_HD void load(const Place& at, int x, int y, Shared& shared) const {
    const SurfSquares& from = squares[at.z];
    const int column = at.x * kWidth + x, row = at.y * kHeight + y;
    const bool inside = column < from.columns && row < from.rows;
    const int place = row * from.columns + column;
    shared.squares[y][x] = inside ? from.sums[place] : SurfSquare{};
    shared.valid_squares[y][x] = inside ? from.valid[place] : 0;
  }
  SOFTSCOPE_HD static void sumCell(int x, int y, Shared& shared) {
    std::int32_t sums[kSurfSums] = {};
    int valid = 0;
    for (int k = 0; k < kReach * kReach; ++k) {
      const SurfSquare& square = shared.squares[y + k / kReach][x + k % kReach];
      for (int s = 0; s < kSurfSums; ++s) sums[s] += square.sums[s];
      valid += shared.valid_squares[y + k / kReach][x + k % kReach];
    }
    for (int s = 0; s < kSurfSums; ++s) shared.cells[y][x].sums[s] = static_cast<float>(sums[s]);
    shared.valid_cells[y][x] = valid;
  }
  SOFTSCOPE_HD void describe(int x, int y, int node, const SurfNodes& out,
                             const Shared& shared) const {
    float lanes[8] = {}, absolute = 0;
    int valid = 0;
    for (int i = 0; i < kSurfCells; ++i)
      for (int j = 0; j < kSurfCells; ++j) {
        const Cell& cell = shared.cells[y + i * kReach][x + j * kReach];
        for (int s = 0; s < kSurfSums; ++s) lanes[4 * (j % 2) + s] += cell.sums[s] * cell.sums[s];
        absolute += cell.sums[1] + cell.sums[3];
        valid += shared.valid_cells[y + i * kReach][x + j * kReach];
      }
    const float scale = descriptorScale(std::sqrt(sumOfLanes(lanes)));
    Descriptor bytes;
    for (int i = 0; i < kSurfCells; ++i)
      for (int j = 0; j < kSurfCells; ++j) {
        const Cell& cell = shared.cells[y + i * kReach][x + j * kReach];
        std::uint32_t word = 0;
        for (int s = 0; s < kSurfSums; ++s)
          word |= static_cast<std::uint32_t>(descriptorByte(cell.sums[s], scale)) << (8 * s);
        bytes.quarters[i].words[j] = word;
      }
    out.descriptors[node] = bytes;
    out.valid[node] = isDistinct(valid, absolute * rules.gray_per_sum, rules) ? 1 : 0;
  }
};

}  // namespace softscope::cuda
