// apps/evaluate_points.h: the points of a reconstructed model, fast.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Positions of a model, mm, from a binary little-endian PLY whose vertices have float x, y, z, as
/// `reconstruct` writes it. Throws InputError: not such a file, cut short, no point at all, or a
/// point that is not finite or beyond 1 km.
std::vector<Eigen::Vector3f> readModelPoints(const std::filesystem::path& file);
std::vector<Eigen::Vector3f> parseModelPoints(std::string_view bytes, const std::string& name);

}  // namespace softscope
