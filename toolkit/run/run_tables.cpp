#include "toolkit/run/run_tables.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/decimal_number.h"
#include "core/error.h"
#include "io/text/text_lines.h"
#include "toolkit/record/path_words.h"

namespace softscope {
namespace {

constexpr const char* kColumns =
    "frame,time_s,status,points,nodes,matches,inliers,backprojection_mean_mm,"
    "backprojection_p95_mm,prediction_mean_mm,prediction_p95_mm,confidence,depth_agreement,image_"
    "agreement,coverage,depth_sigma_mm,precise_share,precise_tracks_share,"
    "row_difference_px,lifted,pose_rms_mm,scope_static,scope_moved_mm,pose_sigma_mm,pose_sigma_deg,"
    "solver_stop,solver_iterations,"
    "residual_before_mm,"
    "residual_mm,in_sight,seen,fused,inserted,contradicted,map";

/// Cells of one row, separated by commas.
class CsvLine {
 public:
  void add(int value) { addText(std::to_string(value)); }
  void add(double value, int decimals) {
    addText(std::isfinite(value) ? fixedText(value, decimals) : "");
  }
  void addText(const std::string& text) {
    if (!text_.empty() || begun_) text_ += ',';
    begun_ = true;
    text_ += text;
  }
  void skip(int cells) {
    for (int i = 0; i < cells; ++i) addText("");
  }
  std::string ended() const { return text_ + '\n'; }

 private:
  std::string text_;
  bool begun_ = false;
};

/// Quoted as in RFC 4180; one line.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + '"';
}

/// With names of files, as in all records.
std::string recordedReason(const std::string& reason) {
  if (reason.empty()) return reason;
  return withoutFolders(reason, std::filesystem::current_path().string());
}

std::vector<std::string> cellsOfLine(std::string_view line) {
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (const char c : line) {
    if (c == '"') in_quotes = !in_quotes;
    if (c == ',' && !in_quotes)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// Of frames.csv.
const std::vector<std::string>& columns() {
  static const std::vector<std::string> all = cellsOfLine(framesCsvHeading());
  return all;
}

std::size_t columnOf(const std::string& name) {
  return static_cast<std::size_t>(std::find(columns().begin(), columns().end(), name) -
                                  columns().begin());
}

/// Limits implausibly large and infinite values, which would distort the sums of the run.
template <class Number>
Number numberIn(const std::string& cell, Number otherwise, const std::string& file) {
  constexpr double kLargest = 1e12;
  if (cell.empty()) return otherwise;
  if (const auto value = decimalNumber<Number>(cell); value && std::abs(double(*value)) <= kLargest)
    return *value;
  throw InputError(file + ": a cell holds `" + cell +
                   "`, but a number of at most 1e12 is expected; start again without `resume=`");
}

FrameStatus statusNamed(const std::string& name, const std::string& file) {
  if (const auto status = frameStatusNamed(name)) return *status;
  throw InputError(file + ": a frame has an unknown status; start again without `resume=`");
}

double timeOf(const FrameRecord& record, const std::string& stage) {
  for (const auto& [name, elapsed_ms] : record.times)
    if (name == stage) return elapsed_ms;
  return 0;
}

void addSolver(const FrameRecord& record, CsvLine& line) {
  const DeformSummary& solver = record.warp.solver;
  const bool ran =
      record.status == FrameStatus::kFused || record.status == FrameStatus::kRecovered ||
      record.status == FrameStatus::kSkippedResidual || record.status == FrameStatus::kUnconfirmed;
  if (!ran) return line.skip(5);
  line.addText(toString(solver.reason));
  line.add(solver.iterations);
  line.add(solver.data_mean_mm_before, 4);
  line.add(solver.data_mean_mm_after, 4);
  line.add(record.warp.in_sight);
}

}  // namespace

const std::vector<std::string>& timedStages() {
  static const std::vector<std::string> stages{"depth",   "mask",  "view", "match", "pose", "graph",
                                               "visible", "solve", "warp", "fuse",  "check"};
  return stages;
}

std::string framesCsvHeading() {
  std::string heading = kColumns;
  for (const std::string& stage : timedStages()) heading += "," + stage + "_ms";
  return heading + ",total_ms,reason";
}

std::string tracksCsvHeading() { return "frame,id,x_mm,y_mm,z_mm,visible,sigma_mm"; }

std::string imagesCsvHeading() { return "frame,number,left,right"; }

std::string imagesCsvLine(int frame, const FrameNames& names) {
  CsvLine line;
  line.add(frame);
  line.addText(std::to_string(names.number));
  line.addText(quoted(names.left));
  line.addText(names.right.empty() ? "" : quoted(names.right));
  return line.ended();
}

std::string framesCsvLine(const FrameRecord& record) {
  CsvLine line;
  line.add(record.frame);
  line.add(record.time_s, 6);
  line.addText(toString(record.status));
  line.add(record.points);
  line.add(record.warp.nodes);
  line.add(record.matches.matches);
  line.add(record.pose.inliers);
  line.add(record.fusion.corrected.mean_mm, 4);
  line.add(record.fusion.corrected.p95_mm, 4);
  line.add(record.evidence.predicted.mean_mm, 4);
  line.add(record.evidence.predicted.p95_mm, 4);
  line.add(record.confidence(), 3);
  line.add(record.evidence.view.depth_share, 3);
  line.add(record.evidence.view.image_share, 3);
  line.add(record.depth.coverage(), 4);
  line.add(record.depth.median_sigma_mm, 4);
  line.add(record.depth.precise_share, 3);
  line.add(record.precise_tracks_share, 3);
  line.add(record.depth.row_difference_px, 3);
  line.add(record.matches.lifted);
  line.add(record.pose.rms_mm, 4);
  if (record.pose.found)
    line.add(record.pose.scope_static ? 1 : 0);
  else
    line.skip(1);
  line.add(record.pose.moved_mm, 4);
  line.add(record.pose.sigma_mm, 4);
  line.add(record.pose.sigma_deg, 4);
  addSolver(record, line);
  line.add(record.fusion.seen);
  line.add(record.fusion.fused);
  line.add(record.fusion.inserted);
  line.add(record.fusion.contradicted);
  line.add(record.map);
  for (const std::string& stage : timedStages()) line.add(timeOf(record, stage), 2);
  line.add(record.elapsed_ms(), 2);
  line.addText(quoted(recordedReason(record.reason)));
  return line.ended();
}

std::string moveRows(const std::string& rows, const MapJoin& join) {
  const std::size_t map = columnOf("map");
  std::string moved;
  for (const std::string_view row : linesOf(rows)) {
    if (row.empty()) continue;
    std::vector<std::string> cells = cellsOfLine(row);
    if (map < cells.size() && cells[map] == std::to_string(join.from))
      cells[map] = std::to_string(join.into);
    CsvLine line;
    for (const std::string& cell : cells) line.addText(cell);
    moved += line.ended();
  }
  return moved;
}

FrameRecord readFramesCsvLine(std::string_view line, const std::string& name) {
  const std::vector<std::string> cells = cellsOfLine(line);
  if (cells.size() != columns().size())
    throw InputError(name + ": a line has " + std::to_string(cells.size()) + " cells, but " +
                     std::to_string(columns().size()) +
                     " are expected; start again without `resume=`");
  const auto cell = [&](const std::string& column) -> const std::string& {
    return cells[columnOf(column)];
  };
  FrameRecord record;
  const auto whole = [&](const char* column) { return numberIn(cell(column), 0, name); };
  const auto real = [&](const std::string& column) {
    return numberIn(cell(column), kUnknown, name);
  };
  record.frame = whole("frame");
  record.status = statusNamed(cell("status"), name);
  record.points = whole("points");
  record.map = whole("map");
  record.warp.nodes = whole("nodes");
  record.pose.inliers = whole("inliers");
  record.pose.found = !cell("scope_static").empty();
  record.pose.scope_static = cell("scope_static") == "1";
  record.depth.precise_share = real("precise_share");
  record.precise_tracks_share = real("precise_tracks_share");
  record.evidence.view.depth_share = real("depth_agreement");
  record.evidence.view.image_share = real("image_agreement");
  record.fusion.corrected.mean_mm = real("backprojection_mean_mm");
  record.evidence.predicted.mean_mm = real("prediction_mean_mm");
  for (const std::string& stage : timedStages())
    if (const double elapsed_ms = real(stage + "_ms"); elapsed_ms > 0)
      record.times.emplace_back(stage, elapsed_ms);
  return record;
}

FrameRecord asTabled(const FrameRecord& record) {
  std::string line = framesCsvLine(record);
  line.pop_back();  // end of line
  FrameRecord tabled = readFramesCsvLine(line, "frames.csv");
  tabled.join = record.join;
  return tabled;
}

std::string tracksCsvLines(const FrameRecord& record) {
  std::string lines;
  for (const TrackedPosition& point : record.tracked) {
    lines += std::to_string(record.frame) + ',' + std::to_string(point.id);
    for (const double coordinate_mm : point.position_mm) lines += ',' + fixedText(coordinate_mm, 4);
    lines += point.visible ? ",1," : ",0,";
    lines += fixedText(point.sigma_mm, 4) + '\n';
  }
  return lines;
}

}  // namespace softscope
