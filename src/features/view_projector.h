// src/features/view_projector.h: the camera of a model view, in floats.
#pragma once

#include "features/model_view.h"
#include "features/view_formulas.h"

namespace softscope {

inline ViewProjector viewProjector(const PinholeCamera& camera,
                                   const Eigen::Isometry3d& world_from_left,
                                   const ModelViewOptions& options) {
  const Eigen::Matrix3f rotation = world_from_left.linear().transpose().cast<float>();
  const Eigen::Vector3f translation_mm =
      (-world_from_left.linear().transpose() * world_from_left.translation()).cast<float>();
  ViewProjector to{};
  for (int i = 0; i < 3; ++i) to.rows[i] = {rotation(i, 0), rotation(i, 1), rotation(i, 2)};
  to.translation_mm = {translation_mm.x(), translation_mm.y(), translation_mm.z()};
  to.width = static_cast<float>(camera.width_px);
  to.height = static_cast<float>(camera.height_px);
  to.fx = static_cast<float>(camera.fx_px);
  to.fy = static_cast<float>(camera.fy_px);
  to.cx = static_cast<float>(camera.cx_px);
  to.cy = static_cast<float>(camera.cy_px);
  to.radius_mm = static_cast<float>(options.kDiscSpacings * options.point_spacing_mm);
  to.min_radius_px = static_cast<float>(options.kMinDiscPx);
  return to;
}

}  // namespace softscope
