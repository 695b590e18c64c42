// eval/alignment/landmark_errors.cpp: fit of all landmarks, and fits without each.
#include "eval/alignment/landmark_errors.h"

#include "core/error.h"

namespace softscope {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points without(const Points& points, std::size_t left_out) {
  Points rest = points;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
  return rest;
}

}  // namespace

LandmarkErrors landmarkErrors(const Points& test_mm, const Points& reference_mm) {
  LandmarkErrors errors;
  errors.fit = fitRigid(test_mm, reference_mm);
  if (!errors.fit.unique)
    throw InputError(
        "the landmarks are collinear, so the rotation about their line is undetermined; add one "
        "outside of it");
  std::vector<double> fre_mm, tre_mm;
  for (std::size_t i = 0; i < test_mm.size(); ++i) {
    fre_mm.push_back((errors.fit.target_from_source * test_mm[i] - reference_mm[i]).norm());
    if (test_mm.size() < 4) continue;
    const RigidFit others = fitRigid(without(test_mm, i), without(reference_mm, i));
    tre_mm.push_back(others.unique
                         ? (others.target_from_source * test_mm[i] - reference_mm[i]).norm()
                         : Statistics::kNone);
  }
  errors.fre_mm = statistics(fre_mm);
  errors.tre_mm = statistics(tre_mm);
  return errors;
}

}  // namespace softscope
