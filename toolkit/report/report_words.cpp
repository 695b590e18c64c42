// toolkit/report/report_words.cpp: common number format.
#include "toolkit/report/report_words.h"

#include <cmath>

#include "toolkit/record/metric_lists.h"

namespace softscope {
namespace {

const char* const kDash = "\xE2\x80\x93";
constexpr double kThreeDecimals = 0.0005;  // smaller values would be 0 in three decimals

std::string countText(double count) {
  return std::isfinite(count) ? std::to_string(std::llround(count)) : kDash;
}

}  // namespace

const char* const kBackProjectionMeaning =
    "Back-projection: depth of the model, rendered after the fusion of a frame, minus the depth of "
    "the frame; mean absolute value over the pixels with a model and an accepted depth, then the "
    "mean over the fused frames after the first.";

std::string numberText(double value) {
  if (!std::isfinite(value)) return kDash;
  const double size = std::abs(value);
  if (size > 1e-9 && size < kThreeDecimals)  // else a drift of micrometres would appear as 0.000
    return fixed(value, 1 - static_cast<int>(std::floor(std::log10(size))));
  return fixed(value + 0.0, size < 1 ? 3 : size < 100 ? 2 : 1);
}

std::string millimetresText(double value) {
  return std::isfinite(value) ? numberText(value) + " mm" : "not measured";
}

std::string percentText(double share) {
  return std::isfinite(share) ? fixed(100 * share, 1) + " %" : kDash;
}

std::string intervalText(const Interval& interval) {
  return std::isfinite(interval.low) && std::isfinite(interval.high)
             ? numberText(interval.low) + " to " + numberText(interval.high)
             : kDash;
}

ReportTable statisticsTable(const std::string& caption, const FactSheet::Json& record,
                            const std::vector<NamedPart>& parts) {
  ReportTable table{caption, {""}, {}, /*words=*/false};
  for (const Metric<Statistics>& metric : statisticsMetrics())
    table.headings.push_back(metric.name);
  table.headings.push_back("n");
  for (const NamedPart& part : parts) {
    const auto value = [&](const std::string& key) {
      return numberAt(record, part.path + "." + key);
    };
    if (!std::isfinite(value("mean_mm"))) continue;
    std::vector<std::string> row{part.name};
    for (const Metric<Statistics>& metric : statisticsMetrics())
      row.push_back(numberText(value(metric.key + std::string("_mm"))));
    row.push_back(countText(value("n")));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable valueTable(const std::string& caption, const std::string& heading,
                       const FactSheet::Json& record, const std::vector<NamedPart>& values) {
  ReportTable table{caption, {"", heading}, {}, /*words=*/false};
  for (const NamedPart& part : values)
    if (const double value = numberAt(record, part.path); std::isfinite(value))
      table.rows.push_back({part.name, numberText(value)});
  return table;
}

void addTable(ReportTable table, std::vector<ReportPart>& parts) {
  if (!table.rows.empty()) parts.emplace_back(std::move(table));
}

ReportTable heldOutTable(const FactSheet::Json& record) {
  ReportTable table = valueTable(
      "Held-out views: the model of the previous frame, rendered for frames that the run did not "
      "use",
      "mean", record,
      {{"PSNR over the pixels covered by the model [dB]", "held_out.psnr_db"},
       {"the same, every other pixel counted as correct [dB]", "held_out.psnr_over_all_pixels_db"},
       {"SSIM", "held_out.ssim"},
       {"control, the image of the previous frame: PSNR over the same pixels [dB]",
        "held_out.control.psnr_db"},
       {"control: SSIM", "held_out.control.ssim"}});
  if (const double views = numberAt(record, "held_out.views"); views > 0)
    table.caption += ", over " + countText(views) + (views == 1 ? " frame" : " frames");
  return table;
}

}  // namespace softscope
