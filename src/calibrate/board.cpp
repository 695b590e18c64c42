#include "calibrate/board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "calibrate/corner_fit.h"
#include "core/error.h"
#include "core/median.h"

namespace softscope {
namespace {

constexpr std::size_t kLeastCharucoCorners = 6;

const std::map<std::string, int>& dictionaries() {
  using namespace cv::aruco;
  static const std::map<std::string, int> names{
      {"4X4_50", DICT_4X4_50},     {"4X4_100", DICT_4X4_100},   {"4X4_250", DICT_4X4_250},
      {"4X4_1000", DICT_4X4_1000}, {"5X5_50", DICT_5X5_50},     {"5X5_100", DICT_5X5_100},
      {"5X5_250", DICT_5X5_250},   {"5X5_1000", DICT_5X5_1000}, {"6X6_50", DICT_6X6_50},
      {"6X6_100", DICT_6X6_100},   {"6X6_250", DICT_6X6_250},   {"6X6_1000", DICT_6X6_1000}};
  return names;
}

cv::Mat viewOf(const GrayImage& image) {
  return {image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.values.data())};
}

std::vector<BoardCorner> checkerboardCorners(const cv::Mat& image, const BoardOptions& board) {
  std::vector<cv::Point2f> points;
  const cv::Size size(board.columns, board.rows);
  if (!cv::findChessboardCorners(
          image, size, points,
          cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK))
    return {};
  std::vector<BoardCorner> corners;
  for (std::size_t i = 0; i < points.size(); ++i)
    corners.push_back({static_cast<int>(i), {points[i].x, points[i].y}});
  return corners;
}

std::vector<BoardCorner> charucoCorners(const cv::Mat& image, const BoardOptions& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(dictionaries().at(board.dictionary));
  const auto charuco = cv::aruco::CharucoBoard::create(
      board.columns, board.rows, static_cast<float>(board.square_mm),
      static_cast<float>(board.marker_mm), dictionary);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids, ids;
  cv::aruco::detectMarkers(image, dictionary, markers, marker_ids);
  if (markers.empty()) return {};
  std::vector<cv::Point2f> points;
  cv::aruco::interpolateCornersCharuco(markers, marker_ids, image, charuco, points, ids);
  if (points.size() < kLeastCharucoCorners) return {};
  std::vector<BoardCorner> corners;
  for (std::size_t i = 0; i < points.size(); ++i)
    corners.push_back({ids[i], {points[i].x, points[i].y}});
  return corners;
}

using CornerMap = std::map<int, Eigen::Vector2d>;

CornerMap byId(const std::vector<BoardCorner>& corners) {
  CornerMap map;
  for (const BoardCorner& corner : corners) map[corner.id] = corner.pixel;
  return map;
}

/// Calls take(pixel, pixel) for every pair of neighbours along a row, or along a column.
template <class Take>
void forNeighbours(const CornerMap& corners, const BoardOptions& board, bool along_row, Take take) {
  for (const auto& [id, pixel] : corners) {
    if (along_row && id % board.cornerColumns() == board.cornerColumns() - 1) continue;
    const auto next = corners.find(id + (along_row ? 1 : board.cornerColumns()));
    if (next != corners.end()) take(pixel, next->second);
  }
}

double shortestSide(const CornerMap& corners, const BoardOptions& board) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const bool along_row : {true, false})
    forNeighbours(corners, board, along_row, [&](const auto& a, const auto& b) {
      shortest = std::min(shortest, (a - b).norm());
    });
  return shortest;
}

/// Along a row or column of the board, from the available neighbours.
std::optional<Eigen::Vector2d> directionAt(const CornerMap& corners, int id, int first, int last,
                                           int step) {
  const auto pixelOf = [&](int neighbour, bool is_there) {
    const auto found = is_there ? corners.find(neighbour) : corners.end();
    return found == corners.end() ? corners.at(id) : found->second;
  };
  const Eigen::Vector2d along = pixelOf(id + step, id < last) - pixelOf(id - step, id > first);
  if (along.isZero()) return std::nullopt;
  return along;
}

/// Refines each corner by the fit of its intensities.
void fitLevels(const GrayImage& image, const BoardOptions& board, int reach_px,
               std::vector<BoardCorner>* corners) {
  const CornerMap map = byId(*corners);
  const int columns = board.cornerColumns(), rows = board.cornerRows();
  for (BoardCorner& corner : *corners) {
    const int row_begin = corner.id / columns * columns, column = corner.id % columns;
    const auto along_row = directionAt(map, corner.id, row_begin, row_begin + columns - 1, 1);
    const auto along_column =
        directionAt(map, corner.id, column, column + (rows - 1) * columns, columns);
    if (along_row && along_column)
      corner.pixel = fitCorner(image, {corner.pixel, *along_row, *along_column}, reach_px);
  }
}

/// Moves corners to the position where gradients are orthogonal to the direction from it, then
/// fits intensities. The window contains no other corner and, for a ChArUco board, no marker.
void refine(const GrayImage& gray, const BoardOptions& board, std::vector<BoardCorner>* corners) {
  const cv::Mat image = viewOf(gray);
  double reach = shortestSide(byId(*corners), board) * 0.35;
  if (board.hasMarkers()) reach *= (1 - board.marker_mm / board.square_mm);
  const int window = std::clamp(static_cast<int>(std::lround(reach)), 2, 10);
  std::vector<cv::Point2f> points;
  for (const BoardCorner& corner : *corners)
    points.emplace_back(static_cast<float>(corner.pixel.x()), static_cast<float>(corner.pixel.y()));
  cv::cornerSubPix(image, points, cv::Size(window, window), cv::Size(-1, -1),
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 60, 1e-4});
  for (std::size_t i = 0; i < points.size(); ++i) (*corners)[i].pixel = {points[i].x, points[i].y};
  fitLevels(gray, board, window, corners);
}

bool between(const GrayImage& image, const Eigen::Vector2d& p) {
  return p.x() >= 0 && p.y() >= 0 && p.x() < image.width_px - 1 && p.y() < image.height_px - 1;
}

double sampleAt(const GrayImage& image, const Eigen::Vector2d& p) {
  const int u = static_cast<int>(p.x()), v = static_cast<int>(p.y());
  const double a = p.x() - u, b = p.y() - v;
  return (1 - b) * ((1 - a) * image.at(u, v) + a * image.at(u + 1, v)) +
         b * ((1 - a) * image.at(u, v + 1) + a * image.at(u + 1, v + 1));
}

/// Across the midpoint of the side from `a` to `b`; NaN at the image border.
double widthOfEdge(const GrayImage& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d side = b - a, across = Eigen::Vector2d(-side.y(), side.x()).normalized();
  const double reach = std::min(8.0, 0.4 * side.norm());
  double low = 255, high = 0, steepest = 0, before = -1;
  for (double at = -reach; at <= reach; at += 0.5) {
    const Eigen::Vector2d p = (a + b) / 2 + at * across;
    if (!between(image, p)) return std::numeric_limits<double>::quiet_NaN();
    const double value = sampleAt(image, p);
    low = std::min(low, value);
    high = std::max(high, value);
    if (before >= 0) steepest = std::max(steepest, std::abs(value - before) / 0.5);
    before = value;
  }
  return steepest > 0 ? (high - low) / steepest : std::numeric_limits<double>::quiet_NaN();
}

double medianWidth(const GrayImage& image, const CornerMap& corners, const BoardOptions& board,
                   bool along_row) {
  std::vector<double> widths;
  forNeighbours(corners, board, along_row, [&](const auto& a, const auto& b) {
    const double width = widthOfEdge(image, a, b);
    if (std::isfinite(width)) widths.push_back(width);
  });
  return widths.empty() ? 0 : medianOf(std::move(widths));
}

}  // namespace

Eigen::Vector3d BoardOptions::cornerPosition(int id) const {
  return {square_mm * (id % cornerColumns()), square_mm * (id / cornerColumns()), 0};
}

void BoardOptions::validate() const {
  require(cornerColumns() >= 3 && columns <= 60, "`board=`: columns", columns,
          "a board has 3 to 60 inner corners a row");
  require(cornerRows() >= 3 && rows <= 60, "`board=`: rows", rows,
          "a board has 3 to 60 inner corners a column");
  require(hasMarkers() || columns != rows, "`board=`: columns and rows", columns,
          "a checkerboard with equal numbers of columns and rows is ambiguous by rotations of 90 "
          "degrees; use one of 9x6 inner corners, or a ChArUco board");
  require(square_mm > 0 && square_mm <= 200, "`square=`", square_mm,
          "must be above 0, at most 200");
  require(marker_mm >= 0 && marker_mm < square_mm, "`marker=`", marker_mm,
          "must be less than the square's side");
  require(dictionaries().count(dictionary) == 1, "`dictionary=`", dictionary,
          "must be one of 4X4_50, 4X4_100, 4X4_250, 4X4_1000, and the same of 5X5 and 6X6");
}

std::vector<BoardCorner> findBoard(const GrayImage& image, const BoardOptions& board) {
  if (image.width_px < 32 || image.height_px < 32) return {};
  std::vector<BoardCorner> corners = board.hasMarkers() ? charucoCorners(viewOf(image), board)
                                                        : checkerboardCorners(viewOf(image), board);
  if (!corners.empty()) refine(image, board, &corners);
  return corners;
}

void matchOrder(const std::vector<BoardCorner>& left, const BoardOptions& board,
                std::vector<BoardCorner>* right) {
  if (board.hasMarkers() || left.empty() || right->size() != left.size()) return;
  const Eigen::Vector2d along_left = left.back().pixel - left.front().pixel;
  const Eigen::Vector2d along_right = right->back().pixel - right->front().pixel;
  if (along_left.dot(along_right) >= 0) return;
  std::reverse(right->begin(), right->end());
  for (std::size_t i = 0; i < right->size(); ++i) (*right)[i].id = static_cast<int>(i);
}

double edgeWidthPx(const GrayImage& image, const std::vector<BoardCorner>& corners,
                   const BoardOptions& board) {
  const CornerMap map = byId(corners);
  const double width =
      std::max(medianWidth(image, map, board, true), medianWidth(image, map, board, false));
  return width > 0 ? width : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace softscope
