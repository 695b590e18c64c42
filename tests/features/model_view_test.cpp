// tests/features/model_view_test.cpp: no holes, nothing shines through, texture keeps its place.
#include "features/model_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "support/scene.h"

namespace softscope {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Colour of the tissue at a place, for red, green and blue alike.
double grayAt(const Eigen::Vector3d& place_mm) {
  return 50 + 150 * test::solidTexture(place_mm, 1.6);
}

/// Points every 0.2 mm on the plane z = z0 + slope x, shaken by up to 0.06 mm along it.
void addPlane(double z0_mm, double slope, double half_mm, Rgb8 colour, bool textured,
              PointModel* model) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> shake(-0.06, 0.06);
  const Eigen::Vector3d normal = Eigen::Vector3d(slope, 0, -1).normalized();
  for (double y = -half_mm; y < half_mm; y += 0.2)
    for (double x = -half_mm; x < half_mm; x += 0.2) {
      Eigen::Vector3d p(x + shake(random), y + shake(random), 0);
      p.z() = z0_mm + slope * p.x();
      const std::uint8_t gray = static_cast<std::uint8_t>(std::lround(grayAt(p)));
      model->add(p.cast<float>(), normal.cast<float>(), textured ? Rgb8{gray, gray, gray} : colour,
                 1);
    }
}

PinholeCamera camera() { return test::endoscope(320, 240).left; }

const Eigen::Isometry3d kHome = Eigen::Isometry3d::Identity();

TEST(ModelView, ASlantedPlaneHasNoHolesAndItsDepth) {
  PointModel model;
  addPlane(50, 0.4, 42, {200, 100, 50}, false, &model);
  const ModelView view = renderModelView(model, camera(), kHome, {});
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const Eigen::Vector3d ray = liftPixel<double>(camera(), u, v, 1.0);
      const double truth = 50 / (1 - 0.4 * ray.x());
      ASSERT_NEAR(view.depth_mm.at(u, v), truth, 0.01) << u << ", " << v;  // floats, 50 mm
      ASSERT_EQ(view.colour.at(u, v), (Rgb8{200, 100, 50}));
      const Eigen::Vector3f p =
          model.positions_mm[static_cast<std::size_t>(view.point_index.at(u, v))];
      const Eigen::Vector2f at = projectPoint<float>(camera(), p);
      ASSERT_LT((at - Eigen::Vector2f(u, v)).norm(), 1.8f);  // a disc's reach at 0.2 mm
    }
}

TEST(ModelView, TextureKeepsItsPlace) {
  PointModel model;
  addPlane(40, 0.2, 25, {}, true, &model);
  const ModelView view = renderModelView(model, camera(), kHome, {});
  // Least squares of view - truth along the truth's slope: how far the texture moved.
  double moved_u = 0, slope_sq = 0, error_sq = 0, contrast_sq = 0;
  const auto truth = [&](double u, double v) {
    const Eigen::Vector3d ray = liftPixel<double>(camera(), u, v, 1.0);
    return grayAt(ray * (40 / (1 - 0.2 * ray.x())));
  };
  for (int v = 20; v < 220; v += 3)
    for (int u = 20; u < 300; u += 3) {
      const double slope = 0.5 * (truth(u + 1, v) - truth(u - 1, v));
      const double error = view.colour.at(u, v).red - truth(u, v);
      moved_u += slope * error;
      slope_sq += slope * slope;
      error_sq += error * error;
      contrast_sq += std::pow(truth(u, v) - 125, 2);
    }
  EXPECT_LT(std::abs(moved_u / slope_sq), 0.03);      // pixels, on average
  EXPECT_LT(std::sqrt(error_sq / contrast_sq), 0.2);  // of the contrast; discs blur a little
}

// Points that look as they did at first show it; the anchor is drawn with its own rounding.
TEST(ModelView, DrawsAnchorsAsItDrawsColours) {
  PointModel model;
  addPlane(40, 0.2, 25, {}, true, &model);
  const ModelView view = renderModelView(model, camera(), kHome, {});
  const GrayImage gray = toGray(view.colour);
  int different = 0;
  for (std::size_t i = 0; i < gray.size(); ++i) {
    ASSERT_NEAR(view.anchor.values[i], gray.values[i], 2);
    different += gray.values[i] != gray.values[0];
  }
  EXPECT_GT(different, 1000);
  for (std::uint8_t& anchor : model.anchors) anchor = 77;
  const ModelView changed = renderModelView(model, camera(), kHome, {});
  EXPECT_EQ(changed.anchor.at(160, 120), 77);
  EXPECT_EQ(changed.colour.at(160, 120), view.colour.at(160, 120));
}

TEST(ModelView, WhatIsHiddenStaysHidden) {
  PointModel model;
  addPlane(50, 0, 20, {255, 0, 0}, false, &model);
  addPlane(40, 0, 8, {0, 255, 0}, false, &model);
  const ModelView view = renderModelView(model, camera(), kHome, {});
  const double reach_px = camera().fx_px * 8 / 40;  // of the near plane
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const double x = std::abs(u - camera().cx_px), y = std::abs(v - camera().cy_px);
      if (x < reach_px - 3 && y < reach_px - 3) {
        ASSERT_EQ(view.colour.at(u, v), (Rgb8{0, 255, 0})) << u << ", " << v;
      }
      if (std::max(x, y) > reach_px + 4 && std::max(x, y) < 80) {
        ASSERT_EQ(view.colour.at(u, v), (Rgb8{255, 0, 0})) << u << ", " << v;
      }
    }
}

TEST(ModelView, ThinGapsInFrontAreClosed) {
  PointModel model, with_slit;
  addPlane(50, 0, 20, {255, 0, 0}, false, &model);
  addPlane(40, 0, 8, {0, 255, 0}, false, &model);
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3f p = model.positions_mm[i];
    if (p.z() < 45 && std::abs(p.x()) < 0.35f) continue;  // 0.7 mm: 5 px, 2 of them under discs
    with_slit.add(p, model.normals[i], model.colours[i], 1);
  }
  const ModelView view = renderModelView(with_slit, camera(), kHome, {});
  for (int u = 150; u < 170; ++u) {
    EXPECT_EQ(view.colour.at(u, 120), (Rgb8{0, 255, 0})) << u;
    EXPECT_NEAR(view.depth_mm.at(u, 120), 40, 0.01);
  }
  ModelViewOptions open;
  open.gap_px = 0;
  const ModelView through = renderModelView(with_slit, camera(), kHome, open);
  EXPECT_EQ(through.colour.at(160, 120), (Rgb8{255, 0, 0}));
}

TEST(ModelView, FollowsTheCamera) {
  PointModel model;
  model.add({3, -2, 60}, {0, 0, -1}, {9, 8, 7}, 1);
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  world_from_left.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));
  world_from_left.pretranslate(Eigen::Vector3d(1, 2, 3));
  const ModelView view = renderModelView(model, camera(), world_from_left, {});
  const Eigen::Vector3d p = world_from_left.inverse() * Eigen::Vector3d(3, -2, 60);
  const Eigen::Vector2d at = projectPoint<double>(camera(), p);
  const int u = static_cast<int>(std::lround(at.x())), v = static_cast<int>(std::lround(at.y()));
  EXPECT_EQ(view.point_index.at(u, v), 0);
  EXPECT_EQ(view.colour.at(u, v), (Rgb8{9, 8, 7}));
  EXPECT_NEAR(view.depth_mm.at(u, v), p.z(), 0.05);  // its plane is tilted by 0.1 rad
}

TEST(ModelView, BadPointsAreLeftOut) {
  PointModel model;
  const Eigen::Vector3f facing(0, 0, -1);
  model.add({kNothing, 0, 50}, facing, {1, 1, 1}, 1);
  model.add({0, 0, std::numeric_limits<float>::infinity()}, facing, {1, 1, 1}, 1);
  model.add({0, 0, -50}, facing, {1, 1, 1}, 1);    // behind the camera
  model.add({0, 0, 0}, facing, {1, 1, 1}, 1);      // inside it
  model.add({0, 0, 50}, {0, 0, 1}, {1, 1, 1}, 1);  // seen from within the tissue
  model.add({1e30f, 0, 1e30f}, facing, {1, 1, 1}, 1);
  const ModelView view = renderModelView(model, camera(), kHome, {});
  for (const std::int32_t point : view.point_index.values) EXPECT_LT(point, 0);
  model.add({0, 0, 50}, {kNothing, 0, 0}, {5, 5, 5}, 1);  // without a normal it faces the camera
  EXPECT_EQ(renderModelView(model, camera(), kHome, {}).point_index.at(160, 120), 6);
  EXPECT_TRUE(std::isnan(renderModelView({}, camera(), kHome, {}).depth_mm.at(0, 0)));
}

TEST(ModelView, GivesTheSameBytesOnOneThread) {
  PointModel model;
  addPlane(50, 0.4, 42, {}, true, &model);
  const ModelView many = renderModelView(model, camera(), kHome, {});
  const ThreadLimit one(1);
  const ModelView alone = renderModelView(model, camera(), kHome, {});
  EXPECT_TRUE(alone.colour.values == many.colour.values);
  EXPECT_TRUE(alone.depth_mm.values == many.depth_mm.values);  // no NaN: the plane fills the view
  EXPECT_TRUE(alone.point_index.values == many.point_index.values);
}

}  // namespace
}  // namespace softscope
