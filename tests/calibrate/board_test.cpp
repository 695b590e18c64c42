// tests/calibrate/board_test.cpp: corners of rendered boards against where they truly are.
#include "calibrate/board.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "calibrate/bundle.h"
#include "core/error.h"
#include "rendered_boards.h"

namespace softscope::test {
namespace {

BoardRendering rendering() {
  BoardRendering rendering;
  rendering.truth = truthOfScope();
  static const auto rays = raysOfScope(rendering.truth);
  rendering.rays = rays;
  rendering.board.square_mm = 3;
  return rendering;
}

BoardRendering charucoRendering() {
  BoardRendering charuco = rendering();
  charuco.board.columns = 9;
  charuco.board.rows = 7;
  charuco.board.square_mm = 4;
  charuco.board.marker_mm = 3;
  return charuco;
}

double rmsErrorPx(const BoardRendering& rendering, const Eigen::Isometry3d& pose,
                  const std::vector<BoardCorner>& corners) {
  double squares = 0;
  for (const BoardCorner& corner : corners) {
    const Eigen::Vector3d p = pose * rendering.board.cornerPosition(corner.id);
    squares +=
        (corner.pixel - projectWithLens(rendering.truth.left, p, nullptr, nullptr)).squaredNorm();
  }
  return std::sqrt(squares / double(corners.size()));
}

TEST(Board, CornersOfACheckerboardLieWhereTheyAre) {
  const BoardRendering r = rendering();
  const Eigen::Isometry3d pose = boardPoses(r, 5)[4];
  auto corners = findBoard(renderBoard(r, pose, false, 1), r.board);
  ASSERT_EQ(corners.size(), 54u);
  // Either end of the board may come first.
  if (rmsErrorPx(r, pose, corners) > 5)
    for (BoardCorner& corner : corners) corner.id = 53 - corner.id;
  EXPECT_LT(rmsErrorPx(r, pose, corners), 0.08);  // noise of 3 levels at a blur of 0.8 px
}

TEST(Board, CornersOfACharucoBoardAreKnownByNumber) {
  const BoardRendering r = charucoRendering();
  const Eigen::Isometry3d pose = boardPoses(r, 5)[4];
  const auto corners = findBoard(renderBoard(r, pose, false, 1), r.board);
  ASSERT_GE(corners.size(), 30u);                 // of 48
  EXPECT_LT(rmsErrorPx(r, pose, corners), 0.15);  // windows smaller than a checkerboard's
}

TEST(Board, APartOfACharucoBoardIsEnough) {
  const BoardRendering r = charucoRendering();
  GrayImage image = renderBoard(r, boardPoses(r, 5)[4], false, 1);
  for (int v = 0; v < image.height_px; ++v)
    for (int u = image.width_px / 2; u < image.width_px; ++u) image.at(u, v) = 90;
  const auto corners = findBoard(image, r.board);
  EXPECT_GE(corners.size(), 6u);
  EXPECT_LT(corners.size(), 40u);
}

TEST(Board, WithoutABoardThereAreNoCorners) {
  const BoardRendering r = rendering();
  EXPECT_TRUE(findBoard(GrayImage(320, 240, 128), r.board).empty());
  EXPECT_TRUE(findBoard(GrayImage(8, 8, 128), r.board).empty());
  EXPECT_TRUE(findBoard(GrayImage(), r.board).empty());
  EXPECT_TRUE(findBoard(GrayImage(320, 240, 128), charucoRendering().board).empty());
}

TEST(Board, ABlurIsMeasuredInEitherDirection) {
  const BoardRendering r = rendering();
  const GrayImage sharp = renderBoard(r, boardPoses(r, 5)[4], false, 1);
  const auto corners = findBoard(sharp, r.board);
  const double sharp_px = edgeWidthPx(sharp, corners, r.board);
  EXPECT_GT(sharp_px, 1.5);
  EXPECT_LT(sharp_px, 3.5);
  for (const auto& [across, down] : {std::pair{7, 1}, std::pair{1, 7}}) {
    GrayImage moved = sharp;
    cv::Mat view(moved.height_px, moved.width_px, CV_8U, moved.values.data());
    cv::blur(view.clone(), view, {across, down});
    EXPECT_GT(edgeWidthPx(moved, corners, r.board), 1.6 * sharp_px);
  }
  EXPECT_TRUE(std::isnan(edgeWidthPx(sharp, {}, r.board)));
}

TEST(Board, ABoardThatCannotBeIsRefused) {
  BoardOptions board;
  EXPECT_THROW(board.validate(), OptionError);  // no square
  board.square_mm = 3;
  EXPECT_NO_THROW(board.validate());
  board.rows = 9;
  EXPECT_THROW(board.validate(), OptionError);  // symmetric for a quarter turn
  board.marker_mm = 2;
  EXPECT_NO_THROW(board.validate());
  board.dictionary = "7X7_1";
  EXPECT_THROW(board.validate(), OptionError);
  board.marker_mm = 3;
  EXPECT_THROW(board.validate(), OptionError);
}

}  // namespace
}  // namespace softscope::test
