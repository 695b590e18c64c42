// tests/toolkit/figures_test.cpp: figures of surfaces and volumes, and their records.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <type_traits>

#include "io/geometry/ply_writer.h"
#include "support/in_folder.h"
#include "support/made_meshes.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"
#include "toolkit/comparison/compare_files.h"
#include "toolkit/comparison/compare_outputs.h"
#include "toolkit/figures/draw_figure.h"
#include "toolkit/figures/figure_outputs.h"
#include "toolkit/figures/slice_figure.h"
#include "vtk_views/drawing/fonts.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Draws the figure and writes its files.
template <class Request>
Json drawn(const Request& request, std::vector<std::string>* warnings = nullptr) {
  DrawnFigure figure;
  if constexpr (std::is_same_v<Request, SliceRequest>)
    figure = drawSliceFigure(request);
  else
    figure = drawFigure(request);
  writeFigure(figure.drawing, request.page, figure.record);
  if (warnings != nullptr) *warnings = figure.warnings;
  return written(figure.record);
}

class Figures : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("ct.mha", ctMha());
    write("reference.obj", boxObj({-20, -10, -8}, {20, 10, 8}, "# SPACE=LPS\n"));
    write("model.obj", boxObj({-20, -10, -8}, {20.5, 10, 8}));
  }
  /// To a file in the folder, with a low resolution.
  FigureRequest figure(const std::string& out) const {
    FigureRequest request;
    request.page.out = {at(out)};
    request.page.dots_per_inch = 100;
    request.page.force = true;
    return request;
  }
  FigureRequest ofReference(const std::string& out) const {
    FigureRequest request = figure(out);
    request.reference = at("reference.obj");
    return request;
  }
};

TEST_F(Figures, TheTestIsBroughtToTheReferenceWhereAsked) {
  write("away.obj", boxObj({-17, -10, -8}, {23, 10, 8}));  // 3 mm to the left
  FigureRequest request = ofReference("f.svg");
  request.test = at("away.obj");
  const Json as_it_is = drawn(request);
  EXPECT_EQ(as_it_is["errors"]["alignment"], "none");
  EXPECT_FALSE(as_it_is.contains("alignment"));
  const std::string pairs = write("pairs.csv",
                                  "test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,"
                                  "reference_z_mm\n3,0,0,0,0,0\n13,0,0,10,0,0\n3,9,0,0,9,0\n");
  request.fit.landmarks = pairs;
  const Json marks = drawn(request);
  EXPECT_EQ(marks["errors"]["alignment"], "landmarks");
  EXPECT_NEAR(double(marks["errors"]["distance"]["mean_mm"]), 0, 1e-5);
  EXPECT_NEAR(double(marks["alignment"]["before"]["max_mm"]), 3, 1e-5);
  EXPECT_NEAR(double(marks["alignment"]["reference_from_test"][0][3]), -3, 1e-5);
  EXPECT_THAT(std::string(marks["surfaces"][1]["space"]), HasSubstr("aligned: landmarks"));
  EXPECT_THAT(textOf(at("f.svg")), HasSubstr("Alignment: landmarks (mean distance before it"));
  request.fit = {};
  request.fit.closest_points = true;
  EXPECT_EQ(drawn(request)["alignment"]["method"], "icp");
  request.test.clear();
  expectError<OptionError>([&] { drawFigure(request); }, {"align"});
}

TEST_F(Figures, FourPanelsInThreeFormatsWithTheirRecord) {
  FigureRequest request = ofReference("f.png");
  request.ct = at("ct.mha");
  request.test = at("model.obj");
  request.page.out = {at("f.png"), at("f.pdf"), at("f.svg")};
  request.errors.range_mm = 1;
  const Json drawing = drawn(request);
  EXPECT_EQ(textOf(at("f.png")).substr(1, 3), "PNG");
  // 100 dots an inch are 3937 = 0x0f61 a metre; the check sum is zlib's.
  EXPECT_EQ(textOf(at("f.png")).substr(33, 21),
            std::string("\0\0\0\x09pHYs\0\0\x0f\x61\0\0\x0f\x61\1", 17) +
                "\xa8"
                "\x3f"
                "\xa7"
                "\x69");
  EXPECT_EQ(textOf(at("f.pdf")).substr(0, 5), "%PDF-");
  const std::string svg = textOf(at("f.svg"));
  for (const char* part : {">R<", ">S<", ">10 mm<", ">(a) axial, S 0.0 mm<", ">reference<",
                           ">distance to the surface [mm]<", "<polyline", "<image"})
    EXPECT_THAT(svg, HasSubstr(part));
  const Json record = Json::parse(textOf(at("f.json")));
  EXPECT_EQ(record, drawing);
  EXPECT_EQ(record["inputs"].size(), 3u);
  EXPECT_EQ(record["inputs"][0]["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(record["errors"]["range_mm"], (Json{0.0, 1.0}));
  EXPECT_EQ(record["errors"]["distance"]["n"], 8);
  EXPECT_NEAR(record["errors"]["distance"]["max_mm"], 0.5, 1e-6);
  EXPECT_EQ(record["views"][0]["side_right"], "L");
  EXPECT_EQ(record["volume"]["window"]["name"], "soft-tissue");
  EXPECT_EQ(record["style"]["font"], figureFont());
  EXPECT_THAT(svg, HasSubstr("font-family=\"" + figureFont()));
}

TEST_F(Figures, TheSameInputsGiveTheSameBytes) {
  for (const char* name : {"a", "b"})
    for (const char* ending : {".png", ".pdf", ".svg"}) {
      FigureRequest request = ofReference(std::string(name) + ending);
      request.ct = at("ct.mha");
      drawn(request);
    }
  for (const char* ending : {".png", ".pdf", ".svg", ".json"})
    EXPECT_EQ(textOf(at(std::string("a") + ending)), textOf(at(std::string("b") + ending)))
        << ending;
}

TEST_F(Figures, MatchesAreFoundAnewWithTheRunsOwnSettings) {
  const SlopeRun& made = slopeRun();  // of four frames
  FigureRequest request = figure("m.svg");
  request.kind = "matches";
  request.run = made.run;
  request.reference = made.sequence;
  const Json record = drawn(request);
  EXPECT_EQ(record["frame"], 3);
  EXPECT_EQ(record["model_frame"], 2);
  ASSERT_EQ(record["matchers"].size(), 2u);
  const Json dense = record["matchers"][0], sift = record["matchers"][1];
  EXPECT_EQ(dense["matcher"], "dense-surf");
  EXPECT_GT(dense["inliers"], 100);
  EXPECT_GT(dense["with_depth"], 3 * sift["with_depth"].get<int>()) << "that is why it is dense";
  for (const char* word : {">model view<", ">left image, frame 3<", ">(b) SIFT: "})
    EXPECT_THAT(textOf(at("m.svg")), HasSubstr(word));
  request.frame = 1;
  EXPECT_EQ(drawn(request)["model_frame"], 0);
  for (const int frame : {0, 9}) {  // no model is older; none is so new
    request.frame = frame;
    expectError<OptionError>([&] { drawFigure(request); }, {});
  }
  fs::copy(made.run, at("run"), fs::copy_options::recursive);
  fs::remove(at("run/run.json"));
  request.frame = -1;
  request.run = at("run");
  expectError<InputError>([&] { drawFigure(request); }, {"run.json"});
}

class Slices : public Figures {
 protected:
  SliceRequest slice(const std::string& out) const {
    SliceRequest request;
    request.ct = at("ct.mha");
    request.page.out = {at(out)};
    request.page.force = true;
    return request;
  }
};

TEST_F(Slices, APlaneHasAPanelAtEachPosition) {
  SliceRequest request = slice("s.svg");
  request.surfaces = {at("reference.obj")};
  request.planes = {"axial"};
  request.positions = "-6:6:6";
  const Json record = drawn(request);
  ASSERT_EQ(record["views"].size(), 3u);
  EXPECT_EQ(record["views"][0]["centre_mm"][2], -6.0);
  EXPECT_EQ(record["views"][2]["side_right"], "L");
  const std::string svg = textOf(at("s.svg"));
  for (const char* part : {">(a) axial, I 6.0 mm<", ">(c) axial, S 6.0 mm<", ">reference.obj<"})
    EXPECT_THAT(svg, HasSubstr(part));
}

TEST_F(Slices, ObliquePlanesAndSideRulesAreHonoured) {
  SliceRequest request = slice("o.png");
  request.planes = {"oblique"};
  request.normal = "0,1,1";
  request.positions = "0,2";
  request.page.at = "1,2,3";
  request.page.neurological = true;
  const Json record = drawn(request);
  const Json& view = record["views"][1];
  EXPECT_EQ(view["name"], "oblique, +2.0 mm");
  EXPECT_NEAR(view["centre_mm"][1], 2 + std::sqrt(2.0), 1e-9);
  EXPECT_EQ(record["sides"], "neurological");
  SliceRequest through = slice("through.svg");
  through.planes = {"oblique", "axial"};
  through.normal = "0,1,1";
  through.page.at = "1,2,-3";
  drawn(through);
  EXPECT_THAT(textOf(at("through.svg")), HasSubstr("Oblique plane through L 1.0, P 2.0, I 3.0 mm; "
                                                   "normal L 0.00, P 0.71, S 0.71"));
  EXPECT_EQ(view["side_right"], "R");
}

TEST_F(Slices, PlanesMeetAtALandmarkOrInTheModel) {
  write("points.csv", "name,x_mm,y_mm,z_mm\napex,1,2,3\nhilum,4,5,6\n");
  write("points.fcsv",
        "# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n"
        "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
        "1,-4,-5,6,0,0,0,1,1,1,0,hilum,,\n");
  SliceRequest request = slice("l.svg");
  request.reference = at("reference.obj");
  request.surfaces = {at("model.obj")};
  const auto centre = [&](const std::string& landmarks, const std::string& place) {
    request.page.landmarks = landmarks;
    request.page.at = place;
    return drawn(request)["views"][0]["centre_mm"];
  };
  EXPECT_EQ(centre(at("points.csv"), "apex"), (Json{1.0, 2.0, 3.0}));
  EXPECT_EQ(centre(at("points.fcsv"), "hilum"), (Json{4.0, 5.0, 6.0}));
  EXPECT_THAT(textOf(at("l.svg")), HasSubstr(">reference<"));
  expectError<OptionError>([&] { centre(at("points.csv"), "apx"); }, {"did you mean `apex`"});
  expectError<OptionError>([&] { centre(at("points.csv"), ""); }, {"needs `at=`"});
  expectError<OptionError>([&] { centre("", "apex"); }, {"`at=` is `apex`", "with `landmarks=`"});
  write("points.csv", "name,x_mm,y_mm,z_mm\napex,1,two,3\n");
  expectError<InputError>([&] { centre(at("points.csv"), "apex"); },
                          {"line 2: `two` is no coordinate"});
  write("model.obj", boxObj({10, 10, 10}, {14, 12, 18}));
  EXPECT_EQ(centre("", "model")[2], 18.0) << "the median of eight corners is one of them";
  SliceRequest bare = slice("m.svg");
  bare.page.at = "model";
  expectError<OptionError>([&] { drawSliceFigure(bare); }, {"model"});
}

TEST_F(Slices, WhatCannotBeSlicedIsRefused) {
  const auto refused = [&](const std::function<void(SliceRequest&)>& change) {
    SliceRequest request = slice("x.svg");
    change(request);
    expectError<OptionError>([&] { drawn(request); }, {});
    EXPECT_FALSE(fs::exists(at("x.svg")));
  };
  const auto positions = [](const char* text) {
    return [text](SliceRequest& wrong) {
      wrong.planes = {"axial"};
      wrong.positions = text;
    };
  };
  refused([](SliceRequest& wrong) { wrong.planes = {"axiall"}; });
  refused([](SliceRequest& wrong) { wrong.planes = {"oblique"}; });
  refused([](SliceRequest& wrong) {
    wrong.planes = {"axial", "coronal"};
    wrong.positions = "1,2";
  });
  for (const char* text : {"1:2", "0:1000:1", "a"}) refused(positions(text));
  refused([](SliceRequest& wrong) { wrong.columns = -1; });
  refused([](SliceRequest& wrong) { wrong.ct.clear(); });  // nothing to slice
}

TEST_F(Slices, PlanesOutsideOfTheVolumeAreToldOrRefused) {
  SliceRequest request = slice("out.svg");
  request.planes = {"axial"};
  const auto refused = [&](const std::vector<std::string>& parts) {
    expectError<OptionError>([&] { drawn(request); }, parts);
    EXPECT_FALSE(fs::exists(at("out.svg")));
  };
  request.positions = "3000";
  refused({"`positions=` is `3000`", "outside of the volume", "z "});
  request.positions.clear();
  request.page.at = "5000,0,0";
  refused({"`at=` is `5000,0,0`", "outside of the volume, x "});
  request.page.at.clear();
  request.positions = "0,3000";
  std::vector<std::string> warnings;
  drawn(request, &warnings);
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("S 3000.0 mm: is outside of the volume")));
  EXPECT_THAT(warnings, testing::Not(testing::Contains(HasSubstr("S 0.0 mm: is outside"))));
  request.ct.clear();
  request.reference = at("reference.obj");
  fs::remove(at("out.svg"));
  request.positions = "3000";
  refused({"outside of the surfaces"});
}

TEST_F(Figures, TheBarEndsNearTheNinetyFifthPercentile) {
  PointCloud cloud;  // 0.4 mm before the box, one point 5 mm
  for (int i = 0; i < 100; ++i)
    cloud.points_mm.emplace_back(float(i % 10), float(i / 10) - 5, i == 50 ? 13.0f : 8.4f);
  writePly(at("points.ply"), cloud, {"", ""});
  FigureRequest request = ofReference("p.svg");
  request.test = at("points.ply");
  const Json record = drawn(request);
  EXPECT_NEAR(record["errors"]["distance"]["max_mm"], 5, 1e-5);
  EXPECT_EQ(record["errors"]["range_mm"], (Json{0.0, 0.5}));
}

TEST_F(Figures, ARasMeshIsTurnedAndADistantOneTold) {
  write("ras.obj", boxObj({-20, -10, -8}, {20, 25, 8}, "# SPACE=RAS\n"));
  FigureRequest turned = figure("ras.svg");
  turned.reference = at("ras.obj");
  drawn(turned);
  const Json record = Json::parse(textOf(at("ras.json")));
  EXPECT_EQ(record["surfaces"][0]["low_mm"][1], -25.0);
  EXPECT_THAT(record["surfaces"][0]["space"].dump(), HasSubstr("negated"));
  write("far.obj", boxObj({500, 0, 0}, {520, 10, 8}));
  FigureRequest distant = figure("far.svg");
  distant.ct = at("ct.mha");
  distant.reference = at("far.obj");
  std::vector<std::string> warnings;
  drawn(distant, &warnings);
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("mm outside of the volume")));
}

TEST_F(Figures, SidesAreNamedAsInAComparison) {
  const auto sidesOf = [&](const std::string& head) {
    write("box.obj", boxObj({-20, -10, -8}, {20, 25, 8}, head));
    FigureRequest request = figure("box.svg");
    request.reference = at("box.obj");
    drawn(request);
    CompareOptions same;
    same.reference = same.test = at("box.obj");
    const FileComparison pair = compareFiles(same);
    CompareOutputs(at("compared"), true)
        .write(pair.result, pair.reference, pair.test, {}, pair.record);
    return std::pair(textOf(at("box.svg")), textOf(at("compared/error_map.svg")));
  };
  const auto [figure_known, compare_known] = sidesOf("# SPACE=LPS\n");
  EXPECT_THAT(figure_known, HasSubstr(">S<"));
  EXPECT_THAT(compare_known, testing::ContainsRegex("seen from [RLAPIS]+<"));
  const auto [figure_axes, compare_axes] = sidesOf("");
  EXPECT_THAT(figure_axes, HasSubstr(">+z<"));
  EXPECT_THAT(compare_axes, testing::ContainsRegex("seen from [-+][xyz]"));
}

TEST_F(Figures, AModelInItsScopesFrameIsTold) {
  PointCloud cloud;
  for (int i = 0; i < 50; ++i) cloud.points_mm.emplace_back(float(i % 10), float(i / 10), 50.0f);
  writePly(at("model.ply"), cloud, {"world", ""});
  FigureRequest request = figure("m.svg");
  request.test = at("model.ply");
  drawn(request);
  EXPECT_THAT(textOf(at("m.svg")), HasSubstr("from the scope, z 50.0 mm<"));
  request.ct = at("ct.mha");
  request.page.out = {at("n.svg")};
  std::vector<std::string> warnings;
  drawn(request, &warnings);
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("is in a camera frame (world)")));
}

TEST_F(Figures, AStrangeNameAndACtAloneAreDrawn) {
  const std::string name = "bad\xff<b>&.obj";
  write(name, boxObj({-5, -5, -5}, {5, 5, 5}));
  FigureRequest strange = figure("a.png"), volume = figure("b.svg");
  strange.page.dots_per_inch = volume.page.dots_per_inch = 60;
  strange.surfaces = {at(name)};
  volume.ct = at("ct.mha");
  drawn(strange);
  EXPECT_EQ(textOf(at("a.png")).substr(1, 3), "PNG");
  drawn(volume);
  EXPECT_THAT(textOf(at("b.svg")), testing::Not(HasSubstr("(d)"))) << "nothing to show in 3-D";
}

TEST_F(Figures, BadInputEndsInOneLine) {
  write("cut.mha", ctMha().substr(0, 9000));
  const auto unread = [&](const std::function<void(FigureRequest&)>& change) {
    FigureRequest request = figure("x.png");
    change(request);
    expectError<InputError>([&] { drawn(request); }, {});
  };
  unread([&](FigureRequest& wrong) { wrong.ct = at("cut.mha"); });
  unread([&](FigureRequest& wrong) { wrong.ct = at("none"); });
  unread([&](FigureRequest& wrong) { wrong.reference = at("ct.mha"); });
  const auto refused = [&](const std::function<void(FigureRequest&)>& change) {
    FigureRequest request = ofReference("x.png");
    change(request);
    expectError<OptionError>([&] { drawn(request); }, {});
  };
  refused([](FigureRequest& wrong) { wrong.page.style = "iee"; });
  refused([](FigureRequest& wrong) { wrong.page.width_mm = 3; });
  refused([](FigureRequest& wrong) { wrong.page.dots_per_inch = -1; });
  refused([](FigureRequest& wrong) { wrong.page.at = "1,2"; });
  refused([](FigureRequest& wrong) { wrong.errors.kind = "some"; });
  refused([](FigureRequest& wrong) { wrong.columns = 3; });
  refused([&](FigureRequest& wrong) { wrong.page.out.push_back(at("x.jpg")); });
  refused([&](FigureRequest& wrong) {
    wrong.ct = at("ct.mha");
    wrong.page.window = "bones";
  });
  refused([](FigureRequest& wrong) { wrong.eye = Eigen::Vector3d::Zero(); });
  refused([](FigureRequest& wrong) { wrong.reference.clear(); });  // nothing to show
  EXPECT_FALSE(fs::exists(at("x.png"))) << "nothing half-made";
  drawn(ofReference("x.png"));
  refused([](FigureRequest& wrong) { wrong.page.force = false; });  // it is there now
}

}  // namespace
}  // namespace softscope::test
