// toolkit/report/metric_paths.h: paths of metrics in evaluation.json
// and comparison.json that several parts of a report use.
#pragma once

namespace softscope::metric_paths {

// In ReportCase::main(), frames and cohorts; mm.
constexpr const char* kMean = "mean_mm";
constexpr const char* kMedian = "median_mm";
constexpr const char* kP95 = "p95_mm";
constexpr const char* kMax = "max_mm";

// Against ground truth.
constexpr const char* kCompleteness = "surface.completeness_1mm";
constexpr const char* kSignedMean = "surface.signed.mean_mm";
constexpr const char* kSignedMeanOfPair = "signed.mean_mm";
constexpr const char* kHausdorff = "surface.hausdorff.";  // plus a key of hausdorffMetrics()
constexpr const char* kHausdorffOfPair = "hausdorff.";
constexpr const char* kHausdorffObserved = "observed.hausdorff.";

// Without ground truth.
constexpr const char* kPsnr = "view.psnr_db";
constexpr const char* kPsnrOverAll = "view.psnr_over_all_pixels_db";
constexpr const char* kSsim = "view.ssim";
constexpr const char* kJudgedShare = "view.judged_share";
constexpr const char* kBackProjection = "backprojection";  // statistics
constexpr const char* kBackProjectionMean = "backprojection.mean_mm";
constexpr const char* kDepthShare = "coverage.mean_share";
constexpr const char* kScopeMoved = "camera.moved_mm";
constexpr const char* kScopeStep = "camera.step";  // statistics

// Keys of a cohort.
constexpr const char* kCohortSignedMean = "signed_mean_mm";
constexpr const char* kCohortPsnr = "psnr_db";
constexpr const char* kCohortBackProjection = "backprojection_mean_mm";

}  // namespace softscope::metric_paths
