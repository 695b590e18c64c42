// toolkit/viewer/view_errors.h: errors of a viewed model: computed now, or read from an evaluation.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eval/distance/triangle_tree.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/run/run_reader.h"
#include "vtk_views/viewer/view_source.h"

namespace softscope {

/// All in the world of the run.
class MomentErrors {
 public:
  virtual ~MomentErrors() = default;
  /// Reference surface at that frame; null if unknown.
  virtual std::shared_ptr<const TriangleMesh> reference(const ViewMoment& moment) = 0;
  /// Adds points and (signed) errors of the frame; none if unknown.
  virtual void judge(bool with_sign, ViewMoment& moment) = 0;
  /// Differences between the run and its reference.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// From a static mesh in the world of the run, or from the truth of its
/// sequence, compared with run.json in the folder `run`. Throws InputError.
std::unique_ptr<MomentErrors> errorsFromReference(const std::filesystem::path& reference,
                                                  const std::filesystem::path& run,
                                                  const Eigen::Isometry3d& reference_from_run);

/// From errors/NNNNNN.vtp of `softscope evaluate`. Throws InputError if there are none.
std::unique_ptr<MomentErrors> errorsFromEvaluation(const std::filesystem::path& folder);

/// Colours, with the label of their bar. `errors_mm` determine the default range.
void chooseErrorColours(const std::vector<double>& errors_mm, const ErrorColourOptions& options,
                        ViewWorld& world);

}  // namespace softscope
