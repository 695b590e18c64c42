// src/deform/graph/cell_numbering.h: numbers of the cubes of a regular grid that contain points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace softscope {

/// Cube of the grid; a coordinate is from 0 to 2^21 - 1, the origin in the middle.
struct Cube {
  int x = 0, y = 0, z = 0;

  friend bool operator==(const Cube& a, const Cube& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

/// Numbers 0, 1, 2 … of cubes in order of first use. Cubes lie in blocks of 8 x 8 x 8, whose
/// numbers are a table: a surface fills few of them, and its cubes are looked up without a search.
class CellNumbering {
 public:
  explicit CellNumbering(double cell_mm);

  /// False if the point is not finite, or outside of the grid (2^20 cells).
  bool cubeOf(const Eigen::Vector3f& point_mm, Cube* cube) const {
    constexpr double kMargin = 64, kEnd = 2.0 * kOrigin - kMargin;
    int index[3];
    for (int c = 0; c < 3; ++c) {
      const double cell = static_cast<double>(point_mm[c]) * inverse_cell_ + kOrigin;
      if (!(cell >= kMargin && cell < kEnd)) return false;  // NaN too
      index[c] = static_cast<int>(cell);
    }
    *cube = {index[0], index[1], index[2]};
    return true;
  }

  int find(const Cube& cube) const;  // -1 for a cube without a number
  int findOrAdd(const Cube& cube);
  int size() const { return static_cast<int>(cubes_.size()); }
  int blocks() const { return static_cast<int>(blocks_.size()); }
  Cube firstCubeOf(int block) const;
  const Cube& cube(int cell) const { return cubes_[static_cast<std::size_t>(cell)]; }

  static constexpr int kBlockBits = 3, kBlockSide = 1 << kBlockBits;
  /// The cells of a block, x first; -1 for cubes without a number.
  using Block = std::array<int, kBlockSide * kBlockSide * kBlockSide>;
  static int insideBlock(const Cube& cube) {
    constexpr int kMask = kBlockSide - 1;
    return ((cube.z & kMask) << (2 * kBlockBits)) | ((cube.y & kMask) << kBlockBits) |
           (cube.x & kMask);
  }
  /// The block that holds a cube; one without cells if no cube of it has a number.
  const Block& blockOf(const Cube& cube) const;

 private:
  static constexpr int kOrigin = 1 << 20;

  std::size_t slotOf(std::uint64_t key) const;
  int findOrAddBlock(std::uint64_t key);
  void grow();

  double inverse_cell_;
  std::vector<int> slots_;           // open addressing; number of a block, or -1
  std::vector<std::uint64_t> keys_;  // of the blocks
  std::vector<Block> blocks_;
  std::vector<Cube> cubes_;  // of the cells
  int last_block_ = -1;      // of findOrAdd()
};

/// Numbers of the cells of a block, and of those around it.
class BlockWithRim {
 public:
  BlockWithRim(const CellNumbering& table, int block);

  /// visit(cell, other) for each cell of the block and each that touches it, also at a corner.
  template <class Visit>
  void visitTouching(const Visit& visit) const {
    for (int z = 1; z <= CellNumbering::kBlockSide; ++z)
      for (int y = 1; y <= CellNumbering::kBlockSide; ++y)
        for (int x = 1; x <= CellNumbering::kBlockSide; ++x)
          if (const int cell = cells_[at(x, y, z)]; cell >= 0)
            visitAround(at(x, y, z), [&](int other) { visit(cell, other); });
  }

 private:
  static constexpr int kSide = CellNumbering::kBlockSide + 2;
  static constexpr int at(int x, int y, int z) { return (z * kSide + y) * kSide + x; }

  template <class Visit>
  void visitAround(int centre, const Visit& visit) const {
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int away = at(dx, dy, dz), other = cells_[centre + away];
          if (away != 0 && other >= 0) visit(other);
        }
  }

  std::array<int, kSide * kSide * kSide> cells_;
};

}  // namespace softscope
