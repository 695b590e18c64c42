// toolkit/viewer/view_errors.h: errors of a viewed model: measured now or before.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "eval/distance/triangle_tree.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/run/run_reader.h"
#include "vtk_views/viewer/view_source.h"

namespace softscope {

/// All in the run's own world.
class MomentErrors {
 public:
  virtual ~MomentErrors() = default;
  /// The surface that the model is to be compared with at that moment; null where none is known.
  virtual std::shared_ptr<const TriangleMesh> reference(const ViewMoment& moment) = 0;
  /// Points and errors of the moment, with sign or without; none where none are known.
  virtual void judge(bool with_sign, ViewMoment& moment) = 0;
};

/// A mesh that stands still in the run's world, or the truth of the sequence that the run was made
/// from. Throws InputError.
std::unique_ptr<MomentErrors> errorsFromReference(const std::filesystem::path& reference,
                                                  const Eigen::Isometry3d& reference_from_run);

/// What `softscope evaluate` left: errors/NNNNNN.vtp. Throws InputError where there are none.
std::unique_ptr<MomentErrors> errorsFromEvaluation(const std::filesystem::path& folder);

/// Colours and their bar's label. `errors_mm` decide the range unless the options do.
void chooseErrorColours(const std::vector<double>& errors_mm, const ErrorColourOptions& options,
                        ViewWorld& world);

}  // namespace softscope
