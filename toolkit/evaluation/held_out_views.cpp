// toolkit/evaluation/held_out_views.cpp: rendered model against the image of the next frame.
#include "toolkit/evaluation/held_out_views.h"

#include <algorithm>
#include <cmath>

#include "io/text/message.h"
#include "toolkit/record/metric_lists.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

bool drawOne(const JudgedRun& run, const Raster<float>& no_depth, ViewJudge& judge,
             HeldOutView& view) {
  const int before = view.frame - 1;
  const auto model = run.models.find(before);
  const auto at = std::lower_bound(run.frames.begin(), run.frames.end(), before);
  if (model == run.models.end() || at == run.frames.end() || *at != before) return false;
  const Eigen::Isometry3d& pose =
      run.trajectory[static_cast<std::size_t>(at - run.frames.begin())].world_from_left;
  const ModelFile file = readModel(model->second);
  view.control = judge.judgeImage(file, pose, before, view.frame);
  view.picture = judge.judge(file, pose, view.frame, no_depth).picture;
  return std::isfinite(view.picture.judged_share);
}

double meanOf(const HeldOutResult& result, PictureErrors HeldOutView::*part,
              const Metric<PictureErrors>& metric) {
  std::vector<double> values;
  for (const HeldOutView& view : result.views) values.push_back(metric.of(view.*part));
  return statistics(values).mean;
}

Json meansJson(const HeldOutResult& result, PictureErrors HeldOutView::*part) {
  return metricsJson(drawnViewMetrics(), [&](const Metric<PictureErrors>& metric) {
    return meanOf(result, part, metric);
  });
}

}  // namespace

HeldOutResult judgeHeldOut(const JudgedRun& run, const SequenceTruth& pictures,
                           const std::function<bool()>& progress_continues) {
  HeldOutResult result;
  result.every = run.hold_out_every;
  if (result.every == 0 || run.frames.empty()) return result;
  ViewJudge judge(pictures);
  const PinholeCamera& left = pictures.rig.left;
  const Raster<float> no_depth(left.width_px, left.height_px, std::nanf(""));
  const int first = (run.frames.front() + result.every - 1) / result.every * result.every + 1;
  for (int frame = first; frame <= run.frames.back() + 1; frame += result.every) {
    HeldOutView view;
    view.frame = frame;
    if (drawOne(run, no_depth, judge, view))
      result.views.push_back(view);
    else if (frame < run.frames.back())  // else the clip may end before that frame
      result.not_drawn.push_back(frame);
    if (!progress_continues()) break;
  }
  return result;
}

Json heldOutJson(const HeldOutResult& result) {
  Json json{{"every", result.every}, {"views", result.views.size()}};
  json.update(meansJson(result, &HeldOutView::picture));
  json["control"] = meansJson(result, &HeldOutView::control);
  json["pixels"] = kPsnrMask;
  json["frames"] = Json::array();
  for (const HeldOutView& view : result.views) {
    Json row{{"frame", view.frame}};
    row.update(metricsJson(drawnViewMetrics(), view.picture));
    row["control_psnr_db"] = view.control.psnr_db;
    json["frames"].push_back(std::move(row));
  }
  return json;
}

void addHeldOutFacts(const HeldOutResult& result, FactSheet& facts) {
  if (result.every == 0) return;
  if (result.views.empty())
    return facts.addLine(
        "held-out views",
        "none rendered: no held-out frame has both a model of the previous frame and an image");
  const Json json = heldOutJson(result);
  const auto text = [](const Json& value, int decimals) {
    return value.is_number() ? fixed(value.get<double>(), decimals) : std::string("?");
  };
  facts.addLine("held-out views",
                say("PSNR ", text(json["psnr_db"], 1), " dB, SSIM ", text(json["ssim"], 3),
                    " over ", result.views.size(), " frames (one in every ", result.every,
                    ") that were not used by the run, each against the model of the previous "
                    "frame; pixels as above, ",
                    text(Json(100 * json.value("judged_share", 0.0)), 1), " % of the tissue"));
  facts.addLine("  control", "image of the previous frame: PSNR " +
                                 text(json["control"]["psnr_db"], 1) + " dB, SSIM " +
                                 text(json["control"]["ssim"], 3) + " over the same pixels");
}

std::vector<std::string> heldOutWarnings(const HeldOutResult& result) {
  if (result.not_drawn.empty()) return {};
  return {say(result.not_drawn.size(), " held-out frames, the first ", result.not_drawn.front(),
              ", have no model of the previous frame or no image, and are excluded from all "
              "held-out values")};
}

}  // namespace softscope
