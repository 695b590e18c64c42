#include "rendered_boards.h"

#include <algorithm>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "core/parallel.h"

namespace softscope::test {

struct ScopeRays {
  std::vector<cv::Point2d> left, right;
};

namespace {

constexpr int kRays = 3;  // a pixel, in each direction
constexpr double kDark = 40, kLight = 210, kAround = 120;

RawCamera camera(double scale, double fx, double fy, double cx, double cy,
                 const std::array<double, 5>& lens) {
  RawCamera camera;
  camera.pinhole = {int(640 * scale), int(480 * scale), fx * scale,
                    fy * scale,       cx * scale,       cy * scale};
  std::copy(lens.begin(), lens.end(), camera.distortion.coefficients.begin());
  return camera;
}

/// The board's own picture, of a ChArUco board.
cv::Mat charucoPicture(const BoardOptions& board, double pixels_per_mm) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  const auto charuco = cv::aruco::CharucoBoard::create(
      board.columns, board.rows, float(board.square_mm), float(board.marker_mm), dictionary);
  cv::Mat picture;
  charuco->draw({int(std::lround(board.columns * board.square_mm * pixels_per_mm)),
                 int(std::lround(board.rows * board.square_mm * pixels_per_mm))},
                picture, 0, 1);
  return picture;
}

/// 1 and -1 alternating between integers, averaged over `width`: a ray represents its
/// part of the pixel, and without it edges would be on a grid of thirds of a pixel. `x` is 0 or
/// more.
double squareWave(double x, double width) {
  const long line = static_cast<long>(x + 0.5);  // the nearest, without a call
  const double after = std::clamp(2 * (x - static_cast<double>(line)) / width, -1.0, 1.0);
  return line % 2 == 0 ? after : -after;
}

/// Brightness at a place of the board's plane, whose origin is the first inner corner.
class BoardFace {
 public:
  explicit BoardFace(const BoardOptions& board) : board_(board) {
    if (board.hasMarkers()) picture_ = charucoPicture(board, kPixelsPerMm);
  }

  /// Of a checkerboard, the mean over a square of `extent_mm`.
  double at(double x_mm, double y_mm, double extent_mm) const {
    if (isBeyond(kRim, x_mm, y_mm)) return kAround;
    const double x = inSquares(x_mm), y = inSquares(y_mm);
    const int columns = board_.cornerColumns() + 1, rows = board_.cornerRows() + 1;
    if (x < 0 || y < 0 || x >= columns || y >= rows) return kLight;
    if (!picture_.empty()) {
      const int u = std::min(picture_.cols - 1, int(x * board_.square_mm * kPixelsPerMm));
      const int v = std::min(picture_.rows - 1, int(y * board_.square_mm * kPixelsPerMm));
      return picture_.at<std::uint8_t>(v, u) > 127 ? kLight : kDark;
    }
    const double extent = extent_mm / board_.square_mm;
    return (kLight + kDark) / 2 -
           (kLight - kDark) / 2 * squareWave(x, extent) * squareWave(y, extent);
  }

  /// Nothing of the board is within half a square.
  bool isFarFrom(double x_mm, double y_mm) const { return isBeyond(kRim + 0.5, x_mm, y_mm); }

 private:
  /// From the outer corner.
  double inSquares(double from_inner_corner_mm) const {
    return from_inner_corner_mm / board_.square_mm + 1;
  }
  /// Farther than so many squares from all squares of the board, right, left, above or below.
  bool isBeyond(double squares, double x_mm, double y_mm) const {
    const double x = inSquares(x_mm), y = inSquares(y_mm);
    return x < -squares || y < -squares || x > board_.cornerColumns() + 1 + squares ||
           y > board_.cornerRows() + 1 + squares;
  }

  static constexpr double kPixelsPerMm = 40;
  static constexpr double kRim = 0.6;  // width of the white rim, in squares
  BoardOptions board_;
  cv::Mat picture_;
};

/// Directions (z = 1) of all rays of a camera, 3 x 3 a pixel.
std::vector<cv::Point2d> raysOf(const RawCamera& camera) {
  std::vector<cv::Point2d> pixels, rays;
  for (int v = 0; v < camera.pinhole.height_px * kRays; ++v)
    for (int u = 0; u < camera.pinhole.width_px * kRays; ++u)
      pixels.emplace_back((u + 0.5) / kRays - 0.5, (v + 0.5) / kRays - 0.5);
  cv::Mat k, d(1, 5, CV_64F);
  cv::eigen2cv(camera.pinhole.matrix(), k);
  for (int i = 0; i < 5; ++i) d.at<double>(i) = camera.distortion.coefficients[std::size_t(i)];
  cv::undistortPoints(pixels, rays, k, d, cv::noArray(), cv::noArray(),
                      {cv::TermCriteria::COUNT, 15, 0});  // right to 1e-7 px
  return rays;
}

/// Standard normal draws by the polar method of Marsaglia. std::normal_distribution computes a
/// logarithm of the generator's range, in long double, for each uniform number.
class NormalNoise {
 public:
  explicit NormalNoise(unsigned seed) : random_(seed) {}

  float next() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    float x, y, square;
    do {
      x = uniform(), y = uniform();
      square = x * x + y * y;
    } while (square > 1 || square == 0);
    const float scale = std::sqrt(-2 * std::log(square) / square);
    second_ = x * scale;
    has_second_ = true;
    return y * scale;
  }

 private:
  /// From -1 to 1, of 24 bits.
  float uniform() { return float(random_() >> 8) * 0x1p-23f - 1; }

  std::mt19937 random_;
  float second_ = 0;
  bool has_second_ = false;
};

/// A row of a 3 x 3 matrix. Plain numbers: under sanitizers the product of Eigen, which clang does
/// not inline there, was three quarters of the time of these tests.
struct MatrixRow {
  double x, y, z;

  MatrixRow(const Eigen::Matrix3d& matrix, int row)
      : x(matrix(row, 0)), y(matrix(row, 1)), z(matrix(row, 2)) {}

  /// Times (x, y, 1).
  double times(const cv::Point2d& ray) const { return x * ray.x + y * ray.y + z; }
};

GrayImage renderWith(const BoardRendering& rendering, const std::vector<cv::Point2d>& rays,
                     const RawCamera& camera, const Eigen::Isometry3d& camera_from_board,
                     int noise_seed) {
  const BoardFace face(rendering.board);
  const int width = camera.pinhole.width_px, height = camera.pinhole.height_px;
  // A ray (x, y, 1) meets the plane at H^-1 (x, y, 1).
  Eigen::Matrix3d h;
  h << camera_from_board.linear().col(0), camera_from_board.linear().col(1),
      camera_from_board.translation();
  const Eigen::Matrix3d board_from_ray = h.inverse();
  const MatrixRow x_row(board_from_ray, 0), y_row(board_from_ray, 1), z_row(board_from_ray, 2);
  cv::Mat light(height, width, CV_32F);
  const auto ray_at = [&](int u, int v, int i, int j) -> const cv::Point2d& {
    return rays[std::size_t(v * kRays + j) * std::size_t(width * kRays) +
                std::size_t(u * kRays + i)];
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      // A pixel is a small part of a square: where its middle is far from the board, all of it is.
      const cv::Point2d& middle = ray_at(u, v, kRays / 2, kRays / 2);
      const double middle_z = z_row.times(middle);
      if (face.isFarFrom(x_row.times(middle) / middle_z, y_row.times(middle) / middle_z)) {
        light.at<float>(v, u) = float(kAround);
        continue;
      }
      double sum = 0;
      for (int j = 0; j < kRays; ++j)
        for (int i = 0; i < kRays; ++i) {
          const cv::Point2d& ray = ray_at(u, v, i, j);
          const double z = z_row.times(ray);  // 1 / depth
          sum += face.at(x_row.times(ray) / z, y_row.times(ray) / z,
                         1 / (z * camera.pinhole.fx_px * kRays));
        }
      light.at<float>(v, u) = float(sum / (kRays * kRays));
    }
  if (rendering.blur_px > 0) cv::GaussianBlur(light, light, {0, 0}, rendering.blur_px);
  NormalNoise noise(static_cast<unsigned>(noise_seed));
  const auto noise_levels = float(rendering.noise_levels);
  GrayImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image.at(u, v) =
          cv::saturate_cast<std::uint8_t>(light.at<float>(v, u) + noise_levels * noise.next());
  return image;
}

}  // namespace

StereoCalibration truthOfScope(double scale) {
  StereoCalibration truth;
  truth.left = camera(scale, 560, 563, 322.4, 236.9, {-0.21, 0.09, 0.0008, -0.0006, -0.01});
  truth.right = camera(scale, 566, 568, 315.2, 241.3, {-0.19, 0.06, -0.0005, 0.0007, 0.01});
  truth.right_from_left.linear() =
      Eigen::AngleAxisd(0.018, Eigen::Vector3d(0.3, 1, 0.4).normalized()).toRotationMatrix();
  truth.right_from_left.translation() = Eigen::Vector3d(-4.2, 0.05, 0.08);
  return truth;
}

std::vector<Eigen::Isometry3d> boardPoses(const BoardRendering& rendering, int count) {
  std::mt19937 random(static_cast<unsigned>(rendering.seed));
  std::uniform_real_distribution<double> unit(-1, 1);
  const RawCamera& left = rendering.truth.left;
  const BoardOptions& board = rendering.board;
  const Eigen::Vector3d middle = board.cornerPosition(board.cornerCount() - 1) / 2;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i) {
    // Far enough that the tilted board is inside both images, at any position.
    const double width_mm = (board.cornerColumns() + 2) * board.square_mm;
    const double fill = 0.42 + 0.22 * (unit(random) + 1) / 2;
    const double z = width_mm * left.pinhole.fx_px / (fill * left.pinhole.width_px);
    const double tilt = (10 + 25 * (unit(random) + 1) / 2) * M_PI / 180;
    const double towards = M_PI * (i * 0.763 + 0.2 * unit(random));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() =
        (Eigen::AngleAxisd(0.25 * unit(random), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(towards), std::sin(towards), 0)))
            .toRotationMatrix();
    const double room_u = 0.5 * (1 - fill) * left.pinhole.width_px,
                 room_v = 0.5 * (1 - fill) * left.pinhole.height_px;
    const int place = i % 9;
    const double u = (place % 3 - 1) * 0.85 * room_u + 0.1 * room_u * unit(random);
    const double v = (place / 3 - 1) * 0.85 * room_v + 0.1 * room_v * unit(random);
    pose.translation() =
        Eigen::Vector3d(u * z / left.pinhole.fx_px, v * z / left.pinhole.fx_px, z) -
        pose.linear() * middle;
    poses.push_back(pose);
  }
  return poses;
}

std::shared_ptr<const ScopeRays> raysOfScope(const StereoCalibration& truth) {
  return std::make_shared<ScopeRays>(ScopeRays{raysOf(truth.left), raysOf(truth.right)});
}

GrayImage renderBoard(const BoardRendering& rendering, const Eigen::Isometry3d& left_from_board,
                      bool is_right, int noise_seed) {
  const RawCamera& camera = is_right ? rendering.truth.right : rendering.truth.left;
  const auto rays = rendering.rays ? rendering.rays : raysOfScope(rendering.truth);
  return renderWith(rendering, is_right ? rays->right : rays->left, camera,
                    is_right ? rendering.truth.right_from_left * left_from_board : left_from_board,
                    noise_seed);
}

std::vector<BoardSighting> sightBoards(const BoardRendering& rendering, int count) {
  const std::vector<Eigen::Isometry3d> poses = boardPoses(rendering, count);
  const auto rays = rendering.rays ? rendering.rays : raysOfScope(rendering.truth);
  std::vector<BoardSighting> all(poses.size());
  parallelRanges(count, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Eigen::Isometry3d& pose = poses[std::size_t(i)];
      const GrayImage left = renderWith(rendering, rays->left, rendering.truth.left, pose,
                                        1000 * rendering.seed + 2 * i);
      const GrayImage right =
          renderWith(rendering, rays->right, rendering.truth.right,
                     rendering.truth.right_from_left * pose, 1000 * rendering.seed + 2 * i + 1);
      BoardSighting& sighting = all[std::size_t(i)];
      sighting.frame = i;
      sighting.left = findBoard(left, rendering.board);
      sighting.right = findBoard(right, rendering.board);
      matchOrder(sighting.left, rendering.board, &sighting.right);
      sighting.edge_width_px = std::max(edgeWidthPx(left, sighting.left, rendering.board),
                                        edgeWidthPx(right, sighting.right, rendering.board));
    }
  });
  std::vector<BoardSighting> found;
  for (BoardSighting& sighting : all)
    if (!sighting.left.empty() && !sighting.right.empty()) found.push_back(std::move(sighting));
  return found;
}

}  // namespace softscope::test
