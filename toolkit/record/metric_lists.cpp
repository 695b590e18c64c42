#include "toolkit/record/metric_lists.h"

namespace softscope {

const MetricList<Statistics>& statisticsMetrics() {
  using S = const Statistics&;
  static const MetricList<Statistics> metrics{{"mean", [](S s) { return s.mean; }, "mean"},
                                              {"sd", [](S s) { return s.sd; }, "SD"},
                                              {"rmse", [](S s) { return s.rmse; }, "RMSE"},
                                              {"median", [](S s) { return s.median; }, "median"},
                                              {"p95", [](S s) { return s.p95; }, "P95"},
                                              {"max", [](S s) { return s.max; }, "max"}};
  return metrics;
}

const MetricList<HausdorffDistances>& hausdorffMetrics() {
  using H = const HausdorffDistances&;
  static const MetricList<HausdorffDistances> metrics{
      {"hd95_max_of_directed_mm", [](H h) { return h.hd95_max_of_directed_mm; },
       "HD95, larger of both directions"},
      {"hd95_pooled_mm", [](H h) { return h.hd95_pooled_mm; }, "HD95, both directions pooled"},
      {"hd95_mean_of_directed_mm", [](H h) { return h.hd95_mean_of_directed_mm; },
       "HD95, mean of both directions"},
      {"hd_mm", [](H h) { return h.hd_mm; }, "Hausdorff distance (largest of all)"},
      {"assd_mm", [](H h) { return h.assd_mm; }, "ASSD"},
      {"masd_mm", [](H h) { return h.masd_mm; }, "MASD"}};
  return metrics;
}

const MetricList<ModelErrors>& completenessMetrics() {
  using E = const ModelErrors&;
  static const MetricList<ModelErrors> metrics{
      {"completeness_1mm", [](E e) { return e.both.share; }},
      {"left_completeness_1mm", [](E e) { return e.left.share; }},
      {"not_reconstructed_share", [](E e) { return 1 - e.both.share; }}};
  return metrics;
}

const MetricList<DepthErrors>& drawnDepthMetrics() {
  using D = const DepthErrors&;
  static const MetricList<DepthErrors> metrics{
      {"mean_mm", [](D d) { return d.absolute_mm.mean; }},
      {"median_mm", [](D d) { return d.absolute_mm.median; }},
      {"rmse_mm", [](D d) { return d.absolute_mm.rmse; }},
      {"bad_3mm_percent", [](D d) { return d.bad_percent[0]; }},
      {"coverage_percent", [](D d) { return d.coverage_percent; }}};
  return metrics;
}

const MetricList<PictureErrors>& drawnViewMetrics() {
  using P = const PictureErrors&;
  static const MetricList<PictureErrors> metrics{
      {"psnr_db", [](P p) { return p.psnr_db; }},
      {"psnr_over_all_pixels_db", [](P p) { return p.psnr_over_all_pixels_db; }},
      {"ssim", [](P p) { return p.ssim; }},
      {"judged_share", [](P p) { return p.judged_share; }}};
  return metrics;
}

}  // namespace softscope
