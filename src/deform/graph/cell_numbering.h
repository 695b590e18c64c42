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

/// Looks up points in sequence. Neighbours in the list mostly share a cube, which is cached.
class CellFinder {
 public:
  explicit CellFinder(const CellNumbering& table) : table_(table) {}
  /// Cell of the point, -1 if none.
  int find(const Eigen::Vector3f& point_mm) {
    Cube cube;
    if (!table_.cubeOf(point_mm, &cube)) return -1;
    if (!(cube == last_cube_)) last_cell_ = table_.find(cube);
    last_cube_ = cube;
    return last_cell_;
  }

 private:
  const CellNumbering& table_;
  Cube last_cube_{-1, -1, -1};
  int last_cell_ = -1;
};

/// Looks up the cubes around others in sequence: the blocks around the last one are cached.
class NeighbourFinder {
 public:
  explicit NeighbourFinder(const CellNumbering& table) : table_(table) {}
  /// Numbers of the cubes that touch this one, also at a corner, without its own.
  template <class Visit>
  void visit(const Cube& centre, const Visit& visit) {
    moveTo(centre);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const Cube cube{centre.x + dx, centre.y + dy, centre.z + dz};
          if (cube == centre) continue;
          const int other = (*around_[blockAround(cube)])[CellNumbering::insideBlock(cube)];
          if (other >= 0) visit(other);
        }
  }

 private:
  void moveTo(const Cube& cube);
  /// Of 3 x 3 x 3 blocks.
  std::size_t blockAround(const Cube& cube) const {
    const auto along = [](int at, int first) { return (at >> CellNumbering::kBlockBits) - first; };
    return static_cast<std::size_t>((along(cube.z, first_.z) * 3 + along(cube.y, first_.y)) * 3 +
                                    along(cube.x, first_.x));
  }

  const CellNumbering& table_;
  Cube first_{-2, -2, -2};  // the first of the blocks around, in blocks
  std::array<const CellNumbering::Block*, 27> around_{};
};

}  // namespace softscope
