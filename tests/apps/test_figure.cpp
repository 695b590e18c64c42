// tests/apps/test_figure.cpp: `softscope figure` from files to figures and their records.
#include <cmath>
#include <fstream>

#include "io/geometry/ply_writer.h"
#include "tests/apps/evaluate_fixture.h"
#include "vtk_views/drawing/fonts.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A box of quads with corners at `low` and `high`.
std::string boxObj(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                   const std::string& head = "") {
  std::string text = head;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                            (i & 4) != 0 ? high.z() : low.z());
    text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
            std::to_string(p.z()) + "\n";
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// 40 x 30 x 20 voxels of 2 mm from (-40, -30, -20) on, all 50 HU but the first, air.
std::string ctMha() {
  std::string voxels(40 * 30 * 20 * 2, '\0');
  for (std::size_t i = 0; i < voxels.size(); i += 2) voxels[i] = 50;
  voxels[0] = char(0x18);  // -1000
  voxels[1] = char(0xfc);
  voxels[2] = char(0xe8);  // 1000
  voxels[3] = char(0x03);
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "Offset = -40 -30 -20\nElementSpacing = 2 2 2\nDimSize = 40 30 20\n"
         "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
         voxels;
}

class Figure : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("ct.mha", ctMha());
    write("reference.obj", boxObj({-20, -10, -8}, {20, 10, 8}, "# SPACE=LPS\n"));
    write("model.obj", boxObj({-20, -10, -8}, {20.5, 10, 8}));
  }
  Outcome figure(std::vector<std::string> more) const {
    more.insert(more.begin(), "figure");
    return softscope::test::run(more);
  }
};

TEST_F(Figure, TheTestIsBroughtToTheReferenceWhereAsked) {
  write("away.obj", boxObj({-17, -10, -8}, {23, 10, 8}));  // 3 mm to the left
  const auto record = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line{"--reference", at("reference.obj"), "--test", at("away.obj"),
                                  "--out",       at("f.svg"),         "--json", "--force"};
    line.insert(line.end(), more.begin(), more.end());
    const Outcome outcome = figure(line);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("written: " + at("f.svg") + ", " + at("f.json")));
    return outcome.json();
  };
  const Json as_it_is = record({});
  EXPECT_EQ(as_it_is["errors"]["alignment"], "none");
  EXPECT_FALSE(as_it_is.contains("alignment"));
  const std::string pairs = write("pairs.csv",
                                  "test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,"
                                  "reference_z_mm\n3,0,0,0,0,0\n13,0,0,10,0,0\n3,9,0,0,9,0\n");
  const Json marks = record({"--align-landmarks", pairs});
  EXPECT_EQ(marks["errors"]["alignment"], "landmarks");
  EXPECT_NEAR(double(marks["errors"]["distance"]["mean_mm"]), 0, 1e-5);
  EXPECT_NEAR(double(marks["alignment"]["before"]["max_mm"]), 3, 1e-5);
  EXPECT_NEAR(double(marks["alignment"]["reference_from_test"][0][3]), -3, 1e-5);
  EXPECT_THAT(std::string(marks["surfaces"][1]["space"]), HasSubstr("aligned: landmarks"));
  EXPECT_THAT(textOf(at("f.svg")), HasSubstr("Alignment: landmarks (mean distance before it"));
  EXPECT_EQ(record({"--align", "icp"})["alignment"]["method"], "icp");
  EXPECT_EQ(figure({"--reference", at("reference.obj"), "--align", "icp", "--out", at("g.svg")})
                .exit_code,
            2);
  EXPECT_EQ(figure({"--reference", at("reference.obj"), "--test", at("away.obj"), "--align",
                    "landmarks", "--out", at("g.svg")})
                .exit_code,
            2);
}

TEST_F(Figure, FourPanelsInThreeFormatsWithTheirRecord) {
  const Outcome outcome =
      figure({"--ct", at("ct.mha"), "--reference", at("reference.obj"), "--test", at("model.obj"),
              "--out", at("f.png"), "--out", at("f.pdf"), "--out", at("f.svg"), "--dpi", "100",
              "--range-mm", "1", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
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
  EXPECT_EQ(record, outcome.json());
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

TEST_F(Figure, TheSameInputsGiveTheSameBytes) {
  for (const char* name : {"a", "b"})
    for (const char* ending : {".png", ".pdf", ".svg"})
      ASSERT_EQ(figure({"--ct", at("ct.mha"), "--reference", at("reference.obj"), "--dpi", "100",
                        "--force", "--out", at(std::string(name) + ending)})
                    .exit_code,
                0);
  for (const char* ending : {".png", ".pdf", ".svg", ".json"})
    EXPECT_EQ(textOf(at(std::string("a") + ending)), textOf(at(std::string("b") + ending)))
        << ending;
}

TEST_F(Figure, MatchesAreFoundAnewWithTheRunsOwnSettings) {
  const std::string clip = makeSequence("clip", 3);
  ASSERT_EQ(softscope::test::run({"reconstruct", clip, "--out", at("run"), "--save-every", "1",
                                  "--set", "stereo.disparity_max_px=63", "--quiet"})
                .exit_code,
            0);
  const auto matches = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"figure", at("run"), "--kind", "matches", "--reference", clip,
                               "--out", at("m.svg"), "--force", "--json"});
    return softscope::test::run(more);
  };
  const Outcome outcome = matches({});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json record = outcome.json();
  EXPECT_EQ(record["frame"], 2);
  EXPECT_EQ(record["model_frame"], 1);
  ASSERT_EQ(record["matchers"].size(), 2u);
  const Json dense = record["matchers"][0], sift = record["matchers"][1];
  EXPECT_EQ(dense["matcher"], "dense-surf");
  EXPECT_GT(dense["inliers"], 100);
  EXPECT_GT(dense["with_depth"], 3 * sift["with_depth"].get<int>()) << "that is why it is dense";
  for (const char* word : {">model view<", ">left image, frame 2<", ">(b) SIFT: "})
    EXPECT_THAT(textOf(at("m.svg")), HasSubstr(word));
  EXPECT_EQ(matches({"--frame", "1"}).json()["model_frame"], 0);
  EXPECT_EQ(matches({"--frame", "0"}).exit_code, 2) << "no model is older";
  EXPECT_EQ(matches({"--frame", "9"}).exit_code, 2);
  fs::remove(at("run/run.json"));
  EXPECT_EQ(matches({}).exit_code, 3);
}

class Slice : public Figure {
 protected:
  Outcome slice(std::vector<std::string> more) const {
    more.insert(more.begin(), "slice");
    return softscope::test::run(more);
  }
};

TEST_F(Slice, APlaneHasAPanelAtEachPosition) {
  const Outcome outcome = slice({at("ct.mha"), "--surface", at("reference.obj"), "--plane", "axial",
                                 "--positions", "-6:6:6", "--out", at("s.svg"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json record = outcome.json();
  ASSERT_EQ(record["views"].size(), 3u);
  EXPECT_EQ(record["views"][0]["centre_mm"][2], -6.0);
  EXPECT_EQ(record["views"][2]["side_right"], "L");
  const std::string svg = textOf(at("s.svg"));
  for (const char* part : {">(a) axial, I 6.0 mm<", ">(c) axial, S 6.0 mm<", ">reference.obj<"})
    EXPECT_THAT(svg, HasSubstr(part));
}

TEST_F(Slice, ObliquePlanesAndSideRulesAreHonoured) {
  const Outcome outcome =
      slice({at("ct.mha"), "--plane", "oblique", "--normal", "0,1,1", "--positions", "0,2", "--at",
             "1,2,3", "--neurological", "--out", at("o.png"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json view = outcome.json()["views"][1];
  EXPECT_EQ(view["name"], "oblique, +2.0 mm");
  EXPECT_NEAR(view["centre_mm"][1], 2 + std::sqrt(2.0), 1e-9);
  EXPECT_EQ(outcome.json()["sides"], "neurological");
  ASSERT_EQ(slice({at("ct.mha"), "--plane", "oblique", "--normal", "0,1,1", "--at", "1,2,-3",
                   "--plane", "axial", "--out", at("through.svg")})
                .exit_code,
            0);
  EXPECT_THAT(textOf(at("through.svg")), HasSubstr("Oblique plane through L 1.0, P 2.0, I 3.0 mm; "
                                                   "normal L 0.00, P 0.71, S 0.71"));
  EXPECT_EQ(view["side_right"], "R");
}

TEST_F(Slice, PlanesMeetAtALandmarkOrInTheModel) {
  write("points.csv", "name,x_mm,y_mm,z_mm\napex,1,2,3\nhilum,4,5,6\n");
  write("points.fcsv",
        "# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n"
        "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
        "1,-4,-5,6,0,0,0,1,1,1,0,hilum,,\n");
  const auto centre = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {at("ct.mha"), "--reference", at("reference.obj"), "--surface",
                               at("model.obj"), "--out", at("l.svg"), "--force", "--json"});
    const Outcome outcome = slice(more);
    return outcome.exit_code == 0 ? outcome.json()["views"][0]["centre_mm"] : Json(outcome.err);
  };
  EXPECT_EQ(centre({"--landmarks", at("points.csv"), "--at", "apex"}), (Json{1.0, 2.0, 3.0}));
  EXPECT_EQ(centre({"--landmarks", at("points.fcsv"), "--at", "hilum"}), (Json{4.0, 5.0, 6.0}));
  EXPECT_THAT(textOf(at("l.svg")), HasSubstr(">reference<"));
  EXPECT_THAT(centre({"--landmarks", at("points.csv"), "--at", "apx"}).dump(),
              HasSubstr("did you mean `apex`"));
  EXPECT_THAT(centre({"--landmarks", at("points.csv")}).dump(), HasSubstr("needs --at"));
  write("points.csv", "name,x_mm,y_mm,z_mm\napex,1,two,3\n");
  EXPECT_THAT(centre({"--landmarks", at("points.csv"), "--at", "apex"}).dump(),
              HasSubstr("line 2: `two` is no coordinate"));
  write("model.obj", boxObj({10, 10, 10}, {14, 12, 18}));
  EXPECT_EQ(centre({"--at", "model"})[2], 18.0) << "the median of eight corners is one of them";
  EXPECT_EQ(slice({at("ct.mha"), "--at", "model", "--out", at("m.svg")}).exit_code, 2);
}

TEST_F(Slice, BadLinesAreRefused) {
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--plane", "axiall"},
           {"--plane", "oblique"},
           {"--plane", "axial", "--plane", "coronal", "--positions", "1,2"},
           {"--plane", "axial", "--positions", "1:2"},
           {"--plane", "axial", "--positions", "0:1000:1"},
           {"--plane", "axial", "--positions", "a"},
           {"--columns", "-1"}}) {
    std::vector<std::string> line{at("ct.mha"), "--out", at("x.svg")};
    line.insert(line.end(), wrong.begin(), wrong.end());
    const Outcome outcome = slice(line);
    EXPECT_EQ(outcome.exit_code, 2) << wrong[1] << outcome.err;
    EXPECT_FALSE(fs::exists(at("x.svg")));
  }
  EXPECT_EQ(slice({"--out", at("y.svg")}).exit_code, 2) << "nothing to slice";
}

TEST_F(Figure, TheBarEndsNearTheNinetyFifthPercentile) {
  PointCloud cloud;  // 0.4 mm before the box, one point 5 mm
  for (int i = 0; i < 100; ++i)
    cloud.points_mm.emplace_back(float(i % 10), float(i / 10) - 5, i == 50 ? 13.0f : 8.4f);
  writePly(at("points.ply"), cloud, {"", ""});
  const Outcome outcome = figure({"--reference", at("reference.obj"), "--test", at("points.ply"),
                                  "--out", at("p.svg"), "--dpi", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(outcome.json()["errors"]["distance"]["max_mm"], 5, 1e-5);
  EXPECT_EQ(outcome.json()["errors"]["range_mm"], (Json{0.0, 0.5}));
}

TEST_F(Figure, ARasMeshIsTurnedAndADistantOneTold) {
  write("ras.obj", boxObj({-20, -10, -8}, {20, 25, 8}, "# SPACE=RAS\n"));
  ASSERT_EQ(figure({"--reference", at("ras.obj"), "--out", at("ras.svg")}).exit_code, 0);
  const Json record = Json::parse(textOf(at("ras.json")));
  EXPECT_EQ(record["surfaces"][0]["low_mm"][1], -25.0);
  EXPECT_THAT(record["surfaces"][0]["space"].dump(), HasSubstr("negated"));
  write("far.obj", boxObj({500, 0, 0}, {520, 10, 8}));
  const Outcome outcome =
      figure({"--ct", at("ct.mha"), "--reference", at("far.obj"), "--out", at("far.svg")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("beside the volume"));
}

TEST_F(Figure, SidesAreNamedAsInAComparison) {
  const auto sidesOf = [&](const std::string& head) {
    write("box.obj", boxObj({-20, -10, -8}, {20, 25, 8}, head));
    EXPECT_EQ(figure({"--reference", at("box.obj"), "--out", at("box.svg"), "--force"}).exit_code,
              0);
    EXPECT_EQ(run({"compare", "--reference", at("box.obj"), "--test", at("box.obj"), "--out",
                   at("compared"), "--force"})
                  .exit_code,
              0);
    return std::pair(textOf(at("box.svg")), textOf(at("compared/error_map.svg")));
  };
  const auto [figure_known, compare_known] = sidesOf("# SPACE=LPS\n");
  EXPECT_THAT(figure_known, HasSubstr(">S<"));
  EXPECT_THAT(compare_known, testing::ContainsRegex("seen from [RLAPIS]+<"));
  const auto [figure_axes, compare_axes] = sidesOf("");
  EXPECT_THAT(figure_axes, HasSubstr(">+z<"));
  EXPECT_THAT(compare_axes, testing::ContainsRegex("seen from [-+][xyz]"));
}

TEST_F(Figure, AModelInItsScopesFrameIsTold) {
  PointCloud cloud;
  for (int i = 0; i < 50; ++i) cloud.points_mm.emplace_back(float(i % 10), float(i / 10), 50.0f);
  writePly(at("model.ply"), cloud, {"world", ""});
  ASSERT_EQ(figure({"--test", at("model.ply"), "--dpi", "100", "--out", at("m.svg")}).exit_code, 0);
  EXPECT_THAT(textOf(at("m.svg")), HasSubstr("from the scope, z 50.0 mm<"));
  const Outcome outcome = figure(
      {"--ct", at("ct.mha"), "--test", at("model.ply"), "--dpi", "100", "--out", at("n.svg")});
  EXPECT_THAT(outcome.err, HasSubstr("lies in a scope's frame (world)"));
}

TEST_F(Figure, AStrangeNameAndACtAloneAreDrawn) {
  const std::string name = "bad\xff<b>&.obj";
  write(name, boxObj({-5, -5, -5}, {5, 5, 5}));
  EXPECT_EQ(figure({"--surface", at(name), "--dpi", "60", "--out", at("a.png")}).exit_code, 0);
  ASSERT_EQ(figure({"--ct", at("ct.mha"), "--dpi", "60", "--out", at("b.svg")}).exit_code, 0);
  EXPECT_THAT(textOf(at("b.svg")), testing::Not(HasSubstr("(d)"))) << "nothing to show in 3-D";
}

TEST_F(Figure, BadInputEndsInOneLine) {
  write("cut.mha", ctMha().substr(0, 9000));
  const auto oneLine = [](const Outcome& outcome, int code) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  oneLine(figure({"--ct", at("cut.mha"), "--out", at("x.png")}), 3);
  oneLine(figure({"--ct", at("none"), "--out", at("x.png")}), 3);
  oneLine(figure({"--reference", at("ct.mha"), "--out", at("x.png")}), 3);
  const std::vector<std::string> good{"--reference", at("reference.obj"), "--out", at("x.png")};
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--style", "iee"},
                                             {"--width-mm", "3"},
                                             {"--dpi", "-1"},
                                             {"--at", "1,2"},
                                             {"--errors", "some"},
                                             {"--columns", "3"},
                                             {"--out", at("x.jpg")},
                                             {"--ct", at("ct.mha"), "--window", "bones"},
                                             {"--eye", "0,0,0"}}) {
    std::vector<std::string> line = good;
    line.insert(line.end(), wrong.begin(), wrong.end());
    oneLine(figure(line), 2);
  }
  oneLine(figure({"--out", at("x.png")}), 2);
  EXPECT_FALSE(fs::exists(at("x.png"))) << "nothing half-made";
  EXPECT_EQ(figure(good).exit_code, 0);
  oneLine(figure(good), 2);  // it is there now
}

}  // namespace
}  // namespace softscope::test
