// toolkit/figures/figure_options.h: common options of `slice` and `figure`.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/length_unit.h"
#include "toolkit/figures/volume_arguments.h"
#include "toolkit/record/record_paths.h"
#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// Texts as given; the member functions parse them.
struct FigureOptions {
  std::vector<std::string> out;
  std::string window = "auto", at, landmarks, style = "ieee";
  double width_mm = 0, dots_per_inch = 0, field_mm = 0, dot_reach_mm = 0.5, unit_mm = kUnitOfFile;
  bool neurological = false, force = false;
  VolumeArguments volume;
  RecordPaths paths;

  /// Throws OptionError: a value out of range, an unknown file extension, an existing file.
  void validate() const;

  /// Style with the given width and resolution. Throws OptionError.
  FigureStyle figureStyle() const;
  SideRule sideRule() const {
    return neurological ? SideRule::kNeurological : SideRule::kRadiological;
  }
  /// From --at: a point, a landmark or the centre of `model` (null if absent);
  /// by default the centre of the scene. Throws OptionError, InputError.
  Eigen::Vector3d centreIn(const Scene& scene, const SceneSurface* model) const;
  /// Next to the first figure.
  std::filesystem::path recordFile() const;

 private:
  /// Point or landmark of --at; none for "model" and an empty text.
  std::optional<Eigen::Vector3d> namedPlace() const;
};

/// "1,2,-3.5". Throws OptionError with the name of the option.
Eigen::Vector3d parseVector(const std::string& text, const std::string& option);

}  // namespace softscope
