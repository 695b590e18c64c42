// eval/simulation/wound/wound_walls.cpp: triangle fans, lips, walls and opening.
#include "eval/simulation/wound/wound_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "eval/simulation/wound/gape_field.h"

namespace softscope {
namespace {

constexpr double kRound = 1.6;  // exponent across the wound: 1 a V, 2 a parabola
constexpr int kFewestRows = 4, kMostRows = 12;

/// Triangles around `vertex` from the edge to `first` to the edge to `last`, counter-clockwise.
std::vector<std::int32_t> fanOf(const SplittingMesh& mesh, std::int32_t vertex, std::int32_t first,
                                std::int32_t last) {
  std::vector<std::int32_t> fan;
  for (std::int32_t corner = first; corner != last; corner = mesh.cornerOpposite(vertex, corner))
    fan.push_back(mesh.triangleAt(vertex, corner));
  return fan;
}

class WoundBuilder {
 public:
  WoundBuilder(const TriangleMesh& organ, const SplittingMesh& mesh, const IncisionPlane& plane,
               const CutPath& path, const std::vector<double>& depths_mm)
      : mesh_(mesh), plane_(plane), path_(path), depths_mm_(depths_mm) {
    body_.organ = organ;
    body_.mesh.vertices_mm = mesh.vertices();
    body_.mesh.triangles = mesh.triangles();
    body_.mesh.space = organ.space;
    body_.places = mesh.places();
    body_.skin_triangles = mesh.triangles().size();
    body_.depth_mm.assign(mesh.vertices().size(), 0);
    body_.below_mm.assign(mesh.vertices().size(), Eigen::Vector3f::Zero());
  }

  TissueBody build(double opening_mm) {
    partLips();
    hangWalls();
    addGape(opening_mm);
    return std::move(body_);
  }

 private:
  int last() const { return static_cast<int>(path_.vertices.size()) - 1; }

  /// `depth_mm` below vertex i of the path.
  std::int32_t add(int i, double depth_mm) {
    const std::int32_t on_path = path_.vertices[i];
    const Eigen::Vector3f below = -float(depth_mm) * plane_.out;
    body_.mesh.vertices_mm.push_back(body_.mesh.vertices_mm[on_path] + below);
    body_.places.push_back(body_.places[on_path]);
    body_.depth_mm.push_back(float(depth_mm));
    body_.below_mm.push_back(below);
    return static_cast<std::int32_t>(body_.mesh.vertices_mm.size()) - 1;
  }

  /// The left lip keeps the vertices of the path, the right one gets new ones; both share the ends.
  void partLips() {
    left_lip_ = right_lip_ = path_.vertices;
    for (int i = 1; i < last(); ++i) {
      const std::int32_t vertex = path_.vertices[i];
      right_lip_[i] = add(i, 0);
      for (const std::int32_t triangle :
           fanOf(mesh_, vertex, path_.vertices[i - 1], path_.vertices[i + 1]))
        for (std::int32_t& corner : body_.mesh.triangles[triangle])
          if (corner == vertex) corner = right_lip_[i];
    }
  }

  /// Rows of both walls from their lips to their common line.
  void hangWalls() {
    const double deepest_mm = *std::max_element(depths_mm_.begin(), depths_mm_.end());
    const double step_mm = plane_.length_mm / last();
    const int rows = std::clamp(int(std::lround(deepest_mm / step_mm)), kFewestRows, kMostRows);
    std::vector<std::int32_t> left = left_lip_, right = right_lip_;
    for (int row = 1; row <= rows; ++row) {
      std::vector<std::int32_t> left_below = path_.vertices, right_below = path_.vertices;
      for (int i = 1; i < last(); ++i) {
        const double share = double(row) / rows, narrow = 1 - std::pow(share, kRound);
        left_below[i] = add(i, share * depths_mm_[i]);
        right_below[i] = row == rows ? left_below[i] : add(i, share * depths_mm_[i]);
        hanging_.push_back({left_below[i], left_lip_[i], narrow});
        if (row < rows) hanging_.push_back({right_below[i], right_lip_[i], narrow});
      }
      addBand(left_below, left);
      addBand(right, right_below);
      left = left_below;
      right = right_below;
    }
  }

  /// Triangles between two rows, counter-clockwise from `lower` along the
  /// path and back along `upper`, without degenerate triangles at the ends.
  void addBand(const std::vector<std::int32_t>& lower, const std::vector<std::int32_t>& upper) {
    for (int i = 0; i < last(); ++i) {
      const std::int32_t a = lower[i], b = lower[i + 1], c = upper[i + 1], d = upper[i];
      if (a != b && b != c && c != a) body_.mesh.triangles.push_back({a, b, c});
      if (a != c && c != d && d != a) body_.mesh.triangles.push_back({a, c, d});
    }
  }

  void addGape(double opening_mm) {
    std::map<std::int32_t, double> held;
    for (int i = 0; i <= last(); ++i) {
      const double share = 2 * path_.along_mm[i] / plane_.length_mm;
      const double lens = i == 0 || i == last() ? 0 : 1 - share * share;
      held[right_lip_[i]] = -lens;
      held[left_lip_[i]] = lens;
    }
    const std::vector<Triangle> skin(body_.mesh.triangles.begin(),
                                     body_.mesh.triangles.begin() + body_.skin_triangles);
    const std::vector<double> field =
        gapeField(body_.mesh.vertices_mm, skin, held, plane_.length_mm);
    for (const double share : field)
      body_.gape_mm.push_back(float(0.5 * opening_mm * share) * plane_.left());
    for (const Hanging& wall : hanging_)
      body_.gape_mm[wall.vertex] = float(wall.share) * body_.gape_mm[wall.lip];
  }

  struct Hanging {
    std::int32_t vertex, lip;
    double share;  // of the displacement of the lip
  };

  const SplittingMesh& mesh_;
  const IncisionPlane& plane_;
  const CutPath& path_;
  const std::vector<double>& depths_mm_;
  TissueBody body_;
  std::vector<std::int32_t> left_lip_, right_lip_;  // one per vertex of the path
  std::vector<Hanging> hanging_;
};

}  // namespace

TissueBody openWound(const TriangleMesh& organ, const SplittingMesh& mesh,
                     const IncisionPlane& plane, const CutPath& path,
                     const std::vector<double>& depths_mm, double opening_mm) {
  return WoundBuilder(organ, mesh, plane, path, depths_mm).build(opening_mm);
}

}  // namespace softscope
