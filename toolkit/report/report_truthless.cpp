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
  ReportTable table =
      valueTable("Model drawn from the run's own pose, beside the image", "mean", c.record,
                 {{"PSNR over the pixels that the model covers [dB]", metric_paths::kPsnr},
                  {"the same, every other pixel counted as right [dB]", metric_paths::kPsnrOverAll},
                  {"SSIM", metric_paths::kSsim}});
  if (const double share = numberAt(c.record, metric_paths::kJudgedShare); std::isfinite(share))
    table.rows.push_back({"tissue that the model covers", percentText(share)});
  if (const double share = numberAt(c.record, metric_paths::kDepthShare); std::isfinite(share))
    table.rows.push_back({"tissue that has depth, by the run itself", percentText(share)});
  return table;
}

ReportTable pathTable(const ReportCase& c) {
  return valueTable("The scope's path, as estimated", "value", c.record,
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
  text +=
      ". Right: the model, drawn from the pose that the run estimated; grey where it shows "
      "nothing.";
  if (std::isfinite(value("covers_share")))
    text += " It covers " + percentText(value("covers_share")) + " of the tissue in sight.";
  const double age = value("age_frames");
  if (age == 0) text += " It is of the run's last frame.";
  if (age > 0)
    text += " It is " + whole(age) + (age == 1 ? " frame" : " frames") +
            " old: of what the run saw later no model was fused or saved.";
  return text;
}

ReportParagraph truthlessHeadline(const ReportCase& c) {
  std::string text =
      "There is no ground truth: how far the model lies from the tissue is not known.";
  if (const double psnr_db = numberAt(c.record, metric_paths::kPsnr); std::isfinite(psnr_db))
    text +=
        " Drawn from the pose that the run estimated, it resembles the video's images with "
        "a PSNR of " +
        decibels(psnr_db) + ".";
  if (const double mean_mm = numberAt(c.record, metric_paths::kBackProjectionMean);
      std::isfinite(mean_mm))
    text += " In sight, it lies " + millimetresText(mean_mm) +
            " on average from the depth that it was made of (back-projection).";
  return {text, /*important=*/true};
}

std::string truthlessSummary(const ReportCase& c) {
  return "no ground truth; PSNR " + decibels(numberAt(c.record, metric_paths::kPsnr)) +
         ", back-projection " +
         millimetresText(numberAt(c.record, metric_paths::kBackProjectionMean));
}

ReportTiles truthlessTiles(const ReportCase& c) {
  const auto value = [&](const char* path) { return numberAt(c.record, path); };
  return {
      {{"PSNR of the drawn view", decibels(value(metric_paths::kPsnr)),
        "over " + percentText(value(metric_paths::kJudgedShare)) + " of the tissue"},
       {"Back-projection", millimetresText(value(metric_paths::kBackProjectionMean)),
        "by the run itself; no accuracy"},
       {"Tissue with depth", percentText(value(metric_paths::kDepthShare)), "by the run itself"},
       {"Scope moved", millimetresText(value(metric_paths::kScopeMoved)),
        "first to last fused frame; drift if it stood still"}}};
}

std::vector<ReportTable> truthlessTables(const ReportCase& c) {
  return {viewTable(c), heldOutTable(c.record),
          statisticsTable("Over the frames [mm]", c.record,
                          {{"back-projection, by the run itself", metric_paths::kBackProjection},
                           {"the scope's step from frame to frame", metric_paths::kScopeStep}}),
          pathTable(c)};
}

std::vector<CaptionedFigure> truthlessFigures(const ReportCase& c) {
  std::vector<CaptionedFigure> figures;
  const CaseFrames frames = framesOf(c);
  addFigure(frames, "view_psnr_db", "PSNR [dB]", "The drawn model beside the image.", figures);
  addFigure(frames, "view_ssim", "SSIM", "The same, by structure: 1 is the image itself.", figures);
  addFigure(frames, "backprojection_mean_mm", "back-projection [mm]",
            "Distance of the model in sight from the depth of that frame.", figures);
  addFigure(frames, "step_mm", "scope's step [mm]",
            "How far the scope moved since the frame before.", figures);
  return figures;
}

std::vector<std::string> truthlessLimits(const ReportCase& c) {
  std::vector<std::string> limits{
      "These values tell a bad run from a good one, never how far it is from the tissue: a model "
      "that slides along the surface can look right.",
      "Back-projection is the distance from the run's own depth: an error that depth and model "
      "share, of calibration or of stereo, is not in it.",
      "A motion of all tissue together is taken for one of the scope. Only where the scope is "
      "known to have stood still is its estimated motion an error."};
  if (const std::string missing = missingText(c); !missing.empty())
    limits.push_back("Not measured, because it takes ground truth: " + missing + ".");
  return limits;
}

std::vector<std::string> truthlessMethods() {
  return {
      "PSNR and SSIM: each saved model drawn from the pose that the run estimated, against the "
      "left image of that moment, over the pixels that the model covers, without masks and black "
      "borders. Over all pixels: the same differences shared out over the whole image, the higher "
      "the less is covered. SSIM: "
      "windows of 11 x 11, sigma 1.5.",
      "Two shares of the tissue, without masks and black borders: the depth's is of each frame by "
      "itself, the model's of the moments for which a model was saved. The model shows more than "
      "the depth where earlier frames saw tissue that this one did not measure, and less where a "
      "depth was too uncertain, or not yet the same in two frames in a row, to become part of it.",
      kBackProjectionMeaning,
      "Jitter: root mean square of the second differences of the scope's positions."};
}

}  // namespace softscope
