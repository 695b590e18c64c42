// tests/vtk_views/test_surface_picture.cpp: surfaces and points in 3-D, pixel by pixel.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/scenes/surface_picture.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {
namespace {

/// A sheet that faces the patient's front, 40 mm wide and 20 mm high, of 1 mm squares.
TriangleMesh coronalSheet() {
  TriangleMesh mesh;
  for (int k = 0; k <= 20; ++k)
    for (int i = 0; i <= 40; ++i) mesh.vertices_mm.emplace_back(i - 20.0f, 0.0f, k - 10.0f);
  for (int k = 0; k < 20; ++k)
    for (int i = 0; i < 40; ++i) {
      const int a = k * 41 + i;
      mesh.triangles.push_back({a, a + 1, a + 42});
      mesh.triangles.push_back({a, a + 42, a + 41});
    }
  return mesh;
}

bool alike(Rgb8 a, Rgb8 b) {  // to two steps: drivers round, the table has 256 colours
  return std::abs(a.red - b.red) <= 2 && std::abs(a.green - b.green) <= 2 &&
         std::abs(a.blue - b.blue) <= 2;
}

TEST(SurfacePicture, ShowsErrorsInTheirColoursOnTheirSide) {
  std::vector<SceneSurface> surfaces{{"", coronalSheet(), {255, 0, 0}, {}}};
  for (const Eigen::Vector3f& p : surfaces[0].mesh.vertices_mm)
    surfaces[0].errors_mm.push_back(p.x() < -15 ? NAN : p.x() / 10);  // most to the left
  SurfacePictureOptions options;
  options.width_px = options.height_px = 100;  // of 50 mm
  options.width_mm = 50;
  const ViewPlane front = coronalView({0, 0, 0}, SceneFrame::kPatient, SideRule::kRadiological);
  const ErrorColours colours{true, 2};
  const ColourImage picture = drawSurfaces(surfaces, colours, front, options);
  for (const double x_mm : {-10.25, -0.25, 4.75, 14.75})
    EXPECT_TRUE(alike(picture.at(int(50 + 2 * x_mm), 50), colours.colour(x_mm / 10)))
        << "unlit: the bar's colour at " << x_mm << " mm";
  EXPECT_TRUE(alike(picture.at(14, 50), kUnmeasuredGrey)) << "not observed";
  EXPECT_TRUE(alike(picture.at(50, 28), {255, 255, 255})) << "11 mm up is above the sheet";
  surfaces[0].errors_mm.pop_back();
  EXPECT_THROW(drawSurfaces(surfaces, colours, front, options), Error);
}

TEST(SurfacePicture, ASurfaceBesideErrorsIsGreyAlsoWhereItFacesTheViewer) {
  TriangleMesh before = coronalSheet();
  for (Eigen::Vector3f& p : before.vertices_mm) p = 0.5f * p - Eigen::Vector3f(0, 1, 0);
  std::vector<SceneSurface> surfaces{{"reference", coronalSheet(), {175, 175, 175}, {}},
                                     {"test", before, {255, 0, 0}, {}}};
  surfaces[1].errors_mm.assign(before.vertices_mm.size(), 1.0);
  SurfacePictureOptions options;
  options.width_px = options.height_px = 100;  // of 50 mm
  options.width_mm = 50;
  const ViewPlane front = coronalView({0, 0, 0}, SceneFrame::kPatient, SideRule::kRadiological);
  const Rgb8 shown = drawSurfaces(surfaces, {false, 2}, front, options).at(20, 50);
  EXPECT_TRUE(shown.red == shown.green && shown.green == shown.blue);
  EXPECT_NEAR(shown.red, 175, 15);  // white is the background
}

TEST(SurfacePicture, DotsCoverTheirSurfaceAndFewStaySmall) {
  SurfacePictureOptions options;
  options.width_px = options.height_px = 100;  // of 50 mm
  options.width_mm = 50;
  const ViewPlane front = coronalView({0, 0, 0}, SceneFrame::kPatient, SideRule::kRadiological);
  const auto white = [&](TriangleMesh points, int left, int right) {
    points.triangles.clear();
    const ColourImage picture = drawSurfaces({{"", points, {255, 0, 0}, {}}}, {}, front, options);
    int count = 0;
    for (int v = 35; v < 65; ++v)
      for (int u = left; u < right; ++u) count += alike(picture.at(u, v), {255, 255, 255});
    return count;
  };
  EXPECT_EQ(white(coronalSheet(), 15, 85), 0) << "points 1 mm apart, a fiftieth of the width";
  TriangleMesh few;
  few.vertices_mm = {{-12, 0, 0}, {12, 0, 0}};
  EXPECT_GT(white(few, 15, 85), 70 * 30 - 2 * 9) << "no dot of 24 mm";
}

TEST(SurfacePicture, AModelAloneIsShadedAsASurfaceAndAsPoints) {
  TriangleMesh dome;  // 40 mm wide, 0.4 mm between its points, its top towards the front
  for (int k = 0; k <= 100; ++k)
    for (int i = 0; i <= 100; ++i) {
      const float x = 0.4f * float(i) - 20, z = 0.4f * float(k) - 20;
      dome.vertices_mm.emplace_back(x, 0.04f * (x * x + z * z), z);
    }
  for (int k = 0; k < 100; ++k)
    for (int i = 0; i < 100; ++i) {
      const int a = k * 101 + i;
      dome.triangles.push_back({a, a + 1, a + 102});
      dome.triangles.push_back({a, a + 102, a + 101});
    }
  SurfacePictureOptions options;
  options.width_px = options.height_px = 100;
  options.width_mm = 50;
  const ViewPlane front = coronalView({0, 0, 0}, SceneFrame::kPatient, SideRule::kRadiological);
  for (const bool points : {false, true}) {
    if (points) dome.triangles.clear();
    const ColourImage picture = drawSurfaces({{"", dome, {200, 120, 60}, {}}}, {}, front, options);
    EXPECT_GT(picture.at(50, 50).red, picture.at(50, 20).red + 40) << "flat, points: " << points;
  }
  dome.colours.assign(dome.vertices_mm.size(), {200, 120, 60});
  const ColourImage photograph = drawSurfaces({{"", dome, {0, 0, 0}, {}}}, {}, front, options);
  EXPECT_TRUE(alike(photograph.at(50, 20), {200, 120, 60})) << "it has its light in it";
}

TEST(SurfacePicture, AReferenceNeitherHidesNorTintsTheErrorsJustBehindIt) {
  TriangleMesh reference = coronalSheet(), test = coronalSheet();
  for (Eigen::Vector3f& p : test.vertices_mm) p.y() = 0.8f;  // behind it, as seen from the front
  std::vector<SceneSurface> surfaces{{"", reference, {240, 165, 0}, {}},
                                     {"", test, {0, 0, 255}, {}}};
  surfaces[1].errors_mm.assign(test.vertices_mm.size(), 0.8);
  SurfacePictureOptions options;
  options.width_px = options.height_px = 100;
  options.width_mm = 50;
  options.see_through = true;
  const ErrorColours colours{false, 1};
  const ColourImage picture =
      drawSurfaces(surfaces, colours,
                   coronalView({0, 0, 0}, SceneFrame::kPatient, SideRule::kRadiological), options);
  EXPECT_TRUE(alike(picture.at(50, 50), colours.colour(0.8)));
}

TEST(SurfacePicture, ShowsTheHeadEndUp) {
  TriangleMesh mesh = coronalSheet();
  mesh.triangles.resize(mesh.triangles.size() / 2);  // its lower half
  SurfacePictureOptions options;
  options.width_px = options.height_px = 100;
  options.width_mm = 50;
  const ColourImage picture =
      drawSurfaces({{"", mesh, {255, 0, 0}, {}}}, {},
                   coronalView({0, 0, 0}, SceneFrame::kPatient, SideRule::kRadiological), options);
  EXPECT_TRUE(alike(picture.at(50, 40), {255, 255, 255}));
  EXPECT_FALSE(alike(picture.at(50, 60), {255, 255, 255}));
}

}  // namespace
}  // namespace softscope
