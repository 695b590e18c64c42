// tests/apps/test_doctor.cpp: the examination is complete and its words match its exit code.
#include <gmock/gmock.h>

#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

TEST(Doctor, TellsEverythingAsJson) {
  const Outcome outcome = run({"doctor", "--json"});
  const auto json = outcome.json();
  EXPECT_EQ(json["schema_version"], 1);
  for (const char* library : {"OpenCV", "VTK", "Eigen", "OpenMesh", "oneTBB", "vtk-dicom"})
    EXPECT_TRUE(json["libraries"].contains(library)) << library;
  EXPECT_GE(json["usable_cores"], 1);
  EXPECT_GT(json["memory_bytes"], 1 << 28);
  EXPECT_TRUE(json["cuda"].contains("devices"));
  EXPECT_EQ(outcome.exit_code, json["rendering"]["works"] ? 0 : 4);
  if (json["rendering"]["works"]) {
    EXPECT_GT(json["rendering"]["first_frame_ms"], 0);
  }
}

TEST(Doctor, EveryLineIsFineOrSaysWhatToDo) {
  std::istringstream lines(run({"doctor"}).out);
  std::string line;
  int fine = 0;
  while (std::getline(lines, line)) {
    if (line.rfind("warn  ", 0) == 0) {
      ASSERT_TRUE(std::getline(lines, line));
      EXPECT_THAT(line, testing::StartsWith("        -> "));
      EXPECT_GT(line.size(), 20u);
    } else {
      EXPECT_THAT(line, testing::StartsWith("ok    "));
      ++fine;
    }
  }
  EXPECT_GE(fine, 10);  // versions alone are more
}

class DoctorFonts : public InFolder {
 protected:
  /// Output of doctor if fontconfig knows only these fonts.
  nlohmann::json fontAmong(const std::string& kind) const {
    write("fonts.conf",
          "<?xml version=\"1.0\"?><!DOCTYPE fontconfig SYSTEM \"fonts.dtd\"><fontconfig>"
          "<dir>/usr/share/fonts/truetype/" +
              kind + "</dir><cachedir>" + at("cache") + "</cachedir></fontconfig>");
    setenv("FONTCONFIG_FILE", at("fonts.conf").c_str(), 1);
    const Outcome outcome = run({"doctor", "--json"});
    unsetenv("FONTCONFIG_FILE");
    return outcome.json()["font"];
  }
};

TEST_F(DoctorFonts, LiberationSansStandsInForArialAndDejaVuIsTheLastResort) {
  if (!std::filesystem::exists("/usr/share/fonts/truetype/liberation"))
    GTEST_SKIP() << "Debian's package fonts-liberation is missing";
  EXPECT_EQ(fontAmong("liberation")["family"], "Liberation Sans");
  if (!std::filesystem::exists("/usr/share/fonts/truetype/dejavu"))
    GTEST_SKIP() << "Debian's package fonts-dejavu-core is missing";
  EXPECT_EQ(fontAmong("dejavu")["family"], "DejaVu Sans");
}

TEST(Doctor, CountsTheThreadsThatMayWork) {
  EXPECT_EQ(run({"doctor", "--json", "--threads", "1"}).json()["threads"], 1);
}

TEST(Doctor, WithoutARendererTheExitCodeIsFour) {
  // An empty list of EGL vendors: the loader finds no driver at all.
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
  const Outcome outcome = run({"doctor", "--json"});
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_FALSE(outcome.json()["rendering"]["works"]);
  EXPECT_THAT(outcome.json()["rendering"]["problem"], testing::HasSubstr("Install libegl1"));
}

}  // namespace
}  // namespace softscope::test
