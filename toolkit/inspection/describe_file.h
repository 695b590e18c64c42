// toolkit/inspection/describe_file.h: description of a file by its kind.
#pragma once

#include <string>

#include "core/stereo_rig.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

// All throw InputError.

/// `check_all`: reads every frame instead of the first.
FactSheet describeSequence(const std::string& folder, bool check_all);
FactSheet describeImage(const std::string& file);
FactSheet describeFloatMap(const std::string& file);  // PFM
FactSheet describeVideo(const std::string& file);
FactSheet describeMesh(const std::string& file);  // or a PLY of points alone
FactSheet describeVolume(const std::string& path, const VolumeOptions& options);
FactSheet describeCalibration(const std::string& path);
FactSheet describeSettings(const std::string& file);

/// Focal length, baseline, field of view, what a pixel of disparity is worth; warnings.
/// `key` is the JSON name that all stand under; empty: at the top.
void addCalibration(const StereoCalibration& calibration, const std::string& key, FactSheet& facts);

}  // namespace softscope
