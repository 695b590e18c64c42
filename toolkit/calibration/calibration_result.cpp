#include "toolkit/calibration/calibration_result.h"

#include <algorithm>
#include <cmath>

#include "io/calibrations/calibration_reader.h"
#include "io/calibrations/calibration_writer.h"
#include "io/text/message.h"
#include "toolkit/record/statistics_json.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

constexpr Rgb8 kBehind{40, 40, 44}, kEmpty{96, 32, 32}, kDot{120, 220, 120}, kLine{70, 70, 76};
constexpr int kGapPx = 8;

std::string wholePercent(double share) { return fixed(100 * share, 0) + " %"; }

/// Number of digits according to the half width of the interval.
std::string withInterval(const ParameterInterval& one) {
  const int digits =
      one.half_width > 0
          ? std::clamp(2 - static_cast<int>(std::ceil(std::log10(one.half_width))), 0, 8)
          : 4;
  return fixed(one.value, digits) + " +- " + fixed(one.half_width, digits);
}

const ParameterInterval& named(const CalibrationReport& report, const std::string& name) {
  return *std::find_if(report.intervals.begin(), report.intervals.end(),
                       [&](const ParameterInterval& one) { return one.name == name; });
}

void drawCells(const std::vector<int>& counts, const PinholeCamera& camera, int u0,
               ColourImage* image) {
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const int column = u * kCellsAcross / camera.width_px,
                row = v * kCellsDown / camera.height_px;
      const bool rim = (u + 1) * kCellsAcross / camera.width_px != column ||
                       (v + 1) * kCellsDown / camera.height_px != row;
      const int count = counts[static_cast<std::size_t>(row * kCellsAcross + column)];
      image->at(u0 + u, v) = rim ? kLine : count == 0 ? kEmpty : kBehind;
    }
}

void drawDot(double u, double v, int u0, int width_px, ColourImage* image) {
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du) {
      const int x = static_cast<int>(std::lround(u)) + du,
                y = static_cast<int>(std::lround(v)) + dv;
      if (x >= 0 && x < width_px && y >= 0 && y < image->height_px) image->at(u0 + x, y) = kDot;
    }
}

void addIntervals(const CalibrationReport& report, FactSheet* facts) {
  for (const char* name : {"left.fx_px", "left.fy_px", "right.fx_px", "right.fy_px", "baseline_mm"})
    facts->addLine(name, withInterval(named(report, name)) + "  (95 %)");
  for (const ParameterInterval& one : report.intervals)
    facts->addQuietly("parameters." + one.name,
                      Json{{"value", one.value}, {"half_width_95", one.half_width}});
}

void addDepths(const CalibrationReport& report, FactSheet* facts) {
  Json list = Json::array();
  for (const DepthOutlook& one : report.depths) {
    facts->addLine("depth at " + fixed(one.distance_mm, 0) + " mm",
                   "sigma " + fixed(one.sigma_mm, 2) +
                       " mm (disparity sigma 0.25 px), bias below " + fixed(one.bias_95_mm, 2) +
                       " mm (95 %)");
    list.push_back({{"distance_mm", one.distance_mm},
                    {"sigma_mm", one.sigma_mm},
                    {"bias_95_mm", one.bias_95_mm}});
  }
  facts->addQuietly("depth", list);
}

void addRowOutlook(const RowOutlook& outlook, FactSheet* facts) {
  const Eigen::Vector2d& at = outlook.worst_at_px;
  facts->add("rows expected",
             say("within ", fixed(outlook.median_95_px, 3), " px over half of the image, ",
                 fixed(outlook.worst_95_px, 3), " px at worst, in column ", fixed(at.x(), 0),
                 ", row ", fixed(at.y(), 0), " (95 %)"),
             "row_error.expected_worst_95_px", orNull(outlook.worst_95_px));
  facts->addQuietly("row_error.expected_median_95_px", orNull(outlook.median_95_px));
  facts->addQuietly("row_error.expected_worst_at_px", {at.x(), at.y()});
}

void addViews(const CalibrationReport& report, FactSheet* facts) {
  Json used = Json::array(), left_out = Json::array();
  for (const SolvedView& view : report.solution.views)
    used.push_back({{"frame", view.frame},
                    {"rms_px", view.rms_px},
                    {"tilt_deg", view.tilt_deg},
                    {"distance_mm", view.distance_mm}});
  std::size_t listed = 0;
  for (const LeftOutView& view : report.left_out) {
    left_out.push_back({{"frame", view.frame}, {"why", view.why}});
    if (listed++ < 12)
      facts->addLine("left out", "frame " + std::to_string(view.frame) + ": " + view.why);
  }
  if (listed > 12)
    facts->addLine("left out", std::to_string(listed - 12) + " more: --json lists them");
  facts->addQuietly("views.used", used);
  facts->addQuietly("views.left_out", left_out);
}

}  // namespace

CalibrationReport calibrateFromFilm(const BoardFilm& film, const BoardOptions& board,
                                    const SolveOptions& options,
                                    const std::vector<double>& distances_mm) {
  CalibrationReport report;
  ViewChoiceOptions choice_options;
  choice_options.least_shift_px = 0.015 * film.width_px;
  const ViewChoice choice = chooseViews(film.sightings, choice_options);
  std::vector<BoardSighting> used;
  for (const std::size_t i : choice.used) used.push_back(film.sightings[i]);
  report.solution = solveStereo(used, board, film.width_px, film.height_px, options);
  report.left_out = choice.left_out;
  report.left_out.insert(report.left_out.end(), report.solution.left_out.begin(),
                         report.solution.left_out.end());
  std::sort(report.left_out.begin(), report.left_out.end(),
            [](const LeftOutView& a, const LeftOutView& b) { return a.frame < b.frame; });
  report.warnings =
      parseCalibration(calibrationYaml(report.solution.calibration()), "the solution").warnings;
  report.intervals = parameterIntervals(report.solution);
  report.rows = rowErrors(report.solution);
  report.row_outlook = rowOutlook(report.solution);
  report.coverage = boardCoverage(report.solution);
  for (const double distance_mm : distances_mm)
    report.depths.push_back(depthOutlook(report.solution, distance_mm));
  report.advice = imagingAdvice(report.solution, report.coverage);
  return report;
}

std::string calibrationText(const CalibrationReport& report) {
  std::string text = calibrationYaml(report.solution.calibration());
  text += say("quality:\n   rms_px: ", report.solution.summary.rms_px,
              "\n   views: ", report.solution.views.size(),
              "\n   row_error_rms_px: ", report.rows.rms_px,
              "\n   row_error_worst_95_px: ", report.row_outlook.worst_95_px,
              "\n   left_coverage: ", report.coverage.left_share,
              "\n   right_coverage: ", report.coverage.right_share, "\n");
  for (ParameterInterval one : report.intervals) {
    std::replace(one.name.begin(), one.name.end(), '.', '_');
    text += say("   ", one.name, "_half_width_95: ", one.half_width, "\n");
  }
  return text;
}

ColourImage coverageImage(const CalibrationReport& report) {
  const BundleState& state = report.solution.state;
  const int width = state.left.pinhole.width_px, height = state.left.pinhole.height_px;
  ColourImage image(2 * width + kGapPx, height, Rgb8{255, 255, 255});
  drawCells(report.coverage.left_counts, state.left.pinhole, 0, &image);
  drawCells(report.coverage.right_counts, state.right.pinhole, width + kGapPx, &image);
  for (const BundleView& view : state.views)
    for (const BundlePoint& point : view.points)
      drawDot(point.pixel.x(), point.pixel.y(), point.is_right ? width + kGapPx : 0, width, &image);
  return image;
}

FactSheet calibrationFacts(const CalibrationReport& report, const BoardFilm& film) {
  FactSheet facts("calibration");
  const CalibrationSolution& solution = report.solution;
  facts.add("image", say(film.width_px, " x ", film.height_px, " px"), "image_px",
            {film.width_px, film.height_px});
  facts.add(
      "frames",
      say(film.frames, " looked at, ", film.sightings.size(), " with the board in both views"),
      "frames", film.frames);
  facts.addQuietly("frames_with_board", film.sightings.size());
  facts.add("views used", "views_used", static_cast<int>(solution.views.size()));
  facts.add("RMS", fixed(solution.summary.rms_px, 3) + " px", "rms_px", solution.summary.rms_px);
  facts.addQuietly("converged", solution.summary.converged);
  facts.addQuietly("corners_left_out", solution.corners_left_out);
  addIntervals(report, &facts);
  facts.add("row error",
            fixed(report.rows.rms_px, 3) + " px RMS of single corners, " +
                fixed(report.rows.worst_region_px, 3) + " px in the worst ninth",
            "row_error.rms_px", report.rows.rms_px);
  facts.addQuietly("row_error.worst_region_px", orNull(report.rows.worst_region_px));
  Json regions = Json::array();
  for (const double mean : report.rows.region_mean_px) regions.push_back(orNull(mean));
  facts.addQuietly("row_error.region_mean_px", regions);
  addRowOutlook(report.row_outlook, &facts);
  addDepths(report, &facts);
  facts.add("coverage",
            wholePercent(report.coverage.left_share) + " of the left image, " +
                wholePercent(report.coverage.right_share) + " of the right one",
            "coverage.left", report.coverage.left_share);
  facts.addQuietly("coverage.right", report.coverage.right_share);
  addViews(report, &facts);
  for (const std::string& line : report.advice) facts.addLine("film more", line);
  facts.addQuietly("film_more", report.advice);
  for (const std::string& line : film.unreadable) facts.warn(line);
  for (const std::string& line : report.warnings) facts.warn(line);
  if (!solution.summary.converged)
    facts.warn("the solution has not converged; the values above are those of its last step");
  return facts;
}

}  // namespace softscope
