// toolkit/figures/figure_options.h: what `slice` and `figure` have in common on the command line.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toolkit/figures/volume_arguments.h"
#include "toolkit/record/record_paths.h"
#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// As the user wrote them; the members below read them.
struct FigureOptions {
  std::vector<std::string> out;
  std::string window = "auto", at, landmarks, style = "ieee";
  double width_mm = 0, dots_per_inch = 0, field_mm = 0, dot_reach_mm = 0.5, unit_mm = 1;
  bool neurological = false, force = false;
  VolumeArguments volume;
  RecordPaths paths;

  /// Throws OptionError: a value out of its range, an unknown ending, a file that is there.
  void validate() const;

  /// The style with its width and resolution as asked for. Throws OptionError.
  FigureStyle figureStyle() const;
  SideRule sideRule() const {
    return neurological ? SideRule::kNeurological : SideRule::kRadiological;
  }
  /// Of --at: a point, a landmark, the middle of `model` (null where there is none), or, where
  /// nothing was asked, the middle of the scene. Throws OptionError, InputError.
  Eigen::Vector3d centreIn(const Scene& scene, const SceneSurface* model) const;
  /// Beside the first figure.
  std::filesystem::path recordFile() const;

 private:
  /// The point or landmark that --at names; none for "model" and where it is empty.
  std::optional<Eigen::Vector3d> namedPlace() const;
};

/// "1,2,-3.5". Throws OptionError naming the option.
Eigen::Vector3d parseVector(const std::string& text, const std::string& option);

}  // namespace softscope
