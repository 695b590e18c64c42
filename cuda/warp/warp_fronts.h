// cuda/warp/warp_fronts.h: kernel bodies of the multifrontal Cholesky factorisation, level by
// level.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/warp/warp_layout.h"

namespace softscope::cuda {

constexpr int kMostColumns = kMostPivots * kUnknowns;

/// Place of an entry of a front's inverse of L^T in its pivots.
SOFTSCOPE_HD inline std::ptrdiff_t inverseAt(const FrontShape& front, int row, int column) {
  return static_cast<std::ptrdiff_t>(front.first * kUnknowns + column) * kMostColumns + row;
}

/// One thread per row and node of the pivots of a front: entries of the matrix,
/// damped, and updates of the children. The right-hand side is the last row.
struct AssembleFrontsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  WarpStructureLayout graph;
  int first_front;
  double damping, floor;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const FrontShape front = graph.fronts[first_front + at.y];
    const int rows = front.blocks * kUnknowns + 1, i = at.x * kThreads + at.thread;
    const int node = i / rows, r = i % rows;
    if (node >= front.pivots || r < node * kUnknowns) return;
    double row[kUnknowns];
    addMatrix(front, r, node, row);
    for (int c = front.child_begin; c < front.child_end; ++c)
      addChild(front, graph.children[c], r, node, row);
    double* to = graph.factor + front.factor + r +
                 static_cast<std::ptrdiff_t>(node * kUnknowns) * front.factor_leading;
    for (int j = 0; j < kUnknowns; ++j)
      to[static_cast<std::ptrdiff_t>(j) * front.factor_leading] = row[j];
  }

 private:
  SOFTSCOPE_HD void addMatrix(const FrontShape& front, int r, int block_column,
                              double (&row)[kUnknowns]) const {
    const int block_row = r / kUnknowns, i = r % kUnknowns;
    if (block_row == front.blocks) {
      const int node = graph.front_nodes[front.nodes + block_column];
      for (int j = 0; j < kUnknowns; ++j) row[j] = graph.gradient[node * kUnknowns + j];
      return;
    }
    const int entry = graph.look_up[front.look_up + block_column * front.blocks + block_row];
    const int number = entry > 0 ? entry - 1 : entry < 0 ? -entry - 1 : 0;
    const double* block = graph.matrix + number * std::ptrdiff_t{kBlockEntries};
    for (int j = 0; j < kUnknowns; ++j) {
      const double value = block[entry > 0 ? i + kUnknowns * j : j + kUnknowns * i];
      row[j] = entry == 0 ? 0 : value;
    }
    if (block_row == block_column)
      for (int j = 0; j < kUnknowns; ++j) row[j] = row[j] * (1 + damping) + (i == j ? floor : 0);
  }
  SOFTSCOPE_HD void addChild(const FrontShape& front, const FrontChild& link, int r,
                             int block_column, double (&row)[kUnknowns]) const {
    const FrontShape child = graph.fronts[link.front];
    const int block_row = r / kUnknowns;
    const int from_column = graph.maps[link.map + block_column];
    const int from_row =
        block_row == front.blocks ? child.blocks - child.pivots : graph.maps[link.map + block_row];
    if (from_column < 0 || from_row < 0) return;
    const double* update =
        graph.updates + child.update + from_row * kUnknowns + r % kUnknowns +
        static_cast<std::ptrdiff_t>(from_column * kUnknowns) * child.update_leading;
    for (int j = 0; j < kUnknowns; ++j)
      row[j] += update[static_cast<std::ptrdiff_t>(j) * child.update_leading];
  }
};

/// Pivot columns of the fronts of a level, six at a time, left-looking. Every block of a front has
/// all rows of its pivots, and some of those below: none waits for another. A thread has one row.
/// Below are the border and the unit matrix, which becomes the inverse of L^T: with it, the
/// solution takes products alone.
struct FactorFrontsKernel {
  static constexpr int kThreads = 128, kPhases = 2, kBorderRows = kThreads - kMostColumns;
  struct Shared {
    alignas(16) double triangle[kMostColumns][kMostColumns];  // rows of the pivots, by columns
    alignas(16) double corner[kUnknowns][kUnknowns];
  };
  struct Local {
    alignas(16) double own[kMostColumns];
  };
  WarpStructureLayout graph;
  int first_front;

  static int blocks(const FrontShape& front) { return blocksFor(rowsBelow(front), kBorderRows); }
  SOFTSCOPE_HD int repeats(const Place& at) const {
    const FrontShape front = graph.fronts[first_front + at.x];
    return at.y * kBorderRows < rowsBelow(front) ? front.pivots : 0;
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const FrontShape front = graph.fronts[first_front + at.x];
    const int column = at.repeat * kUnknowns, pivots = front.pivots * kUnknowns;
    const int r = rowOf(front, at), unit = r - rowsStored(front);  // row of the unit matrix, from 0
    double* base = graph.factor + front.factor + (r < 0 || unit >= 0 ? 0 : r);
    const std::ptrdiff_t leading = front.factor_leading;
    if constexpr (kPhase == 0) {
      if (at.repeat == 0) {
        const int known = r < 0 ? 0 : r < pivots ? (r / kUnknowns + 1) * kUnknowns : pivots;
        SOFTSCOPE_UNROLL(6)
        for (int k = 0; k < known; ++k)
          local.own[k] = unit < 0 ? base[k * leading] : k == unit ? 1 : 0;
      }
      if (r < column || unit >= column + kUnknowns) return;
      double row[kUnknowns];
      for (int j = 0; j < kUnknowns; ++j) row[j] = local.own[column + j];
      for (int first = 0; first < column; first += kUnknowns) SOFTSCOPE_UNROLL(6)
      for (int k = first; k < first + kUnknowns; ++k) {
        const double value = local.own[k];
        for (int j = 0; j < kUnknowns; ++j)
          row[j] = multiplyAdd(-value, shared.triangle[k][column + j], row[j]);
      }
      if (r < column + kUnknowns)
        for (int j = 0; j < kUnknowns; ++j) shared.corner[r - column][j] = row[j];
      for (int j = 0; j < kUnknowns; ++j) local.own[column + j] = row[j];
    } else {
      const bool is_first = at.y == 0;
      if (r < column && !(is_first && at.thread == 0)) return;
      double corner[kUnknowns][kUnknowns], inverse[kUnknowns];
      factorCorner(shared, corner, inverse);
      if (is_first && at.thread == 0)  // 0 for a pivot that is not above 0
        for (int j = 0; j < kUnknowns; ++j)
          graph.inverse_pivots[front.first * kUnknowns + column + j] = inverse[j];
      if (r < column || unit >= column + kUnknowns) return;
      double row[kUnknowns];
      for (int j = 0; j < kUnknowns; ++j) row[j] = local.own[column + j];
      for (int j = 0; j < kUnknowns; ++j) {
        for (int k = 0; k < j; ++k) row[j] = multiplyAdd(-row[k], corner[j][k], row[j]);
        row[j] *= inverse[j];
      }
      for (int j = 0; j < kUnknowns; ++j) {
        local.own[column + j] = row[j];
        if (unit >= 0)
          graph.inverses[inverseAt(front, unit, column + j)] = row[j];
        else if (r >= pivots)
          base[(column + j) * leading] = row[j];
        else
          shared.triangle[column + j][r] = row[j];
      }
    }
  }

 private:
  /// The right-hand side is the last row of the border.
  SOFTSCOPE_HD static int rowsStored(const FrontShape& front) {
    return front.blocks * kUnknowns + 1;
  }
  /// Stored ones without those of the pivots, and as many of the unit matrix.
  SOFTSCOPE_HD static int rowsBelow(const FrontShape& front) { return rowsStored(front); }
  /// -1: none.
  SOFTSCOPE_HD static int rowOf(const FrontShape& front, const Place& at) {
    const int pivots = front.pivots * kUnknowns;
    if (at.thread < kMostColumns) return at.thread < pivots ? at.thread : -1;
    const int r = pivots + at.y * kBorderRows + at.thread - kMostColumns;
    return r < pivots + rowsBelow(front) ? r : -1;
  }

  SOFTSCOPE_HD static void factorCorner(const Shared& shared,
                                        double (&corner)[kUnknowns][kUnknowns],
                                        double (&inverse)[kUnknowns]) {
    for (int i = 0; i < kUnknowns; ++i)
      for (int j = 0; j <= i; ++j) corner[i][j] = shared.corner[i][j];
    for (int j = 0; j < kUnknowns; ++j) {
      double pivot = corner[j][j];
      for (int k = 0; k < j; ++k) pivot = multiplyAdd(-corner[j][k], corner[j][k], pivot);
      inverse[j] = pivot > 0 ? inverseRoot(pivot) : 0;
      for (int i = j + 1; i < kUnknowns; ++i) {
        double value = corner[i][j];
        for (int k = 0; k < j; ++k) value = multiplyAdd(-corner[i][k], corner[j][k], value);
        corner[i][j] = value * inverse[j];
      }
    }
  }
};

/// One block per tile of an update: updates of the children minus L L^T of the rows of the border.
struct UpdateFrontsKernel {
  static constexpr int kThreads = 256, kPhases = 2, kColumns = 36, kSide = 16, kEach = 3;
  static_assert(kSide * kSide == kThreads && kSide * kEach == kUpdateTile);
  struct Shared {
    double rows[kColumns][kUpdateTile], columns[kColumns][kUpdateTile];
  };
  struct Local {
    double total[kEach][kEach];
  };
  WarpStructureLayout graph;
  int first_front;

  SOFTSCOPE_HD int repeats(const Place& at) const {
    const FrontShape front = graph.fronts[first_front + at.y];
    if (at.x >= updateTiles(front.blocks - front.pivots)) return 0;
    return (front.pivots * kUnknowns + kColumns - 1) / kColumns;
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const FrontShape front = graph.fronts[first_front + at.y];
    const int border = (front.blocks - front.pivots) * kUnknowns, pivots = front.pivots * kUnknowns;
    int tile_row = 0, tile_column = at.x;
    const int tile_columns = (border + kUpdateTile - 1) / kUpdateTile;
    while (tile_column > tile_row || tile_column >= tile_columns) {
      tile_column -= tile_row < tile_columns ? tile_row + 1 : tile_columns;
      ++tile_row;
    }
    const int row0 = tile_row * kUpdateTile, column0 = tile_column * kUpdateTile;
    const int x = at.thread % kSide, y = at.thread / kSide;
    if constexpr (kPhase == 0) {
      if (at.repeat == 0) addChildren(front, row0 + x, column0 + y, local);
      load(front, at, row0, border + 1, shared.rows);
      load(front, at, column0, border, shared.columns);
    } else {
      for (int k = 0; k < kColumns; ++k) SOFTSCOPE_UNROLL(3)
      for (int i = 0; i < kEach; ++i) SOFTSCOPE_UNROLL(3)
      for (int j = 0; j < kEach; ++j)
        local.total[i][j] = multiplyAdd(-shared.rows[k][x + i * kSide],
                                        shared.columns[k][y + j * kSide], local.total[i][j]);
      if ((at.repeat + 1) * kColumns < pivots) return;
      SOFTSCOPE_UNROLL(3)
      for (int i = 0; i < kEach; ++i) SOFTSCOPE_UNROLL(3)
      for (int j = 0; j < kEach; ++j) {
        const int r = row0 + x + i * kSide, c = column0 + y + j * kSide;
        if (r <= border && c < border)
          graph.updates[front.update + r + static_cast<std::ptrdiff_t>(c) * front.update_leading] =
              local.total[i][j];
      }
    }
  }

 private:
  SOFTSCOPE_HD void load(const FrontShape& front, const Place& at, int first, int limit,
                         double (&to)[kColumns][kUpdateTile]) const {
    const int pivots = front.pivots * kUnknowns;
    for (int i = at.thread; i < kColumns * kUpdateTile; i += kThreads) {
      const int k = at.repeat * kColumns + i / kUpdateTile, r = first + i % kUpdateTile;
      to[i / kUpdateTile][i % kUpdateTile] =
          k < pivots && r < limit
              ? graph.factor[front.factor + pivots + r +
                             static_cast<std::ptrdiff_t>(k) * front.factor_leading]
              : 0;
    }
  }
  /// Updates of the children for the entries of a thread, from (row, column) on.
  SOFTSCOPE_HD void addChildren(const FrontShape& front, int row, int column, Local& local) const {
    const int border_blocks = front.blocks - front.pivots;
    local = {};
    for (int number = front.child_begin; number < front.child_end; ++number) {
      const FrontShape child = graph.fronts[graph.children[number].front];
      const int* map = graph.maps + graph.children[number].map + front.pivots;
      int from_row[kEach], from_column[kEach];
      SOFTSCOPE_UNROLL(3)
      for (int i = 0; i < kEach; ++i) {
        const int r = row + i * kSide, c = column + i * kSide;
        from_row[i] = r / kUnknowns == border_blocks  ? child.blocks - child.pivots
                      : r / kUnknowns < border_blocks ? map[r / kUnknowns]
                                                      : -1;
        from_column[i] = c / kUnknowns < border_blocks ? map[c / kUnknowns] : -1;
      }
      const double* update = graph.updates + child.update;
      SOFTSCOPE_UNROLL(3)
      for (int i = 0; i < kEach; ++i) SOFTSCOPE_UNROLL(3)
      for (int j = 0; j < kEach; ++j) {
        const bool is_there = from_column[j] >= 0 && from_row[i] >= from_column[j] &&
                              row + i * kSide <= border_blocks * kUnknowns;
        const std::ptrdiff_t place = from_row[i] * kUnknowns + (row + i * kSide) % kUnknowns +
                                     static_cast<std::ptrdiff_t>(from_column[j] * kUnknowns +
                                                                 (column + j * kSide) % kUnknowns) *
                                         child.update_leading;
        local.total[i][j] += is_there ? update[place] : 0;
      }
    }
  }
};

/// One block per front of a level, from the roots down: x = L^-T (y - L^T x of the border).
struct SolveFrontsKernel {
  // A thread has one row of the pivots and one node of them, or one part of the border.
  static constexpr int kThreads = 1024, kPhases = 5, kStagedBorder = 1024;
  static_assert(kThreads >= kMostColumns * kMostPivots);
  struct Shared {
    double border[kStagedBorder];
    double partial[kMostPivots][kMostColumns];
    double right[kMostColumns];
  };
  struct Local {
    double inverse[kUnknowns];
  };
  WarpStructureLayout graph;
  int first_front;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const FrontShape front = graph.fronts[first_front + at.x];
    const int pivots = front.pivots * kUnknowns;
    const int row = at.thread % kMostColumns, part = at.thread / kMostColumns;
    if constexpr (kPhase == 0) {
      for (int j = 0; j < kUnknowns; ++j)
        local.inverse[j] = row < pivots && part < front.pivots && part >= row / kUnknowns
                               ? graph.inverses[inverseAt(front, row, part * kUnknowns + j)]
                               : 0;
      const int border = front.blocks * kUnknowns - pivots;
      for (int i = at.thread; i < border && i < kStagedBorder; i += kThreads)
        shared.border[i] = unknown(front, pivots + i);
    } else if constexpr (kPhase == 1) {
      const int of_border = at.thread % kMostPivots, column = at.thread / kMostPivots;
      if (column < pivots)
        shared.partial[of_border][column] = borderPart(front, column, of_border, shared);
    } else if constexpr (kPhase == 2) {
      if (part > 0 || row >= pivots) return;
      shared.right[row] =
          entry(front, front.blocks * kUnknowns, row) - sumOfParts(kMostPivots, row, shared);
    } else if constexpr (kPhase == 3) {
      if (part >= front.pivots) return;
      double sum = 0;
      for (int j = 0; j < kUnknowns; ++j)
        sum = multiplyAdd(local.inverse[j], shared.right[part * kUnknowns + j], sum);
      shared.partial[part][row] = sum;
    } else {
      if (part == 0 && row < pivots) unknown(front, row) = sumOfParts(front.pivots, row, shared);
    }
  }

 private:
  SOFTSCOPE_HD double entry(const FrontShape& front, int row, int column) const {
    return graph
        .factor[front.factor + row + static_cast<std::ptrdiff_t>(column) * front.factor_leading];
  }
  SOFTSCOPE_HD double& unknown(const FrontShape& front, int row) const {
    return graph
        .solution[graph.front_nodes[front.nodes + row / kUnknowns] * kUnknowns + row % kUnknowns];
  }
  SOFTSCOPE_HD double borderPart(const FrontShape& front, int column, int part,
                                 const Shared& shared) const {
    const int pivots = front.pivots * kUnknowns, border = front.blocks * kUnknowns - pivots;
    const int staged = border < kStagedBorder ? border : kStagedBorder;
    double sum = 0;
    int i = part;
    SOFTSCOPE_UNROLL(8)
    for (; i < staged; i += kMostPivots)
      sum = multiplyAdd(entry(front, pivots + i, column), shared.border[i], sum);
    for (; i < border; i += kMostPivots)
      sum = multiplyAdd(entry(front, pivots + i, column), unknown(front, pivots + i), sum);
    return sum;
  }
  SOFTSCOPE_HD static double sumOfParts(int parts, int row, const Shared& shared) {
    double sum = 0;
    for (int part = 0; part < parts; ++part) sum += shared.partial[part][row];
    return sum;
  }
};

}  // namespace softscope::cuda
