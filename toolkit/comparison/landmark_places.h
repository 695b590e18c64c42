// toolkit/comparison/landmark_places.h: named landmarks of a patient.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

namespace softscope {

/// By name, LPS, mm.
using LandmarkPlaces = std::map<std::string, Eigen::Vector3d>;

/// A CSV with a heading: name and x_mm,y_mm,z_mm (or reference_x_mm …, as `compare --landmarks`
/// takes them), in LPS; or a Slicer fiducial list (.fcsv), in the space that its head says. Throws
/// InputError: no names, no coordinates, a name twice.
LandmarkPlaces readLandmarkPlaces(const std::filesystem::path& file);

}  // namespace softscope
