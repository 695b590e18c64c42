// tests/simulation/picture_texture_test.cpp: a photograph has its correct position and no seam.
#include "eval/simulation/texture/picture_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "eval/simulation/sequence/simulator.h"

namespace softscope {
namespace {

const Eigen::Vector3f kFacing(0, 0, 1);

/// Left half red, right half green, brighter downwards.
ColourImage halves(int width_px, int height_px) {
  ColourImage picture(width_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) {
      const auto bright = static_cast<std::uint8_t>(120 + 120 * v / height_px);
      picture.at(u, v) = 2 * u < width_px ? Rgb8{bright, 20, 20} : Rgb8{20, bright, 20};
    }
  return picture;
}

/// y of the organ is up, the scope views along its -z.
Eigen::Isometry3d viewAlongMinusZ() {
  Eigen::Isometry3d body_from_view = Eigen::Isometry3d::Identity();
  body_from_view.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  body_from_view.translation() = Eigen::Vector3d(3, 4, 18);
  return body_from_view;
}

TEST(PictureTexture, LiesUprightWithItsMiddleWhereTheScopeLooks) {
  const PictureTexture texture(halves(64, 48), 32, 0.01, viewAlongMinusZ());
  const Eigen::Vector3f left = texture.at({1, 4, 18}, kFacing),
                        right = texture.at({5, 4, 18}, kFacing);
  EXPECT_GT(left.x(), 5 * left.y());
  EXPECT_GT(right.y(), 5 * right.x());
  EXPECT_GT(texture.at({1, -5, 18}, kFacing).x(), texture.at({1, 12, 18}, kFacing).x());
  EXPECT_EQ(texture.at({1, 4, 18}, kFacing), texture.at({1, 4, 11}, kFacing)) << "along the view";
}

TEST(PictureTexture, UndoesTheScreensCurve) {
  const ColourImage grey(32, 32, Rgb8{188, 188, 188});
  const PictureTexture texture(grey, 32, 0.5, viewAlongMinusZ());
  // IEC 61966-2-1: 188 of 255 is 0.5029 of white.
  EXPECT_NEAR(texture.at({0, 0, 0}, kFacing).x(), 0.5029, 1e-4);
  EXPECT_NEAR(texture.mean().y(), 0.5029, 1e-4);
}

// Steps of 0.01 mm along a line over four widths, and of 1 degree round all sides: nowhere more
// than the picture's own steepest change, which bilinear sampling spreads over a pixel of 1 mm.
TEST(PictureTexture, HasNoSeamAnywhere) {
  ColourImage picture(40, 32);
  for (int v = 0; v < 32; ++v)
    for (int u = 0; u < 40; ++u) {
      const auto value = static_cast<std::uint8_t>(6 * u + v);
      picture.at(u, v) = {value, static_cast<std::uint8_t>(255 - value), value};
    }
  const PictureTexture texture(picture, 40, 0.01, viewAlongMinusZ());
  for (float along = -80; along < 80; along += 0.01F) {
    const Eigen::Vector3f normal = Eigen::Vector3f(0.3F, 0.5F, 1).normalized();
    const Eigen::Vector3f step(0.006F, 0.006F, 0.005F);
    const Eigen::Vector3f p = along * Eigen::Vector3f(0.6F, 0.6F, 0.5F);
    const float change = (texture.at(p + step, normal) - texture.at(p, normal)).norm();
    // 6 grey levels a mm of sRGB, at most 0.018 a level of linear light at white, two channels.
    EXPECT_LT(change, 0.01F * 6 * 0.018F * 2) << along;
  }
  for (int degree = 0; degree < 360; ++degree) {
    const auto at = [&](int angle_deg) {
      const float angle_rad = float(angle_deg) * float(M_PI) / 180;
      return texture.at({2, 3, 5}, {std::sin(angle_rad), 0.2F, std::cos(angle_rad)});
    };
    EXPECT_LT((at(degree + 1) - at(degree)).norm(), 0.1F) << degree;  // shares change by 10 %
  }
}

TEST(PictureTexture, AveragesWhatIsFinerThanTexels) {
  ColourImage checked(400, 400);
  for (int v = 0; v < 400; ++v)
    for (int u = 0; u < 400; ++u)
      checked.at(u, v) = (u + v) % 2 == 0 ? Rgb8{255, 255, 255} : Rgb8{0, 0, 0};
  const PictureTexture texture(checked, 20, 0.1, viewAlongMinusZ());  // two pixels a texel
  for (float x = -9; x < 9; x += 0.37F)
    EXPECT_NEAR(texture.at({x, 0.7F * x, 0}, kFacing).x(), 0.5, 1e-4);
}

TEST(PictureTexture, KeepsToItsTissueAsThatMoves) {
  SimulationOptions options;
  options.scope.width_px = 160;
  options.scope.height_px = 120;
  options.organ.cells_per_side = 24;
  options.texture.wetness = 0;
  options.texture.picture = halves(256, 192);
  options.texture.picture_mm = 60;
  options.deformation.push.amplitude_mm = 4;
  Simulator simulator(makeOrganMesh(options.organ, 1), options);
  const auto greenOf = [](const ColourImage& picture, const Eigen::Vector2d& at_px) {
    const Rgb8& pixel = picture.at(int(std::lround(at_px.x())), int(std::lround(at_px.y())));
    return int(pixel.green) - int(pixel.red);
  };
  const SimulatedFrame first = simulator.frame(0), later = simulator.frame(18);
  const Eigen::Isometry3d left_from_world = later.pose.world_from_left.inverse();
  int moved = 0;
  for (std::size_t id = 0; id < simulator.trackPoints().size(); ++id) {
    const TrackPoint& point = simulator.trackPoints()[id];
    if (!later.tracks_visible[id] || std::abs(point.u_px - 79.5) < 4) continue;
    const Eigen::Vector2d now_px =
        projectPoint(simulator.rig().left, left_from_world * later.tracks_world_mm[id]);
    const int before = greenOf(first.pictures.left, {point.u_px, point.v_px});
    // The left camera is half a baseline left of the image centre: 2.6 mm, 9 px.
    if (std::abs(point.u_px - 88.6) < 4) continue;
    EXPECT_EQ(before > 0, point.u_px > 88) << "mirrored or turned";
    EXPECT_EQ(before > 0, greenOf(later.pictures.left, now_px) > 0) << "it slid over the tissue";
    moved += (now_px - Eigen::Vector2d(point.u_px, point.v_px)).norm() > 2;
  }
  EXPECT_GT(moved, 5) << "else the test tests nothing";
}

TEST(PictureTexture, RefusesAnAbsurdWidth) {
  SimulationOptions options;
  options.texture.picture = halves(64, 64);
  for (const double width_mm : {0.0, -5.0, 1.0, 65.0, 1e9}) {
    options.texture.picture_mm = width_mm;
    EXPECT_THROW(options.validate(), OptionError) << width_mm;
  }
}

}  // namespace
}  // namespace softscope
