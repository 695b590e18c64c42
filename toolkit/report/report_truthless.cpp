// toolkit/report/report_truthless.cpp: similarity and stability, which are not accuracy.
#include "toolkit/report/report_truthless.h"

#include <cmath>

#include "toolkit/report/metric_paths.h"
#include "toolkit/report/report_plots.h"
#include "toolkit/report/report_words.h"
#include "vtk_views/plots/value_series_plot.h"

namespace softscope {
namespace {

std::string decibels(double value) {
  return std::isfinite(value) ? fixed(value, 1) + " dB" : "not measured";
}

void addFigure(const CaseFrames& frames, const std::string& key, const std::string& label,
               const std::string& caption, std::vector<CaptionedFigure>& figures) {
  ValueSeriesData data{frames.x_label, label, {}, {}};
  for (const auto& [x, value] : frames.series(key)) {
    data.x.push_back(x);
    data.y.push_back(value);
  }
  if (statistics(data.y).count < 2) return;
  PlotStyle style;
  style.height_mm = 42;
  figures.emplace_back(withOutcomeStrip(outcomeStrip(frames), drawValueSeries(data, style), style),
                       caption);
}

ReportTable viewTable(const ReportCase& c) {
  ReportTable table = valueTable(
      "Model rendered from the pose of the run, compared with the image", "mean", c.record,
      {{"PSNR over the pixels covered by the model [dB]", metric_paths::kPsnr},
       {"the same, every other pixel counted as correct [dB]", metric_paths::kPsnrOverAll},
       {"SSIM", metric_paths::kSsim}});
  if (const double share = numberAt(c.record, metric_paths::kJudgedShare); std::isfinite(share))
    table.rows.push_back({"tissue covered by the model", percentText(share)});
  if (const double share = numberAt(c.record, metric_paths::kDepthShare); std::isfinite(share))
    table.rows.push_back({"tissue with depth, as reported by the run", percentText(share)});
  return table;
}

ReportTable pathTable(const ReportCase& c) {
  return valueTable("Estimated camera path", "value", c.record,
                    {{"moved from first to last fused frame [mm]", metric_paths::kScopeMoved},
                     {"turned from first to last fused frame [degrees]", "camera.turned_deg"},
                     {"jitter, rms of second differences [mm]", "camera.jitter_rms_mm"}});
}

/// "surface errors; errors of material points": the text before each colon of `missing`.
std::string missingText(const ReportCase& c) {
  std::string text;
  if (!c.record.contains("missing") || !c.record["missing"].is_array()) return text;
  for (const auto& lack : c.record["missing"]) {
    if (!lack.is_string()) continue;
    const std::string whole = lack.get<std::string>();
    text += (text.empty() ? "" : "; ") + whole.substr(0, whole.find(':'));
  }
  return text;
}

}  // namespace

std::string drawnViewCaption(const ReportCase& c) {
  const auto value = [&](const char* key) {
    return numberAt(c.record, std::string("drawn_view.") + key);
  };
  const auto whole = [](double number) { return std::to_string(std::llround(number)); };
  std::string text = "Left: the video's image";
  if (std::isfinite(value("frame"))) text += " of frame " + whole(value("frame"));
  text += ". Right: the model, rendered from the estimated pose; grey without a model.";
  if (std::isfinite(value("covers_share")))
    text += " It covers " + percentText(value("covers_share")) + " of the visible tissue.";
  const double age = value("age_frames");
  if (age == 0) text += " It is the last frame of the run.";
  if (age > 0)
    text += " It is " + whole(age) + (age == 1 ? " frame" : " frames") +
            " old: no later model was fused or saved.";
  return text;
}

ReportParagraph truthlessHeadline(const ReportCase& c) {
  std::string text =
      "There is no ground truth: the distance of the model from the tissue is unknown.";
  if (const double psnr_db = numberAt(c.record, metric_paths::kPsnr); std::isfinite(psnr_db))
    text +=
        " Rendered from the estimated pose, it resembles the images of the video with a PSNR of " +
        decibels(psnr_db) + ".";
  if (const double mean_mm = numberAt(c.record, metric_paths::kBackProjectionMean);
      std::isfinite(mean_mm))
    text += " Visible points are " + millimetresText(mean_mm) +
            " on average from the depth used for the model (back-projection).";
  return {text, /*important=*/true};
}

std::string truthlessSummary(const ReportCase& c) {
  return "no ground truth; PSNR " + decibels(numberAt(c.record, metric_paths::kPsnr)) +
         ", back-projection " +
         millimetresText(numberAt(c.record, metric_paths::kBackProjectionMean));
}

ReportTiles truthlessTiles(const ReportCase& c) {
  const auto value = [&](const char* path) { return numberAt(c.record, path); };
  return {{{"PSNR of the rendered view", decibels(value(metric_paths::kPsnr)),
            "over " + percentText(value(metric_paths::kJudgedShare)) + " of the tissue"},
           {"Back-projection", millimetresText(value(metric_paths::kBackProjectionMean)),
            "as reported by the run; not an accuracy"},
           {"Tissue with depth", percentText(value(metric_paths::kDepthShare)),
            "as reported by the run"},
           {"Scope moved", millimetresText(value(metric_paths::kScopeMoved)),
            "first to last fused frame; drift for a static scope"}}};
}

std::vector<ReportTable> truthlessTables(const ReportCase& c) {
  return {
      viewTable(c), heldOutTable(c.record),
      statisticsTable("Over the frames [mm]", c.record,
                      {{"back-projection, as reported by the run", metric_paths::kBackProjection},
                       {"camera step from frame to frame", metric_paths::kScopeStep}}),
      pathTable(c)};
}

std::vector<CaptionedFigure> truthlessFigures(const ReportCase& c) {
  std::vector<CaptionedFigure> figures;
  const CaseFrames frames = framesOf(c);
  addFigure(frames, "view_psnr_db", "PSNR [dB]", "The rendered model and the image.", figures);
  addFigure(frames, "view_ssim", "SSIM", "Structural similarity: 1 for equal images.", figures);
  addFigure(frames, "backprojection_mean_mm", "back-projection [mm]",
            "Distance of the visible model from the depth of that frame.", figures);
  addFigure(frames, "step_mm", "camera step [mm]", "Camera motion since the previous frame.",
            figures);
  return figures;
}

std::vector<std::string> truthlessLimits(const ReportCase& c) {
  std::vector<std::string> limits{
      "These values distinguish a bad run from a good one, but do not measure the distance from "
      "the tissue: a model that slides along the surface can have good values.",
      "Back-projection is the distance from the depth of the run itself: an error common to depth "
      "and model, of calibration or of stereo, is not included.",
      "A motion of all tissue together is interpreted as one of the scope. Only for a static scope "
      "is its estimated motion an error."};
  if (const std::string missing = missingText(c); !missing.empty())
    limits.push_back("Not measured, because ground truth is required: " + missing + ".");
  return limits;
}

std::vector<std::string> truthlessMethods() {
  return {
      "PSNR and SSIM: each saved model rendered from the estimated pose, against the left image of "
      "that frame, over the pixels covered by the model, without masks and black borders. Over all "
      "pixels: the same differences averaged over the whole image, which increases the value for a "
      "small coverage. SSIM: windows of 11 x 11, sigma 1.5.",
      "Two shares of the tissue, without masks and black borders: that of the depth is of each "
      "frame, that of the model of the frames with a saved model. The share of the model is larger "
      "if earlier frames saw tissue that this frame did not measure, and smaller if a depth was "
      "too uncertain, or not yet confirmed by a second frame.",
      kBackProjectionMeaning,
      "Jitter: root mean square of the second differences of the camera positions."};
}

}  // namespace softscope
