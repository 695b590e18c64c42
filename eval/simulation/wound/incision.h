// eval/simulation/wound/incision.h: a cut that opens over time.
#pragma once

#include <Eigen/Geometry>

#include "eval/simulation/tissue/tissue_body.h"

namespace softscope {

/// Incision in the first view; length 0: none.
struct CutOptions {
  double length_mm = 0;     // along the surface
  double depth_mm = 4;      // at the centre; zero at the ends
  double opening_mm = 5;    // distance of the lips at the centre, fully open
  double x_mm = 0;          // of its centre, from the centre of the first image: right,
  double y_mm = 0;          // down
  double angle_deg = 20;    // direction there: 0 right, 90 down
  double start_s = 0.4;     // closed and invisible before
  double duration_s = 1.2;  // of the opening

  bool there() const { return length_mm > 0; }
  /// 0 closed, 1 open.
  float openAt(double time_s) const;
  /// Throws OptionError.
  void validate() const;
};

/// Cuts the organ; unchanged without a cut. `body_from_view`: x right, y down, z forward of the
/// first image of the scope, with the origin on the tissue in its centre. Throws OptionError if the
/// cut does not fit on or into the organ, InputError if the mesh is open or self-approaching there.
TissueBody cutTissue(const TriangleMesh& organ, const CutOptions& options,
                     const Eigen::Isometry3d& body_from_view);

}  // namespace softscope
