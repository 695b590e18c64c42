// cmake/common_templates.h: what most files ask of Eigen and of JSON. Nothing calls it: templates
// that precompiled headers use are instantiated there, once, instead of in every file.
#pragma once

#include <Eigen/Dense>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace softscope::precompiled {

template <typename Scalar>
Scalar vectors(Eigen::Matrix<Scalar, 3, 1> p, Eigen::Matrix<Scalar, 3, 3> turn) {
  using Point = Eigen::Matrix<Scalar, 3, 1>;
  const Eigen::Matrix<Scalar, 3, 3> fixed = turn;
  const Point moved = fixed * p;
  p += turn * p;
  p = turn * p;
  p = turn.transpose() * p;
  p = fixed.transpose() * p;
  p = fixed.transpose() * (p - moved);
  p = turn * (p - moved) + p;
  p = p.cross(moved).normalized();
  turn = turn * turn;
  turn = fixed * turn.transpose();
  turn = turn.transpose() * fixed;
  turn += p * p.transpose();
  turn = turn.inverse().eval();
  const Eigen::JacobiSVD<Eigen::Matrix<Scalar, 3, 3>> axes(
      turn, Eigen::ComputeFullU | Eigen::ComputeFullV);
  turn = axes.matrixU() * axes.matrixV().transpose();
  const Point mixed = Scalar(2) * (p - Point::Zero()) / Scalar(3) - moved;
  return turn.norm() + turn.trace() + turn.determinant() + mixed.norm() + mixed.dot(p) +
         mixed.squaredNorm() + mixed.sum() + mixed.minCoeff() + mixed.maxCoeff() +
         mixed.cwiseAbs().maxCoeff() + static_cast<Scalar>(mixed.allFinite());
}

template <typename Scalar>
Scalar rigidMotions(Eigen::Transform<Scalar, 3, Eigen::Isometry> a,
                    const Eigen::Transform<Scalar, 3, Eigen::Isometry>& b) {
  a = a * b;
  a = a.inverse() * b;
  Eigen::Matrix<Scalar, 3, 1> p = a * b.translation().eval();
  p = a.linear() * p + a.translation();
  Eigen::Matrix<Scalar, 3, 3> turn = b.linear() * a.linear();
  const Eigen::AngleAxis<Scalar> angle(b.linear());
  const Eigen::Quaternion<Scalar> quaternion(b.linear());
  turn = angle.toRotationMatrix() * quaternion.normalized().toRotationMatrix();
  a.linear() = turn;
  a.translation() = p;
  a = Eigen::Transform<Scalar, 3, Eigen::Isometry>::Identity();
  const Eigen::AngleAxis<Scalar> between(quaternion);
  return angle.angle() + between.angle() + (a.translation() - b.translation()).norm() +
         vectors<Scalar>(p, turn);
}

inline double bothScalars(const Eigen::Isometry3d& a, const Eigen::Isometry3f& b) {
  const Eigen::Vector3d p = b.translation().eval().cast<double>();
  const Eigen::Vector3f q = a.translation().eval().cast<float>();
  return rigidMotions<double>(a, a) + rigidMotions<float>(b, b) + p.x() +
         static_cast<double>(q.x());
}

inline double sixUnknowns(Eigen::Matrix<double, 6, 6> information, Eigen::Matrix<double, 6, 1> b) {
  information += b * b.transpose();
  b = information.ldlt().solve(b);
  b = -information.llt().solve(b);
  return b.norm() + b.dot(information * b);
}

template <typename Json>
std::string values(Json json, const std::string& text) {
  json["number"] = 1.0;
  json["count"] = 1;
  json["size"] = std::size_t{1};
  json["text"] = text;
  json["literal"] = "text";
  json["flag"] = true;
  json["nothing"] = nullptr;
  json["numbers"] = std::vector<double>{1.0};
  json["texts"] = std::vector<std::string>{text};
  json["array"] = Json::array();
  json["object"] = {{"number", 1.0}, {"count", 1}, {"text", text}};
  json.push_back({{"number", 1.0}});
  for (const auto& [key, value] : json.items()) {
    if (value.is_string() || value.template get<double>() > 1.0) return key;
  }
  if (json.contains("text")) return json.at("text").template get<std::string>();
  return Json::parse(text).dump(2) + json.value("text", text);
}

inline std::string bothOrders(const std::string& text) {
  return values<nlohmann::json>({}, text) + values<nlohmann::ordered_json>({}, text);
}

}  // namespace softscope::precompiled
