// eval/simulation/wound/incision.h: a cut that opens over time.
#pragma once

#include <Eigen/Geometry>

#include "eval/simulation/tissue/tissue_body.h"

namespace softscope {

/// Where the scope looks first; length 0 leaves the tissue whole.
struct CutOptions {
  double length_mm = 0;     // along the surface
  double depth_mm = 4;      // in the middle; none at the ends
  double opening_mm = 5;    // between the lips in the middle, when it is open
  double x_mm = 0;          // of its middle, from the middle of the first image: right,
  double y_mm = 0;          // down
  double angle_deg = 20;    // of its direction there: 0 right, 90 down
  double start_s = 0.4;     // closed until then, and nothing to be seen of it
  double duration_s = 1.2;  // to open

  bool there() const { return length_mm > 0; }
  /// 0 closed, 1 open.
  float openAt(double time_s) const;
  /// Throws OptionError.
  void validate() const;
};

/// Cuts the organ, whole where no cut was asked for. `body_from_view`: x right, y down, z forward
/// of the scope's first image, from the tissue in its middle. Throws OptionError where the cut
/// doesn't fit on or into the organ, InputError where that is open or crowded there.
TissueBody cutTissue(const TriangleMesh& organ, const CutOptions& options,
                     const Eigen::Isometry3d& body_from_view);

}  // namespace softscope
