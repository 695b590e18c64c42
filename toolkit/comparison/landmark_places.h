// toolkit/comparison/landmark_places.h: named landmarks of a patient.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

namespace softscope {

/// By name; LPS, mm.
using LandmarkPlaces = std::map<std::string, Eigen::Vector3d>;

/// CSV with a heading: name and x_mm,y_mm,z_mm (or reference_x_mm …, as for `compare
/// --landmarks`), in LPS; or a Slicer fiducial list (.fcsv), in the space of its
/// header. Throws InputError: missing names or coordinates, a duplicate name.
LandmarkPlaces readLandmarkPlaces(const std::filesystem::path& file);

}  // namespace softscope
