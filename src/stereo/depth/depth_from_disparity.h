// src/stereo/depth/depth_from_disparity.h: depth from disparity.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"
#include "core/point_cloud.h"
#include "core/stereo_rig.h"

namespace softscope {

/// z = f b / (d + offset); its standard error grows with z²: sigma_z = z² / (f b) sigma_d.
/// NaN where the disparity is NaN, or the point at infinity or behind the camera.
DepthMap depthFromDisparity(const DisparityMap& disparity, const RectifiedRig& rig);

/// Normals from a plane fitted to the inverse depth (which is linear in the pixel on any plane) of
/// the surrounding pixels, without those across a depth step. NaN with too few measured pixels.
NormalMap normalsFromDepth(const Raster<float>& depth_mm, const PinholeCamera& camera);

/// All measured pixels outside of the mask (may be empty), in the left camera
/// frame, mm. Pixels without a normal are left out, so that every point has one.
PointCloud pointCloud(const Raster<float>& depth_mm, const NormalMap& normals,
                      const ColourImage& colour, const PinholeCamera& camera, const Mask& mask);

}  // namespace softscope
