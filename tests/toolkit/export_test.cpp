// tests/toolkit/export_test.cpp: models, reports and images as files of other programs.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "io/geometry/ply_writer.h"
#include "io/images/image_writer.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "support/made_case.h"
#include "support/made_run.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/records.h"
#include "toolkit/comparison/compare_inputs.h"
#include "toolkit/export/export_model.h"
#include "toolkit/report/write_report.h"
#include "toolkit/run/model_file.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A wavy square of 10 mm, its points 0.25 mm apart.
PointCloud wave() {
  PointCloud cloud;
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 40; ++u) {
      const float x = 0.25f * float(u), y = 0.25f * float(v);
      cloud.points_mm.emplace_back(x, y, 50 + 0.3f * std::sin(x));
      cloud.normals.push_back(Eigen::Vector3f(0.3f * std::cos(x), 0, -1).normalized());
      cloud.colours.push_back({std::uint8_t(5 * u), std::uint8_t(5 * v), 7});
      cloud.weights.push_back(1.0f + float(u));
    }
  return cloud;
}

class ExportModel : public InFolder {
 protected:
  std::string wavePly(const std::string& name = "wave.ply",
                      const PlyComments& comments = {"", "RAS"}) const {
    writePly(at(name), wave(), comments, true);
    return at(name);
  }
  /// From a file or run to a file in the folder.
  ExportRequest request(const std::string& input, const std::string& out) const {
    ExportRequest request;
    request.input = input;
    request.out = at(out);
    return request;
  }
  static Json exported(const ExportRequest& request) {
    return written(exportModel(request).facts.json());
  }
  Json exported(const std::string& input, const std::string& out) const {
    return exported(request(input, out));
  }
  void exportPoints(const std::string& input, const std::string& out) const {
    ExportRequest points = request(input, out);
    points.points = true;
    exportModel(points);
  }
};

TEST_F(ExportModel, MakesASurfaceOfPointsWithTheirColours) {
  const Json json = exported(wavePly(), "a.ply");
  EXPECT_EQ(json.at("points"), 1600);
  EXPECT_EQ(json.at("manifold"), true);
  EXPECT_EQ(json.at("dropped_islands"), 0);
  EXPECT_EQ(json.at("unit"), "mm");
  const TriangleMesh mesh = readMesh(at("a.ply"));
  EXPECT_EQ(int(mesh.triangles.size()), json.at("triangles"));
  ASSERT_EQ(mesh.vertices_mm.size(), 1600u);
  EXPECT_EQ(mesh.colours[41], (Rgb8{5, 5, 7}));
  EXPECT_EQ(mesh.space, "RAS");
  const MeshCheck check = checkMesh(mesh);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_NEAR(check.area_mm2, json.at("area_mm2"), 1e-3);
  const ModelFile file = readModel(at("a.ply"));
  EXPECT_EQ(file.model.weights[41], 2.0f);
}

TEST_F(ExportModel, PointsStayPointsWhereAskedFor) {
  exportPoints(wavePly(), "a.ply");
  const ModelFile file = readModel(at("a.ply"));
  EXPECT_EQ(file.model.positions_mm, wave().points_mm);
  EXPECT_EQ(file.model.normals, wave().normals);
  EXPECT_EQ(file.model.weights, wave().weights);
  expectError<OptionError>([&] { exportPoints(wavePly(), "a.stl"); }, {"`points=` takes .ply"});
}

TEST_F(ExportModel, AMeshBecomesAnotherFormatAndUnit) {
  exported(wavePly(), "a.ply");
  ExportRequest metres = request(at("a.ply"), "m.obj");
  metres.unit = "m";
  exportModel(metres);
  ExportRequest back = request(at("m.obj"), "b.stl");
  back.input_unit_mm = 1000;
  exportModel(back);
  const MeshCheck first = checkMesh(readMesh(at("a.ply"))), last = checkMesh(readMesh(at("b.stl")));
  EXPECT_EQ(last.triangle_count, first.triangle_count);
  EXPECT_NEAR(last.area_mm2, first.area_mm2, 1e-3);
  EXPECT_EQ(readMesh(at("b.stl")).space, "RAS");
}

TEST_F(ExportModel, WhatAFileStatesOfItsUnitIsRead) {
  exported(wavePly(), "a.ply");
  const double area_mm2 = checkMesh(readMesh(at("a.ply"))).area_mm2;
  for (const char* name : {"cm.ply", "cm.obj", "cm.stl", "cm.vtp"}) {
    ExportRequest centimetres = request(at("a.ply"), name);
    centimetres.unit = "cm";
    exportModel(centimetres);
    const TriangleMesh mesh = readSurfaceOrPoints(at(name), kUnitOfFile);
    EXPECT_EQ(mesh.unit_mm, 10) << name;
    EXPECT_NEAR(checkMesh(mesh).area_mm2, area_mm2, 1e-3 * area_mm2) << name;
    const std::string again = std::string("mm_of_") + name + ".ply";
    exported(at(name), again);
    EXPECT_NEAR(checkMesh(readMesh(at(again))).area_mm2, area_mm2, 1e-3 * area_mm2) << name;
    EXPECT_NEAR(checkMesh(readSurfaceOrPoints(at(name), 1)).area_mm2, area_mm2 / 100,
                1e-5 * area_mm2)
        << name << ", as requested";
  }
  ExportRequest points = request(wavePly(), "points.ply");
  points.points = true;
  points.unit = "cm";
  exportModel(points);
  const TriangleMesh read = readSurfaceOrPoints(at("points.ply"), kUnitOfFile);
  ASSERT_EQ(read.vertices_mm.size(), wave().points_mm.size());
  EXPECT_NEAR((read.vertices_mm.back() - wave().points_mm.back()).norm(), 0, 1e-4);
}

TEST_F(ExportModel, TakesRunsTheirFramesAndTheirSeries) {
  makeWallRun(at("run"), 4);  // its walls are too coarse for a surface, not for points
  exportPoints(at("run"), "a.ply");
  EXPECT_EQ(readModel(at("a.ply")).model.positions_mm, wallModel(3).points_mm) << "the last one";
  ExportRequest of_frame = request(at("run"), "b.ply");
  of_frame.points = true;
  of_frame.frame = 2;
  exportModel(of_frame);
  EXPECT_EQ(readModel(at("b.ply")).model.positions_mm, wallModel(2).points_mm);
  ExportRequest series = request(at("run"), "all.pvd");
  series.points = true;
  series.every = 2;
  const Json told = exported(series);
  EXPECT_EQ(told.at("models"), 2);
  EXPECT_EQ(told.at("frames").at(1).at("frame"), 2);
  EXPECT_TRUE(fs::exists(at("all/000000.vtp")));
  EXPECT_TRUE(fs::exists(at("all/000002.vtp")));
  EXPECT_FALSE(fs::exists(at("all/000001.vtp")));
  const std::string list = textOf(at("all.pvd"));
  EXPECT_THAT(list, HasSubstr("file=\"all/000002.vtp\""));
  of_frame.frame = 9;
  of_frame.out = at("c.ply");
  expectError<OptionError>([&] { exportModel(of_frame); }, {"saved are the frames 0, 1, 2, 3"});
}

TEST_F(ExportModel, ASeriesThatIsStoppedLeavesNothing) {
  makeWallRun(at("run"), 4);
  ExportRequest series = request(at("run"), "all.pvd");
  series.points = true;
  std::vector<int> told;
  const auto stopAfterTwo = [&](int done, int total) {
    EXPECT_EQ(total, 4);
    told.push_back(done);
    return done < 2;
  };
  EXPECT_TRUE(exportModel(series, stopAfterTwo).interrupted);
  EXPECT_EQ(told, (std::vector<int>{0, 1, 2}));
  EXPECT_FALSE(fs::exists(at("all.pvd")));
  EXPECT_FALSE(fs::exists(at("all")));
  EXPECT_FALSE(exportModel(series).interrupted);
  EXPECT_TRUE(fs::exists(at("all/000003.vtp")));
}

TEST_F(ExportModel, OverwritesNothingUnlessAskedTo) {
  write("a.ply", "mine");
  ExportRequest over = request(wavePly(), "a.ply");
  expectError<OptionError>([&] { exportModel(over); }, {"a.ply", "`overwrite=`"});
  EXPECT_EQ(textOf(at("a.ply")), "mine");
  over.overwrite = true;
  exportModel(over);
  EXPECT_EQ(readModel(at("a.ply")).model.positions_mm.size(), 1600u);
}

TEST_F(ExportModel, RefusesInOneLineAndLeavesNothing) {
  PointCloud bare = wave();
  bare.normals.clear();
  writePly(at("bare.ply"), bare, {"", ""});
  write("no.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n");
  const std::string good = wavePly();
  const int files = countFiles(folder);
  for (const auto& [input, out] :
       std::vector<std::pair<std::string, std::string>>{{"bare.ply", "a.ply"},
                                                        {"no.ply", "a.ply"},
                                                        {"missing.ply", "a.ply"},
                                                        {"bare.ply", "a.dcm"}})
    expectError<InputError>([&, from = at(input), to = out] { exported(from, to); }, {input});
  for (const char* out : {"a.xyz", "a.pvd"})
    expectError<OptionError>([&] { exported(good, out); }, {});
  const auto refused = [&](const std::string& out,
                           const std::function<void(ExportRequest&)>& change) {
    ExportRequest wrong = request(good, out);
    change(wrong);
    expectError<OptionError>([&] { exportModel(wrong); }, {});
  };
  refused("a.ply", [](ExportRequest& wrong) { wrong.unit = "inch"; });
  refused("a.ply", [](ExportRequest& wrong) { wrong.frame = 3; });
  refused("a.ply", [](ExportRequest& wrong) { wrong.surface.gap_mm = -1; });
  refused("a.ply", [](ExportRequest& wrong) { wrong.dicom.patient_id = "7"; });
  refused("a.glb", [](ExportRequest& wrong) { wrong.unit = "mm"; });
  refused("a.dcm", [](ExportRequest& wrong) { wrong.unit = "m"; });
  refused("a.dcm", [](ExportRequest& wrong) { wrong.points = true; });
  EXPECT_EQ(countFiles(folder), files);
}

bool hasTool(const char* name) {
  return std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// A page without content, with a cross-reference table that fits.
const char* const kPdf =
    "%PDF-1.4\n1 0 obj<</Type/Catalog/Pages 2 0 R>>endobj\n"
    "2 0 obj<</Type/Pages/Kids[3 0 R]/Count 1>>endobj\n"
    "3 0 obj<</Type/Page/Parent 2 0 R/MediaBox[0 0 9 9]>>endobj\n"
    "xref\n0 4\n0000000000 65535 f \n0000000009 00000 n \n0000000053 00000 n \n"
    "0000000102 00000 n \ntrailer<</Size 4/Root 1 0 R>>\nstartxref\n161\n%%EOF\n";

class ExportDicom : public ExportModel {
 protected:
  void SetUp() override {
    ExportModel::SetUp();
    for (const char* tool : {"pdf2dcm", "img2dcm", "stl2dcm", "xml2dsr", "dsrdump", "dcmdump"})
      if (!hasTool(tool))
        GTEST_SKIP() << tool << " isn't installed (Debian's package dcmtk): no DICOM file was made";
  }
  std::string outputOf(const std::string& line) const {
    EXPECT_EQ(std::system((line + " > '" + at("dump.txt") + "' 2>&1").c_str()), 0);
    return textOf(at("dump.txt"));
  }
  std::string reportOf(const std::vector<std::string>& cases, const std::string& name) const {
    ReportOptions options;
    options.cases = cases;
    options.html = at(name);
    writeReport(options);
    return at(name);
  }
  /// A report of one case that is 0.5 mm off.
  std::string reportPage() const {
    writeCase(at("result"), 0.5);
    return reportOf({at("result")}, "report.html");
  }
  /// The value of a tag as dcmdump prints it.
  std::string tag(const std::string& file, const std::string& number) const {
    return outputOf("dcmdump -q +P " + number + " '" + at(file) + "'");
  }
};

TEST_F(ExportDicom, AReportBecomesAnEncapsulatedPdfOfNobody) {
  const std::string pdf = write("report.pdf", kPdf);
  ExportRequest titled = request(pdf, "r.dcm");
  titled.dicom.title = "Made; $(up)";
  exportModel(titled);
  EXPECT_THAT(tag("r.dcm", "0008,0016"), HasSubstr("EncapsulatedPDFStorage"));
  EXPECT_THAT(tag("r.dcm", "0042,0010"), HasSubstr("[Made; $(up)]"));  // no shell has read it
  EXPECT_THAT(tag("r.dcm", "0010,0010"), HasSubstr("no value"));
  EXPECT_THAT(tag("r.dcm", "0010,0020"), HasSubstr("no value"));
  EXPECT_THAT(textOf(at("r.dcm")), HasSubstr("/MediaBox[0 0 9 9]"));
}

TEST_F(ExportDicom, APictureBecomesASecondaryCaptureAsItIs) {
  ColourImage picture(3, 2);
  picture.at(2, 1) = {1, 2, 3};
  writePng(at("p.png"), picture);
  ExportRequest named = request(at("p.png"), "p.dcm");
  named.dicom.patient_name = "Doe^Jö";
  named.dicom.patient_id = "7";
  exportModel(named);
  EXPECT_THAT(tag("p.dcm", "0008,0016"), HasSubstr("SecondaryCaptureImageStorage"));
  EXPECT_THAT(tag("p.dcm", "0010,0010"), HasSubstr("[Doe^Jö]"));
  EXPECT_THAT(tag("p.dcm", "0010,0020"), HasSubstr("[7]"));
  EXPECT_THAT(tag("p.dcm", "0028,0011"), HasSubstr("US 3"));
  // Row by row from the top, red first: the last of six pixels, then one byte to an even length.
  EXPECT_THAT(textOf(at("p.dcm")), testing::EndsWith(std::string("\0\0\0\1\2\3", 6)));
}

TEST_F(ExportDicom, WhatIsNoPdfIsRefused) {
  write("broken.pdf", "hello");
  expectError<InputError>([&] { exported(at("broken.pdf"), "b.dcm"); }, {"pdf2dcm refuses it"});
  EXPECT_FALSE(fs::exists(at("b.dcm")));
}

/// Numbers of a record that were measured, histograms and values per frame left out.
int numbersIn(const Json& part) {
  int count = 0;
  for (const auto& [key, value] : part.items()) {
    if (key == "schema_version" || key == "error_histogram") continue;
    count += value.is_object() ? numbersIn(value) : value.is_number() ? 1 : 0;
  }
  return count;
}

TEST_F(ExportDicom, EachNumberOfAReportHasItsUnitAndCodeInAStructuredReport) {
  const std::string page = reportPage();
  ExportRequest named = request(page, "s.dcm");
  named.dicom.patient_name = "Doe^Jö";
  named.dicom.title = "<made> & up";
  const Json told = exported(named);
  EXPECT_THAT(tag("s.dcm", "0008,0016"), HasSubstr("ComprehensiveSRStorage"));
  EXPECT_THAT(tag("s.dcm", "0040,db00"), HasSubstr("[1500]"));
  EXPECT_THAT(tag("s.dcm", "0010,0010"), HasSubstr("[Doe^Jö]"));
  EXPECT_THAT(tag("s.dcm", "0008,103e"), HasSubstr("[<made> & up]"));
  const std::string tree = outputOf("dsrdump +Pc '" + at("s.dcm") + "'");
  EXPECT_THAT(tree, HasSubstr("(surface.mean_mm,99SOFTSCOPE,\"surface, mean mm\")=\"0.5\" "
                              "(mm,UCUM,\"mm\")"));
  EXPECT_THAT(tree, HasSubstr("(373098007,SCT,\"Mean\")"));
  EXPECT_THAT(tree, HasSubstr("(surface.signed.n,99SOFTSCOPE"));
  EXPECT_THAT(tree, HasSubstr("(1,UCUM,\"no units\")"));
  int items = 0;
  for (auto at = tree.find("<contains NUM:"); at != tree.npos;
       at = tree.find("<contains NUM:", at + 1))
    ++items;
  const auto record = Json::parse(textOf(at("result/evaluation.json")));
  EXPECT_EQ(items, numbersIn(record));
  EXPECT_EQ(told.at("numbers"), items);
}

TEST_F(ExportDicom, TheStructuredReportOfACohortHasAGroupOfAllCases) {
  for (const char* name : {"a", "b", "c"}) writeCase(at(name), 0.5);
  exported(reportOf({at("a"), at("b"), at("c")}, "all.html"), "all.dcm");
  const std::string tree = outputOf("dsrdump +Pc '" + at("all.dcm") + "'");
  for (const char* part : {"=\"Case 1\"", "=\"Case 3\"", "=\"All cases\"",
                           "(mean_mm.sd,99SOFTSCOPE,\"mean mm, sd\")=\"0\" (mm,UCUM,\"mm\")",
                           "(mean_mm.n,99SOFTSCOPE,\"mean mm, n\")=\"3\" (1,UCUM"})
    EXPECT_THAT(tree, HasSubstr(part));
}

TEST_F(ExportDicom, AModelBecomesAnEncapsulatedStlInMillimetres) {
  ExportRequest titled = request(wavePly(), "m.dcm");
  titled.dicom.title = "wave";
  EXPECT_EQ(exported(titled).at("kind"), "Encapsulated STL");
  EXPECT_THAT(tag("m.dcm", "0008,0016"), HasSubstr("EncapsulatedSTLStorage"));
  EXPECT_THAT(tag("m.dcm", "0008,0100"), HasSubstr("[mm]"));
  EXPECT_THAT(tag("m.dcm", "0042,0010"), HasSubstr("[wave]"));
  exported(at("wave.ply"), "m.stl");
  EXPECT_THAT(textOf(at("m.dcm")), HasSubstr(textOf(at("m.stl"))));
  makeWallRun(at("run"), 2);
  ExportRequest of_frame = request(at("run"), "r.dcm");
  of_frame.frame = 1;
  exportModel(of_frame);
  EXPECT_THAT(tag("r.dcm", "0008,0016"), HasSubstr("EncapsulatedSTLStorage"));
}

TEST_F(ExportDicom, DciodvfyFindsNoErrors) {
  if (!hasTool("dciodvfy"))
    GTEST_SKIP() << "dciodvfy isn't installed (Debian's package dicom3tools): nothing was checked";
  writePng(at("p.png"), ColourImage(3, 2));
  for (const std::string& input :
       {write("report.pdf", kPdf), at("p.png"), reportPage(), wavePly()}) {
    ExportRequest again = request(input, "x.dcm");
    again.overwrite = true;
    exportModel(again);
    // It ends with 1 where it found an error.
    EXPECT_THAT(outputOf("dciodvfy '" + at("x.dcm") + "'"), testing::Not(HasSubstr("Error")))
        << input;
  }
}

TEST_F(ExportDicom, APageWithoutMetricsIsRefused) {
  for (const char* html :
       {"<html></html>", "<script type=\"application/json\" id=\"metrics\">{</script>"}) {
    expectError<InputError>([&] { exported(write("page.html", html), "b.dcm"); }, {"page.html: "});
    EXPECT_FALSE(fs::exists(at("b.dcm")));
  }
}

}  // namespace
}  // namespace softscope::test
