// tests/apps/test_export.cpp: `softscope export` as a user runs it.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "io/geometry/ply_writer.h"
#include "io/images/image_writer.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "tests/apps/made_case.h"
#include "tests/apps/made_run.h"
#include "tests/apps/run_softscope.h"
#include "toolkit/export/export_model.h"
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

class Export : public InFolder {
 protected:
  std::string wavePly(const std::string& name = "wave.ply",
                      const PlyComments& comments = {"", "RAS"}) const {
    writePly(at(name), wave(), comments, true);
    return at(name);
  }
};

TEST_F(Export, MakesASurfaceOfPointsWithTheirColours) {
  const Outcome outcome = run({"export", wavePly(), "--out", at("a.ply"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
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

TEST_F(Export, PointsStayPointsWhereAskedFor) {
  ASSERT_EQ(run({"export", wavePly(), "--out", at("a.ply"), "--points"}).exit_code, 0);
  const ModelFile file = readModel(at("a.ply"));
  EXPECT_EQ(file.model.positions_mm, wave().points_mm);
  EXPECT_EQ(file.model.normals, wave().normals);
  EXPECT_EQ(file.model.weights, wave().weights);
  EXPECT_THAT(run({"export", wavePly(), "--out", at("a.stl"), "--points"}).err,
              HasSubstr("--points takes .ply"));
}

TEST_F(Export, AMeshBecomesAnotherFormatAndUnit) {
  ASSERT_EQ(run({"export", wavePly(), "--out", at("a.ply")}).exit_code, 0);
  ASSERT_EQ(run({"export", at("a.ply"), "--out", at("m.obj"), "--unit", "m"}).exit_code, 0);
  ASSERT_EQ(run({"export", at("m.obj"), "--out", at("b.stl"), "--input-unit-mm", "1000"}).exit_code,
            0);
  const MeshCheck first = checkMesh(readMesh(at("a.ply"))), last = checkMesh(readMesh(at("b.stl")));
  EXPECT_EQ(last.triangle_count, first.triangle_count);
  EXPECT_NEAR(last.area_mm2, first.area_mm2, 1e-3);
  EXPECT_EQ(readMesh(at("b.stl")).space, "RAS");
}

TEST_F(Export, TakesRunsTheirFramesAndTheirSeries) {
  makeWallRun(at("run"), 4);  // its walls are too coarse for a surface, not for points
  ASSERT_EQ(run({"export", at("run"), "--out", at("a.ply"), "--points"}).exit_code, 0);
  ASSERT_EQ(run({"export", at("run"), "--frame", "2", "--out", at("b.ply"), "--points"}).exit_code,
            0);
  EXPECT_EQ(readModel(at("b.ply")).model.positions_mm, wallModel(2).points_mm);
  const Outcome series =
      run({"export", at("run"), "--out", at("all.pvd"), "--points", "--every", "2", "--json"});
  ASSERT_EQ(series.exit_code, 0) << series.err;
  EXPECT_EQ(series.json().at("models"), 2);
  EXPECT_EQ(series.json().at("frames").at(1).at("frame"), 2);
  EXPECT_TRUE(fs::exists(at("all/000000.vtp")));
  EXPECT_TRUE(fs::exists(at("all/000002.vtp")));
  EXPECT_FALSE(fs::exists(at("all/000001.vtp")));
  const std::string list = textOf(at("all.pvd"));
  EXPECT_THAT(list, HasSubstr("file=\"all/000002.vtp\""));
  EXPECT_THAT(run({"export", at("run"), "--frame", "9", "--out", at("c.ply")}).err,
              HasSubstr("saved are the frames 0, 1, 2, 3"));
}

TEST_F(Export, ASeriesThatIsStoppedLeavesNothing) {
  makeWallRun(at("run"), 4);
  ExportRequest request;
  request.input = at("run");
  request.out = at("all.pvd");
  request.points = true;
  std::vector<int> told;
  const auto stopAfterTwo = [&](int done, int total) {
    EXPECT_EQ(total, 4);
    told.push_back(done);
    return done < 2;
  };
  EXPECT_TRUE(exportModel(request, stopAfterTwo).interrupted);
  EXPECT_EQ(told, (std::vector<int>{0, 1, 2}));
  EXPECT_FALSE(fs::exists(at("all.pvd")));
  EXPECT_FALSE(fs::exists(at("all")));
  EXPECT_FALSE(exportModel(request).interrupted);
  EXPECT_TRUE(fs::exists(at("all/000003.vtp")));
}

TEST_F(Export, OverwritesNothingUnlessAskedTo) {
  write("a.ply", "mine");
  const Outcome refused = run({"export", wavePly(), "--out", at("a.ply")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(textOf(at("a.ply")), "mine");
  EXPECT_EQ(run({"export", wavePly(), "--out", at("a.ply"), "--force"}).exit_code, 0);
}

TEST_F(Export, RefusesInOneLineAndLeavesNothing) {
  PointCloud bare = wave();
  bare.normals.clear();
  writePly(at("bare.ply"), bare, {"", ""});
  write("no.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n");
  const std::string good = wavePly();
  const int files = countFiles(folder);
  const std::vector<std::pair<std::vector<std::string>, int>> lines{
      {{"bare.ply", "a.ply"}, 3}, {{"no.ply", "a.ply"}, 3},   {{"missing.ply", "a.ply"}, 3},
      {{"wave.ply", "a.xyz"}, 2}, {{"bare.ply", "a.dcm"}, 3}, {{"wave.ply", "a.pvd"}, 2}};
  for (const auto& [names, code] : lines) {
    const Outcome outcome = run({"export", at(names[0]), "--out", at(names[1])});
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--unit", "inch"}, {"--frame", "3"}, {"--gap-mm", "-1"}, {"--patient-id", "7"}}) {
    std::vector<std::string> words{"export", good, "--out", at("a.ply")};
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(run(words).exit_code, 2) << wrong[0];
  }
  EXPECT_EQ(run({"export", good, "--out", at("a.glb"), "--unit", "mm"}).exit_code, 2);
  EXPECT_EQ(run({"export", good, "--out", at("a.dcm"), "--unit", "m"}).exit_code, 2);
  EXPECT_EQ(run({"export", good, "--out", at("a.dcm"), "--points"}).exit_code, 2);
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

class ExportDicom : public Export {
 protected:
  void SetUp() override {
    Export::SetUp();
    for (const char* tool : {"pdf2dcm", "img2dcm", "stl2dcm", "xml2dsr", "dsrdump", "dcmdump"})
      if (!hasTool(tool))
        GTEST_SKIP() << tool << " isn't installed (Debian's package dcmtk): no DICOM file was made";
  }
  std::string outputOf(const std::string& line) const {
    EXPECT_EQ(std::system((line + " > '" + at("dump.txt") + "' 2>&1").c_str()), 0);
    return textOf(at("dump.txt"));
  }
  /// A report of one case that is 0.5 mm off.
  std::string reportPage() const {
    writeCase(at("result"), 0.5);
    EXPECT_EQ(run({"report", at("result"), "--out", at("report.html")}).exit_code, 0);
    return at("report.html");
  }
  /// The value of a tag as dcmdump prints it.
  std::string tag(const std::string& file, const std::string& number) const {
    return outputOf("dcmdump -q +P " + number + " '" + at(file) + "'");
  }
};

TEST_F(ExportDicom, AReportBecomesAnEncapsulatedPdfOfNobody) {
  const std::string pdf = write("report.pdf", kPdf);
  const Outcome outcome = run({"export", pdf, "--out", at("r.dcm"), "--title", "Made; $(up)"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
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
  ASSERT_EQ(run({"export", at("p.png"), "--out", at("p.dcm"), "--patient-name", "Doe^Jö",
                 "--patient-id", "7"})
                .exit_code,
            0);
  EXPECT_THAT(tag("p.dcm", "0008,0016"), HasSubstr("SecondaryCaptureImageStorage"));
  EXPECT_THAT(tag("p.dcm", "0010,0010"), HasSubstr("[Doe^Jö]"));
  EXPECT_THAT(tag("p.dcm", "0010,0020"), HasSubstr("[7]"));
  EXPECT_THAT(tag("p.dcm", "0028,0011"), HasSubstr("US 3"));
  // Row by row from the top, red first: the last of six pixels, then one byte to an even length.
  EXPECT_THAT(textOf(at("p.dcm")), testing::EndsWith(std::string("\0\0\0\1\2\3", 6)));
}

TEST_F(ExportDicom, WhatIsNoPdfIsRefused) {
  write("broken.pdf", "hello");
  const Outcome outcome = run({"export", at("broken.pdf"), "--out", at("b.dcm")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("pdf2dcm refuses it"));
  EXPECT_FALSE(fs::exists(at("b.dcm")));
}

/// Numbers of a record that were measured, histograms and values per frame left out.
int numbersIn(const nlohmann::json& part) {
  int count = 0;
  for (const auto& [key, value] : part.items()) {
    if (key == "schema_version" || key == "error_histogram") continue;
    count += value.is_object() ? numbersIn(value) : value.is_number() ? 1 : 0;
  }
  return count;
}

TEST_F(ExportDicom, EachNumberOfAReportHasItsUnitAndCodeInAStructuredReport) {
  const std::string page = reportPage();
  const Outcome outcome = run({"export", page, "--out", at("s.dcm"), "--json", "--patient-name",
                               "Doe^Jö", "--title", "<made> & up"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
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
  const auto record = nlohmann::json::parse(textOf(at("result/evaluation.json")));
  EXPECT_EQ(items, numbersIn(record));
  EXPECT_EQ(outcome.json().at("numbers"), items);
}

TEST_F(ExportDicom, TheStructuredReportOfACohortHasAGroupOfAllCases) {
  for (const char* name : {"a", "b", "c"}) writeCase(at(name), 0.5);
  ASSERT_EQ(run({"report", at("a"), at("b"), at("c"), "--out", at("all.html")}).exit_code, 0);
  ASSERT_EQ(run({"export", at("all.html"), "--out", at("all.dcm")}).exit_code, 0);
  const std::string tree = outputOf("dsrdump +Pc '" + at("all.dcm") + "'");
  for (const char* part : {"=\"Case 1\"", "=\"Case 3\"", "=\"All cases\"",
                           "(mean_mm.sd,99SOFTSCOPE,\"mean mm, sd\")=\"0\" (mm,UCUM,\"mm\")",
                           "(mean_mm.n,99SOFTSCOPE,\"mean mm, n\")=\"3\" (1,UCUM"})
    EXPECT_THAT(tree, HasSubstr(part));
}

TEST_F(ExportDicom, AModelBecomesAnEncapsulatedStlInMillimetres) {
  const Outcome outcome =
      run({"export", wavePly(), "--out", at("m.dcm"), "--title", "wave", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("kind"), "Encapsulated STL");
  EXPECT_THAT(tag("m.dcm", "0008,0016"), HasSubstr("EncapsulatedSTLStorage"));
  EXPECT_THAT(tag("m.dcm", "0008,0100"), HasSubstr("[mm]"));
  EXPECT_THAT(tag("m.dcm", "0042,0010"), HasSubstr("[wave]"));
  ASSERT_EQ(run({"export", at("wave.ply"), "--out", at("m.stl")}).exit_code, 0);
  EXPECT_THAT(textOf(at("m.dcm")), HasSubstr(textOf(at("m.stl"))));
  makeWallRun(at("run"), 2);
  ASSERT_EQ(run({"export", at("run"), "--frame", "1", "--out", at("r.dcm")}).exit_code, 0);
  EXPECT_THAT(tag("r.dcm", "0008,0016"), HasSubstr("EncapsulatedSTLStorage"));
}

TEST_F(ExportDicom, DciodvfyFindsNoErrors) {
  if (!hasTool("dciodvfy"))
    GTEST_SKIP() << "dciodvfy isn't installed (Debian's package dicom3tools): nothing was checked";
  writePng(at("p.png"), ColourImage(3, 2));
  for (const std::string& input :
       {write("report.pdf", kPdf), at("p.png"), reportPage(), wavePly()}) {
    ASSERT_EQ(run({"export", input, "--out", at("x.dcm"), "--force"}).exit_code, 0) << input;
    // It ends with 1 where it found an error.
    EXPECT_THAT(outputOf("dciodvfy '" + at("x.dcm") + "'"), testing::Not(HasSubstr("Error")))
        << input;
  }
}

TEST_F(ExportDicom, APageWithoutMetricsIsRefused) {
  for (const char* html :
       {"<html></html>", "<script type=\"application/json\" id=\"metrics\">{</script>"}) {
    const Outcome outcome = run({"export", write("page.html", html), "--out", at("b.dcm")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("page.html: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(at("b.dcm")));
  }
}

TEST_F(Export, WithoutDcmtkSaysWhatToInstall) {
  write("report.pdf", kPdf);
  const std::string line = "PATH=/nonexistent '" + executable() + "' export '" + at("report.pdf") +
                           "' --out '" + at("r.dcm") + "' 2> '" + at("err.txt") + "'";
  EXPECT_EQ(std::system(line.c_str()) / 256, 4);
  EXPECT_THAT(textOf(at("err.txt")), HasSubstr("apt install dcmtk"));
}

}  // namespace
}  // namespace softscope::test
