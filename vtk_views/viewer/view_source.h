// vtk_views/viewer/view_source.h: source of the moments that the viewer shows.
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

/// A model at one moment, in mm and one frame with everything else. What isn't known is empty.
struct ViewMoment {
  int frame = 0;
  double time_s = std::nan("");  // NaN: no clock
  TriangleMesh model;            // points, with their colours
  std::vector<float> weights;    // one a point
  /// Points whose errors are known, often fewer than the model's, and these, mm.
  TriangleMesh judged;
  std::vector<double> errors_mm;
  std::shared_ptr<const TriangleMesh> reference;
  std::optional<Eigen::Isometry3d> world_from_left;
  std::vector<Eigen::Vector3f> nodes_mm;
  std::vector<Eigen::Vector3f> node_motion_mm;  // since `moved_since`; fewer where nodes are new
  int moved_since = -1;                         // a frame
};

/// What doesn't change from moment to moment.
struct ViewWorld {
  SceneFrame frame = SceneFrame::kCamera;
  PinholeCamera left;  // width_px 0: unknown
  /// Where the scope was, frame after frame, as far as it is known.
  std::vector<std::pair<int, Eigen::Vector3f>> path_mm;
  std::optional<Volume> volume;  // in LPS: then frame is kPatient
  GreyWindow window;
  ErrorColours errors;
  std::string error_label = "distance to the surface [mm]";
  double largest_weight = 10;
  bool has_errors = false, has_weights = false, has_nodes = false, has_reference = false;
};

/// Gives moments one at a time, so that long runs needn't be in memory.
class ViewSource {
 public:
  virtual ~ViewSource() = default;
  virtual const ViewWorld& world() const = 0;
  virtual int count() const = 0;  // of moments; never 0, never less than before
  virtual int frameOf(int index) const = 0;
  virtual double secondsOf(int index) const = 0;  // rising, also where there is no clock
  /// Throws InputError where its files can't be read.
  virtual std::shared_ptr<const ViewMoment> moment(int index, bool with_errors) = 0;
  /// Whether more moments may come.
  virtual bool live() const = 0;
  /// Of a live source: whether its writer has ended, so that no more moments are likely.
  virtual bool stopped() const { return false; }
  /// Looks whether there are more by now.
  virtual void look() = 0;
};

}  // namespace softscope
