#include "pipeline/frame/match_stage.h"

#include "features/matcher.h"
#include "features/model_view.h"

namespace softscope {
namespace {

class CpuMatchStage final : public MatchStage {
 public:
  CpuMatchStage(const ReconstructionOptions& options, const RectifiedRig& rig)
      : matcher_(makeFeatureMatcher(options.matcher)), view_(options.model_view), left_(rig.left) {}
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const MatchPicture& live,
                     const MeasuredFrame& frame, StageClock* clock) override;

 private:
  std::unique_ptr<FeatureMatcher> matcher_;
  ModelViewOptions view_;
  PinholeCamera left_;
};

ModelMatches CpuMatchStage::match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                                  const GrayImage& seen_gray, const MatchPicture& live,
                                  const MeasuredFrame& frame, StageClock* clock) {
  const ModelView view = renderModelView(model, left_, viewed_from, view_);
  clock->lap("view");
  MatchPicture picture = modelPicture(view);
  if (!seen_gray.empty()) picture = {seen_gray, picture.ignore};
  ModelMatches found = matchModel(view, picture, live, frame, *matcher_);
  clock->lap("match");
  return found;
}

}  // namespace

std::unique_ptr<MatchStage> makeCpuMatchStage(const ReconstructionOptions& options,
                                              const RectifiedRig& rig) {
  return std::make_unique<CpuMatchStage>(options, rig);
}

}  // namespace softscope
