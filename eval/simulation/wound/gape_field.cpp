// eval/simulation/wound/gape_field.cpp: linear finite elements, one factorisation, two solutions.
#include "eval/simulation/wound/gape_field.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double kFar = 1.6;  // in slit lengths; (1 + r / reach) exp(-r / reach) is 2 % there
constexpr double kRigid = 1.5;
constexpr double kScreen = 0.5;  // in slit lengths; stiffness of the bed

/// Free vertices: their rows in the equations, -1 for fixed ones.
std::vector<int> rowsOf(const std::vector<Eigen::Vector3f>& vertices_mm,
                        const std::vector<Triangle>& skin,
                        const std::map<std::int32_t, double>& held, double length_mm, int& count) {
  Eigen::AlignedBox3f box;
  for (const auto& [vertex, share] : held) box.extend(vertices_mm[vertex]);
  std::vector<int> rows(vertices_mm.size(), -1);
  for (const Triangle& t : skin)
    for (const std::int32_t vertex : t)
      if (rows[vertex] < 0 && held.count(vertex) == 0 &&
          box.exteriorDistance(vertices_mm[vertex]) < float(kFar * length_mm))
        rows[vertex] = count++;
  return rows;
}

/// Cotangent weight of corner k for the opposite side.
double cotangent(const std::vector<Eigen::Vector3f>& vertices_mm, const Triangle& t, int k) {
  const Eigen::Vector3d a = vertices_mm[t[k]].cast<double>();
  const Eigen::Vector3d b = vertices_mm[t[(k + 1) % 3]].cast<double>() - a;
  const Eigen::Vector3d c = vertices_mm[t[(k + 2) % 3]].cast<double>() - a;
  return b.dot(c) / std::max(b.cross(c).norm(), 1e-9);
}

double areaMm2(const std::vector<Eigen::Vector3f>& vertices_mm, const Triangle& t) {
  const Eigen::Vector3f& a = vertices_mm[t[0]];
  return 0.5 * (vertices_mm[t[1]] - a).cross(vertices_mm[t[2]] - a).norm();
}

/// -div grad u + u / screen^2 = f with u given on the lips, and 0 at a large distance.
struct Membrane {
  Matrix stiffness;
  Eigen::VectorXd mass, pull;  // per row; force of the fixed vertices

  Membrane(const std::vector<Eigen::Vector3f>& vertices_mm, const std::vector<Triangle>& skin,
           const std::map<std::int32_t, double>& held, const std::vector<int>& rows, int count,
           double screen_mm)
      : stiffness(count, count),
        mass(Eigen::VectorXd::Zero(count)),
        pull(Eigen::VectorXd::Zero(count)) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Triangle& t : skin) {
      for (int k = 0; k < 3; ++k) {
        const std::int32_t from = t[(k + 1) % 3], to = t[(k + 2) % 3];
        const double weight = 0.5 * cotangent(vertices_mm, t, k);
        for (const auto& [i, j] : {std::pair(from, to), std::pair(to, from)}) {
          if (rows[i] < 0) continue;
          entries.emplace_back(rows[i], rows[i], weight);
          if (rows[j] >= 0) entries.emplace_back(rows[i], rows[j], -weight);
          if (const auto found = held.find(j); found != held.end())
            pull[rows[i]] += weight * found->second;
        }
        if (rows[t[k]] >= 0) mass[rows[t[k]]] += areaMm2(vertices_mm, t) / 3;
      }
    }
    for (int i = 0; i < count; ++i) entries.emplace_back(i, i, mass[i] / (screen_mm * screen_mm));
    stiffness.setFromTriplets(entries.begin(), entries.end());
  }
};

}  // namespace

std::vector<double> gapeField(const std::vector<Eigen::Vector3f>& vertices_mm,
                              const std::vector<Triangle>& skin,
                              const std::map<std::int32_t, double>& held, double length_mm) {
  int count = 0;
  const std::vector<int> rows = rowsOf(vertices_mm, skin, held, length_mm, count);
  std::vector<double> field(vertices_mm.size(), 0);
  for (const auto& [vertex, share] : held) field[vertex] = share;
  if (count == 0) return field;
  const Membrane membrane(vertices_mm, skin, held, rows, count, kScreen * length_mm);
  const Eigen::SimplicialLDLT<Matrix> solver(membrane.stiffness);
  // A lens of the length of the slit decays as exp(-r / reach), 1 / reach^2 = (pi / length)^2
  // + 1 / screen^2. Twice its curvature as the source gives r / reach exp(-r / reach), which
  // makes the lip rigid; a slightly smaller value limits the displacement to that of the lip.
  const double bend = std::pow(M_PI / length_mm, 2) + std::pow(kScreen * length_mm, -2);
  const Eigen::VectorXd steep = solver.solve(membrane.pull);
  const Eigen::VectorXd driven = (kRigid * bend * membrane.mass.array() * steep.array()).matrix();
  const Eigen::VectorXd smooth = steep + solver.solve(driven);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] >= 0) field[i] = smooth[rows[i]];
  return field;
}

}  // namespace softscope
