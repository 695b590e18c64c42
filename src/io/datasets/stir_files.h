// src/io/datasets/stir_files.h: calib.json, queries.json,
// annotations.json and preds.json of STIR 2026.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope {

/// True position of a point in one frame, in the images on disk.
struct StirPoint {
  double left_u_px = 0, left_v_px = 0;
  double disparity_px = 0;  // u_left - u_right
  bool left_visible = false, right_visible = false;
};

/// By frame; every frame has the same number of points, and point k is the
/// same tissue in all of them. Instance 0, as in the script of the challenge.
using StirAnnotations = std::map<int, std::vector<StirPoint>>;

/// Throws InputError: invalid JSON, a key other than FRAME/INSTANCE,
/// lists of different lengths, numbers that are not finite.
StirAnnotations readStirAnnotations(const std::filesystem::path& file);
StirAnnotations parseStirAnnotations(std::string_view text, const std::string& name);
std::string stirAnnotationsJson(const StirAnnotations& annotations);

/// Pixels of the first left image to be tracked. Throws InputError.
std::vector<Eigen::Vector2d> readStirQueries(const std::filesystem::path& file);
std::vector<Eigen::Vector2d> parseStirQueries(std::string_view text, const std::string& name);
std::string stirQueriesJson(const std::vector<Eigen::Vector2d>& queries_px);

/// K_left, K_right, D_left, D_right, R_left_to_right, t_left_to_right in metres;
/// readable by readCalibration(). Throws OptionError for more than five coefficients.
std::string stirCalibrationJson(const StereoCalibration& calibration);

/// One frame of a submission.
struct StirPrediction {
  std::vector<Eigen::Vector3d> positions_mm;  // in the left camera frame; written in metres
  std::vector<bool> visible;
  double latency_ms = 0;
};

/// preds.json of the stereo track: sequence, then frame.
std::string stirPredictionsJson(
    const std::map<std::string, std::map<int, StirPrediction>>& predictions);

}  // namespace softscope
