// tests/vtk_views/test_four_panels.cpp: figures that a flipped axis, a lost bar or a wrong range
// would fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "mesh/mesh_reader.h"
#include "tests/support/data_folder.h"
#include "vtk_views/box_mesh.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/drawing_parts.h"
#include "vtk_views/scenes/four_panels.h"
#include "vtk_views/scenes/plane_contours.h"
#include "vtk_views/scenes/slice_panel.h"

namespace softscope {
namespace {

/// A long box with a small one at the patient's left, front and head end of it.
Scene lopsidedScene() {
  Scene scene;
  scene.surfaces.push_back({"reference", boxMesh({-20, -10, -5}, {20, 10, 5}), {240, 165, 0}, {}});
  scene.surfaces.push_back({"model", boxMesh({12, -9, -4}, {19, -5, 4}), {0, 0, 255}, {}});
  return scene;
}

FourPanelOptions optionsFor(const Scene& scene) {
  FourPanelOptions options;
  options.style.dots_per_inch = 150;
  options.centre_mm = {15, -7, 0};  // all three planes cut both boxes
  options.width_mm = sceneWidthMm(scene);
  return options;
}

std::multiset<std::string> wordsOfDrawing(const VectorDrawing& drawing) {
  std::multiset<std::string> words;
  for (const DrawnText& text : partsOf<DrawnText>(drawing)) words.insert(text.text);
  return words;
}

PointPt middleOf(const DrawnLine& line) {
  double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
  for (const PointPt& p : line.points) {
    x0 = std::min(x0, p.x_pt), x1 = std::max(x1, p.x_pt);
    y0 = std::min(y0, p.y_pt), y1 = std::max(y1, p.y_pt);
  }
  return {(x0 + x1) / 2, (y0 + y1) / 2};
}

TEST(SlicePanel, ContoursLieOnTheirSidesOfThePanel) {
  const Scene scene = lopsidedScene();
  const PanelPlace place{{0, 0}, 200, 200};
  struct Case {
    ViewPlane view;
    int right, up;  // offset of the small box from the centre of the big one
  };
  const auto patient = SceneFrame::kPatient;
  for (const Case& c : {Case{axialView({0, 0, 0}, patient, SideRule::kRadiological), 1, 1},
                        Case{axialView({0, 0, 0}, patient, SideRule::kNeurological), -1, 1},
                        Case{coronalView({0, -7, 0}, patient, SideRule::kRadiological), 1, 0},
                        Case{sagittalView({15, 0, 0}, patient), -1, 0}}) {
    SCOPED_TRACE(c.view.name);
    VectorDrawing drawing;
    drawSlicePanel(scene, c.view, 60, place, {}, drawing);
    const auto lines = partsOf<DrawnLine>(drawing);
    ASSERT_GE(lines.size(), 2u);
    const PointPt big = middleOf(lines[0]), small = middleOf(lines[1]);
    EXPECT_EQ(int(std::lround((small.x_pt - big.x_pt) / 20)),
              c.right * (c.view.name == "sagittal" ? 1 : 3))
        << "7 mm to the front are 23 pt, 15.5 mm to the left 52";
    EXPECT_EQ(int(std::lround((big.y_pt - small.y_pt) / 20)), c.up);
  }
}

TEST(SlicePanel, TheScaleBarIsAsLongAsItSays) {
  EXPECT_EQ(scaleBarLengthMm(60), 10);
  EXPECT_EQ(scaleBarLengthMm(269), 50);
  EXPECT_EQ(scaleBarLengthMm(90), 20);
  VectorDrawing drawing;
  drawScaleBar(60, {{0, 0}, 300, 300}, {0, 0, 0}, {}, drawing);
  const DrawnLine bar = partsOf<DrawnLine>(drawing).at(1);  // over its rim
  EXPECT_NEAR(bar.points[1].x_pt - bar.points[0].x_pt, 10.0 / 60 * 300, 1e-9);
  EXPECT_EQ(partsOf<DrawnText>(drawing).at(0).text, "10 mm");
}

TEST(FourPanels, CarryLettersBarsCaptionsAndLegend) {
  const Scene scene = lopsidedScene();
  const VectorDrawing drawing = drawFourPanels(scene, optionsFor(scene));
  const auto words = wordsOfDrawing(drawing);
  for (const auto& [word, times] :
       std::initializer_list<std::pair<const char*, std::size_t>>{{"R", 2},
                                                                  {"L", 2},
                                                                  {"A", 2},
                                                                  {"P", 2},
                                                                  {"S", 2},
                                                                  {"I", 2},
                                                                  {"10 mm", 4},
                                                                  {"(a) axial, S 0.0 mm", 1},
                                                                  {"(b) coronal, A 7.0 mm", 1},
                                                                  {"(c) sagittal, L 15.0 mm", 1},
                                                                  {"(d) 3-D", 1},
                                                                  {"reference", 1},
                                                                  {"model", 1}})
    EXPECT_EQ(words.count(word), times) << word;
  EXPECT_EQ(partsOf<DrawnPicture>(drawing).size(), 1u) << "no CT: only 3-D is pixels";
}

TEST(FourPanels, TheFieldFollowsTheProjectedBoxes) {
  for (const double width_mm : {89.0, 183.0}) {
    Scene scene = lopsidedScene();
    scene.frame = SceneFrame::kCamera;
    FourPanelOptions options = optionsFor(scene);
    options.style.width_mm = width_mm;
    options.width_mm = 0;
    const PanelField field = fourViews(scene, options);
    const double panel_pt =
        layOutPanels(4, 0, options.style, {legendOf(scene), {}, {}, {}}).panels[0].width_pt;
    const double room_mm = sideRoomPt(options.style) / panel_pt * field.width_mm;
    double widest_mm = 0;
    for (const ViewPlane& view : field.planes) {
      Eigen::AlignedBox2d box;
      for (const SceneSurface& surface : scene.surfaces)
        for (const Eigen::Vector3f& p : surface.mesh.vertices_mm)
          box.extend(view.project(p.cast<double>()));
      EXPECT_LT(box.center().norm(), 1e-4) << view.name << ": half the panel is empty";
      EXPECT_LE(box.sizes().maxCoeff() / 2, field.width_mm / 2 - room_mm + 1e-4)
          << view.name << ": cut, or under the words at the sides";
      widest_mm = std::max(widest_mm, box.sizes().maxCoeff());
    }
    EXPECT_NEAR(widest_mm / 2, field.width_mm / 2 - room_mm, 1e-4) << "one panel is full";
    EXPECT_NEAR(field.planes[0].centre_mm.z(), options.centre_mm.z(), 1e-9)
        << "the slice stays where it was asked for";
  }
}

TEST(FourPanels, StraysOfAModelDontWidenTheField) {
  Scene scene = lopsidedScene();
  const double before_mm =
      sliceViews(scene, {axialView({0, 0, 0}, scene.frame, SideRule::kRadiological)}, {}).width_mm;
  scene.surfaces[1].mesh.vertices_mm.emplace_back(500.0f, 0.0f, 0.0f);  // of no triangle
  EXPECT_NEAR(
      sliceViews(scene, {axialView({0, 0, 0}, scene.frame, SideRule::kRadiological)}, {}).width_mm,
      before_mm, 1e-9);
  // Of points one in a thousand may stray.
  Scene points;
  points.surfaces.push_back({"points", {}, {0, 0, 255}, {}});
  for (int i = 0; i <= 2000; ++i)
    points.surfaces[0].mesh.vertices_mm.emplace_back(0.01f * float(i % 1000), 0.0f, 0.0f);
  const auto widthOf = [&] {
    return sliceViews(points, {axialView({0, 0, 0}, scene.frame, SideRule::kRadiological)}, {})
        .width_mm;
  };
  const double usual_mm = widthOf();
  points.surfaces[0].mesh.vertices_mm.emplace_back(500.0f, 0.0f, 0.0f);
  EXPECT_NEAR(widthOf(), usual_mm, 0.02);
}

TEST(FourPanels, ScenesOfTwoWorldsAreCentredEachByItself) {
  Scene left, right;
  left.surfaces.push_back({"", boxMesh({-40, -5, -5}, {-20, 5, 5}), {0, 0, 255}, {}});
  right.surfaces.push_back({"", boxMesh({20, -5, -5}, {40, 5, 5}), {0, 0, 255}, {}});
  const ViewPlane front = cameraView({0, 0, 0}, {0, -1, 0}, SceneFrame::kAxes);
  const auto fieldOf = [&](int second_world) {
    return fitField({{&left, front, true, 0}, {&right, front, true, second_world}}, 100, {}, false);
  };
  const PanelField one = fieldOf(0), two = fieldOf(1);
  EXPECT_NEAR(one.planes[0].centre_mm.x(), 0, 1e-6) << "one place: a motion stays visible";
  EXPECT_NEAR(one.planes[1].centre_mm.x(), 0, 1e-6);
  EXPECT_NEAR(two.planes[0].centre_mm.x(), -30, 1e-4);
  EXPECT_NEAR(two.planes[1].centre_mm.x(), 30, 1e-4);
  EXPECT_LT(two.width_mm, one.width_mm / 3) << "no panel is half empty";
}

TEST(SurfacePicture, GivesTheSamePixelsTwice) {
  const Scene scene = lopsidedScene();
  const VectorDrawing first = drawFourPanels(scene, optionsFor(scene));
  const VectorDrawing second = drawFourPanels(scene, optionsFor(scene));
  EXPECT_EQ(svgBytes(first), svgBytes(second));
  EXPECT_EQ(pdfBytes(first), pdfBytes(second));
}

TEST(FourPanels, NothingIsDrawnBeyondTheSheet) {
  Scene scene = lopsidedScene();
  for (const double width_mm : {89.0, 183.0}) {
    FourPanelOptions options = optionsFor(scene);
    options.style.width_mm = width_mm;
    options.width_mm = 25;  // contours leave the panels
    const VectorDrawing drawing = drawFourPanels(scene, options);
    for (const DrawnLine& line : partsOf<DrawnLine>(drawing))
      for (const PointPt& p : line.points) {
        EXPECT_GE(p.x_pt, -1e-6);
        EXPECT_LE(p.x_pt, drawing.width_pt + 1e-6);
        EXPECT_LE(p.y_pt, drawing.height_pt);
      }
    for (const DrawnText& text : partsOf<DrawnText>(drawing)) {
      const double width_pt = textWidthPt(text);
      EXPECT_LE(text.at.x_pt + width_pt * (1 - static_cast<int>(text.anchor) / 2.0),
                drawing.width_pt)
          << text.text;
    }
  }
}

TEST(FourPanels, WordsLieBesideTheContours) {
  for (const double width_mm : {89.0, 183.0})
    for (const SceneFrame frame : {SceneFrame::kPatient, SceneFrame::kCamera, SceneFrame::kAxes}) {
      Scene scene = lopsidedScene();
      scene.frame = frame;
      FourPanelOptions options = optionsFor(scene);
      options.style.width_mm = width_mm;
      options.width_mm = 0;  // as a figure chooses it
      const VectorDrawing drawing = drawFourPanels(scene, options);
      std::size_t contour_points = 0;
      for (const DrawnLine& line : partsOf<DrawnLine>(drawing)) {
        if (line.points.size() <= 2) continue;  // bars, rims, samples of the legend
        contour_points += line.points.size();
        for (const DrawnText& text : partsOf<DrawnText>(drawing)) {
          const double length_pt = textWidthPt(text);
          const double left_pt =
              text.at.x_pt - length_pt * static_cast<int>(text.anchor) / 2.0;  // start, middle, end
          for (const PointPt& p : line.points)
            EXPECT_FALSE(p.x_pt > left_pt && p.x_pt < left_pt + length_pt &&
                         p.y_pt < text.at.y_pt && p.y_pt > text.at.y_pt - 0.7 * text.size_pt)
                << text.text << " lies on a contour, " << width_mm << " mm wide";
        }
      }
      EXPECT_GT(contour_points, 20u);
    }
}

TEST(FourPanels, TheColourBarSpansTheRangeOfTheErrors) {
  Scene scene = lopsidedScene();
  scene.surfaces[1].errors_mm.assign(8, 0.5);
  FourPanelOptions options = optionsFor(scene);
  options.foot.colours = ErrorColours{false, 2};
  options.foot.bar.any_above = true;
  const auto words = wordsOfDrawing(drawFourPanels(scene, options));
  for (const char* word : {"0.0", "0.5", "1.0", "1.5", "2.0", "distance to the surface [mm]"})
    EXPECT_EQ(words.count(word), 1u) << word;
  options.foot.colours = ErrorColours{true, 2};
  EXPECT_EQ(wordsOfDrawing(drawFourPanels(scene, options)).count("-2"), 1u);
}

TEST(ErrorColours, MeanTheSameInPictureAndBar) {
  const ErrorColours signed_colours{true, 2}, absolute{false, 2};
  EXPECT_EQ(signed_colours.colour(0), (Rgb8{247, 247, 247}));
  EXPECT_GT(signed_colours.colour(1).red, signed_colours.colour(1).blue + 50) << "outside is red";
  EXPECT_GT(signed_colours.colour(-1).blue, signed_colours.colour(-1).red + 50);
  EXPECT_EQ(absolute.colour(2), viridis(1));
  EXPECT_EQ(absolute.colour(9), viridis(1));
  EXPECT_EQ(absolute.colour(NAN), kUnmeasuredGrey);
}

/// How the grey values change across a contour: 4 mm inside and outside of each of its points.
struct EdgeValues {
  double inside_median = 0, share_with_step = 0;
};

EdgeValues acrossContour(const Volume& volume, const TriangleMesh& mesh, const ViewPlane& view) {
  std::vector<float> inside;
  int points = 0, steps = 0;
  for (const ContourLine& line :
       planeContours(mesh, SectionPlane{view.centre_mm, view.towardsViewer()})) {
    double area = 0;  // its sign: which way the line runs
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Eigen::Vector2d a = view.project(line[i - 1].cast<double>()),
                            b = view.project(line[i].cast<double>());
      area += a.x() * b.y() - a.y() * b.x();
    }
    for (std::size_t i = 3; i + 3 < line.size(); i += 3) {
      const Eigen::Vector3d along = (line[i + 3] - line[i - 3]).cast<double>();
      if (along.norm() < 1e-6) continue;
      const Eigen::Vector3d inwards =
          (area > 0 ? 1 : -1) * view.towardsViewer().cross(along).normalized();
      const Eigen::Vector3d p = line[i].cast<double>();
      const float in = volume.atPoint(p + 4 * inwards), out = volume.atPoint(p - 4 * inwards);
      if (std::isnan(in) || std::isnan(out)) continue;
      inside.push_back(in);
      ++points;
      steps += std::abs(out - in) > 40;
    }
  }
  std::sort(inside.begin(), inside.end());
  return {inside.empty() ? NAN : inside[inside.size() / 2], double(steps) / std::max(points, 1)};
}

struct CtCase {
  const char *volume, *mesh;
  double low_hu, high_hu;  // of the organ
};
class ContourOnCt : public testing::TestWithParam<CtCase> {};

TEST_P(ContourOnCt, LiesOnTheOrgansEdgeInAllThreePlanes) {
  SOFTSCOPE_DATA_OR_SKIP(ct, "ct");
  const Volume volume = readVolume(ct / GetParam().volume);
  TriangleMesh mesh = readMesh(ct / GetParam().mesh);
  const Eigen::Vector3d centre = boxOf({{"", mesh, {}, {}}}).center();
  const auto views = [&] {
    return std::vector<ViewPlane>{
        axialView(centre, SceneFrame::kPatient, SideRule::kRadiological),
        coronalView(centre, SceneFrame::kPatient, SideRule::kRadiological),
        sagittalView(centre, SceneFrame::kPatient)};
  };
  double share = 0, mirrored_share = 0;
  for (const ViewPlane& view : views()) {
    const EdgeValues edge = acrossContour(volume, mesh, view);
    EXPECT_GT(edge.inside_median, GetParam().low_hu) << view.name;
    EXPECT_LT(edge.inside_median, GetParam().high_hu) << view.name;
    share += edge.share_with_step / 3;
  }
  for (Eigen::Vector3f& p : mesh.vertices_mm) p.x() = float(2 * centre.x()) - p.x();
  for (const ViewPlane& view : views())
    mirrored_share += acrossContour(volume, mesh, view).share_with_step / 3;
  RecordProperty("share", std::to_string(share));
  RecordProperty("mirrored_share", std::to_string(mirrored_share));
  // Organs touch others of like values, so not every point of the edge has a step.
  EXPECT_GT(share, 0.6) << "mirrored: " << mirrored_share;
  EXPECT_GT(share, mirrored_share + 0.1) << "left and right must not be exchangeable";
}

INSTANTIATE_TEST_SUITE_P(
    Organs, ContourOnCt,
    testing::Values(
        CtCase{"chaos_dicom", "chaos_set3_liver_LPSmm.ply", 80, 160},
        CtCase{"chaos_set3_ct_256x256x78.mha", "chaos_set3_liver_LPSmm.ply", 80, 160},
        CtCase{"chaos_set3_ct_256x256x78.nrrd", "chaos_set3_liver_LPSmm.ply", 80, 160},
        CtCase{"chaos_set3_ct_256x256x78.nii.gz", "chaos_set3_liver_LPSmm.ply", 80, 160},
        CtCase{"totalseg_cta.nii.gz", "totalseg_heart_1p5mm_LPS.ply", 60, 600},
        CtCase{"totalseg_abdomen.nii.gz", "totalseg_example_kidney_right_3mm_LPS.ply", 0, 60}));

TEST(FourPanels, OneCtInFourFormatsGivesOnePicture) {
  SOFTSCOPE_DATA_OR_SKIP(ct, "ct");
  const TriangleMesh mesh = readMesh(ct / "chaos_set3_liver_LPSmm.ply");
  std::vector<std::vector<std::vector<PointPt>>> contours;
  for (const char* name : {"chaos_dicom", "chaos_set3_ct_256x256x78.mha",
                           "chaos_set3_ct_256x256x78.nrrd", "chaos_set3_ct_256x256x78.nii.gz"}) {
    Scene scene;
    scene.volume = readVolume(ct / name);
    scene.window = parseWindow("auto", *scene.volume);
    scene.surfaces.push_back({"reference", mesh, surfaceColour(0), {}});
    VectorDrawing drawing;
    FigureStyle coarse;
    coarse.dots_per_inch = 60;
    drawSlicePanel(scene,
                   coronalView(sceneCentre(scene), SceneFrame::kPatient, SideRule::kRadiological),
                   200, {{0, 0}, 200, 200}, coarse, drawing);
    contours.emplace_back();
    for (const DrawnLine& line : partsOf<DrawnLine>(drawing))
      contours.back().push_back(line.points);
    ASSERT_EQ(contours.back().size(), contours.front().size()) << name;
    for (std::size_t i = 0; i < contours.back().size(); ++i)
      for (std::size_t k = 0; k < contours.back()[i].size(); ++k) {
        EXPECT_NEAR(contours.back()[i][k].x_pt, contours[0][i][k].x_pt, 1e-3) << name;
        EXPECT_NEAR(contours.back()[i][k].y_pt, contours[0][i][k].y_pt, 1e-3) << name;
      }
  }
}

}  // namespace
}  // namespace softscope
