// tests/fuzz/dataset_fuzz.cpp: files of known data sets: STIR 2026, SurgT, SCARED, StereoMIS,
// C3VD.
#include <cmath>

#include "fuzz/fuzz_target.h"
#include "io/datasets/c3vd_files.h"
#include "io/datasets/stereomis_files.h"
#include "io/datasets/stir_files.h"
#include "io/datasets/surgt_files.h"
#include "io/geometry/xyz_files.h"

namespace softscope::test {
namespace {

void mustBeSound(const StirAnnotations& annotations) noexcept {
  for (const auto& [frame, points] : annotations) {
    mustHold(frame >= 0 && points.size() == annotations.begin()->second.size());
    for (const StirPoint& point : points)
      mustHold(std::isfinite(point.left_u_px) && std::isfinite(point.disparity_px));
  }
  mustHold(parseStirAnnotations(stirAnnotationsJson(annotations), "again").size() ==
           annotations.size());
}

void mustBeSound(const std::vector<SurgtFrame>& frames) noexcept {
  for (const SurgtFrame& frame : frames) {
    mustHold(frame.boxes || !frame.visible_in_both);
    if (frame.boxes) mustHold((*frame.boxes)[0][2] > 0 && (*frame.boxes)[1][3] > 0);
  }
  if (!frames.empty())
    mustHold(parseSurgtTruth(surgtTruthYaml(frames), "again").size() == frames.size());
}

}  // namespace
}  // namespace softscope::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view text = textOf(data, size);
  if (const auto found = answerOf([&] { return parseStirAnnotations(text, "fuzz"); }))
    mustBeSound(*found);
  answerOf([&] { return parseStirQueries(text, "fuzz"); });
  if (const auto found = answerOf([&] { return parseSurgtTruth(text, "fuzz"); }))
    mustBeSound(*found);
  if (const auto found = answerOf([&] { return parseSurgtInfo(text, "fuzz"); }))
    mustHold(found->width_px > 0 && found->video.find('/') == std::string::npos);
  if (const auto found = answerOf([&] { return parseStereoMisSplit(text, "fuzz"); }))
    for (const FrameRange& range : *found) mustHold(range.begin >= 0 && range.end > range.begin);
  if (const auto found = answerOf([&] { return parseStereoMisPath(text, "fuzz"); }))
    mustHold(!found->empty() && found->begin()->first >= 0);
  if (const auto found = answerOf([&] { return parseC3vdPath(text, "fuzz"); })) {
    mustHold(!found->empty());
    for (const Eigen::Isometry3d& pose : *found)
      mustHold(pose.matrix().allFinite() && pose.linear().isUnitary(1e-6));
  }
  if (const auto found = answerOf([&] { return parsePointRaster(text, "fuzz"); }))
    for (const Eigen::Vector3f& p : found->values) mustHold(p.allFinite() || std::isnan(p.z()));
  return 0;
}
