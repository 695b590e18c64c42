// vtk_views/viewer/view_source.h: source of the models that the viewer shows.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/triangle_mesh.h"
#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/volumes/grey_window.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// Model of one frame, in mm and in the frame of all other content. Unknown parts are empty.
struct ViewMoment {
  int frame = 0;
  double time_s = std::nan("");  // NaN: no timestamps
  TriangleMesh model;            // points, with their colours
  std::vector<float> weights;    // one per point
  /// Points with known errors, often a subset of the model, and the errors, mm.
  TriangleMesh judged;
  std::vector<double> errors_mm;
  std::shared_ptr<const TriangleMesh> reference;
  std::optional<Eigen::Isometry3d> world_from_left;
  std::vector<Eigen::Vector3f> nodes_mm;
  std::vector<Eigen::Vector3f> node_motion_mm;  // since `moved_since`; shorter if nodes are new
  int moved_since = -1;                         // a frame
};

/// Content common to all frames.
struct ViewWorld {
  SceneFrame frame = SceneFrame::kCamera;
  PinholeCamera left;  // width_px 0: unknown
  /// Known positions of the scope per frame.
  std::vector<std::pair<int, Eigen::Vector3f>> path_mm;
  std::optional<Volume> volume;  // in LPS: requires kPatient
  GreyWindow window;
  ErrorColours errors;
  std::string error_label = "distance to the surface [mm]";
  double largest_weight = 10;
  bool has_errors = false, has_weights = false, has_nodes = false, has_reference = false;
};

/// Provides one model at a time: memory is constant for long runs.
class ViewSource {
 public:
  virtual ~ViewSource() = default;
  virtual const ViewWorld& world() const = 0;
  virtual int count() const = 0;  // number of models; at least 1, never decreasing
  virtual int frameOf(int index) const = 0;
  virtual double secondsOf(int index) const = 0;  // ascending, also without timestamps
  /// Throws InputError for unreadable files.
  virtual std::shared_ptr<const ViewMoment> moment(int index, bool with_errors) = 0;
  /// True if more models may follow.
  virtual bool live() const = 0;
  /// For a live source: the writing process has ended.
  virtual bool stopped() const { return false; }
  /// Checks for new models.
  virtual void look() = 0;
};

}  // namespace softscope
