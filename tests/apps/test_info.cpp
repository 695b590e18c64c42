// tests/apps/test_info.cpp: `softscope info` and `calibration-template`: lines and exit codes.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "support/data_folder.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Info : public InFolder {};

TEST_F(Info, LinesAndJsonTellTheSame) {
  const std::string sequence = makeSequence("s", 2);
  const Outcome lines = run({"info", sequence}), json = run({"info", sequence, "--json"});
  EXPECT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_THAT(lines.out, HasSubstr("160 x 120"));
  EXPECT_EQ(json.json()["width_px"], 160);
}

TEST_F(Info, ProblemsSetTheExitCode) {
  const std::string sequence = makeSequence("s", 3);
  fs::resize_file(sequence + "/left/000002.png", 200);
  EXPECT_EQ(run({"info", sequence}).exit_code, 0) << "the first frame is sound";
  const Outcome checked = run({"info", sequence, "--check", "--json"});
  EXPECT_EQ(checked.exit_code, 3);
  EXPECT_EQ(checked.json()["unreadable_frames"], 1);
}

TEST_F(Info, AMeshInMetresGetsTheOptionsThatStateIt) {
  const std::string mesh = write("m.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n");
  EXPECT_THAT(run({"info", mesh}).out, HasSubstr("in metres? Then give 1000 as --reference-unit-mm "
                                                 "or --test-unit-mm (compare)"));
  const Outcome compared = run({"compare", "--reference", mesh, "--test", mesh});
  EXPECT_THAT(compared.out + compared.err, HasSubstr("give 1000 as --test-unit-mm"));
}

TEST_F(Info, TemplatesOfCalibrationsAreWritten) {
  const std::string file = at("stereo.yaml");
  const Outcome template_of = run({"calibration-template", "stereo", "--out", file});
  EXPECT_EQ(template_of.exit_code, 0) << template_of.err;
  EXPECT_THAT(template_of.err, HasSubstr("written: " + file));
  EXPECT_EQ(run({"info", file}).exit_code, 0);
  EXPECT_EQ(run({"calibration-template", "stereo"}).out, textOf(file)) << "comments and all";
  const auto json = run({"calibration-template", "stereo", "--json"}).json();
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["template"], textOf(file));
  const Outcome wrong = run({"calibration-template", "rectifed"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean `rectified`?"));
}

TEST_F(Info, UnknownThingsAreInputErrorsThatSayWhatIsAccepted) {
  const std::string strange = write("x.docx", "letter");
  for (const std::string& path : {strange, at("absent")}) {
    const Outcome outcome = run({"info", path});
    EXPECT_EQ(outcome.exit_code, 3) << path;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(path));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_THAT(run({"info", strange}).err, HasSubstr("nii.gz"));
}

TEST_F(Info, LibrariesAddNothingToOurError) {
  // Data of an MP4 without its table: "moov atom not found" in FFmpeg.
  const char bytes[] =
      "\0\0\0\x18"
      "ftypmp42\0\0\0\0mp42isom\0\0\0\x10"
      "mdat12345678";
  const std::string video = write("v.mp4", {bytes, sizeof bytes - 1});
  const Outcome outcome = run({"info", video});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::StartsWith("error: " + video));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(Info, PatientFieldsComeOnlyWhenAsked) {
  SOFTSCOPE_DATA_OR_SKIP(data, "ct");
  EXPECT_TRUE(
      run({"info", data / "chaos_dicom", "--json", "--patient"}).json().contains("patient"));
}

}  // namespace
}  // namespace softscope::test
