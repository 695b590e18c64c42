// tests/apps/test_bad_inputs.cpp: damaged inputs and unlucky places end in one line and exit code 3
// or 2, and never in a plausible result.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>

#include "io/images/image_writer.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class BadInputs : public InFolder {
 protected:
  /// Exit code and one line that begins with `error: `.
  void expectOneError(const std::vector<std::string>& arguments, int exit_code,
                      const std::string& says) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_THAT(outcome.err, testing::StartsWith("error: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  std::string volume(const std::string& name, const std::string& spacing) const {
    return write(
        name,
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n" +
            spacing + "DimSize = 20 24 12\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
            std::string(11520, '\1'));
  }
};

TEST_F(BadInputs, AVolumeWithoutSpacingIsReadOnlyWithAStatedOne) {
  const std::string ct = volume("ct.mha", "");
  expectOneError({"info", ct}, 3, "--spacing X,Y,Z");
  expectOneError({"slice", ct, "--out", at("s.png")}, 3, "--spacing X,Y,Z");
  expectOneError({"figure", "--ct", ct, "--out", at("f.png")}, 3, "--spacing X,Y,Z");
  const Outcome stated = run({"info", ct, "--spacing", "2,2,3", "--json"});
  EXPECT_EQ(stated.exit_code, 0) << stated.err;
  EXPECT_DOUBLE_EQ(stated.json()["spacing_mm"][2], 3);
  EXPECT_EQ(run({"slice", ct, "--spacing", "2,2,3", "--out", at("s.png")}).exit_code, 0);
  for (const char* wrong : {"2,2", "2,2,0", "2,2,-3", "a,b,c", "2,2,nan"})
    expectOneError({"info", ct, "--spacing", wrong}, 2, "--spacing");
}

TEST_F(BadInputs, SidesOfAnUnknownSpaceAreNotCalledLeftAndRight) {
  const std::string ct = write("ct.nrrd",
                               "NRRD0004\ntype: short\ndimension: 3\nsizes: 20 24 12\n"
                               "spacings: 2 2 3\nendian: little\nencoding: raw\n\n" +
                                   std::string(11520, '\1'));
  for (const char* command : {"slice", "figure"}) {
    const std::string svg = at(std::string(command) + ".svg");
    std::vector<std::string> words{command, "--out", svg};
    if (command == std::string("figure")) words.emplace_back("--ct");
    words.push_back(ct);
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("left and right are unknown"));
    const auto record = nlohmann::json::parse(textOf(at(std::string(command) + ".json")));
    EXPECT_THAT(record["views"].dump(), testing::AllOf(HasSubstr("+x"), Not(HasSubstr("\"L\""))));
  }
}

TEST_F(BadInputs, NamesCommandNoTerminal) {
  const std::string name = "a\x1b]0;x\x07\nb";
  expectOneError({"info", at(name + ".ply")}, 3, "a?]0;x??b.ply");
  expectOneError({"info", at("a"), "--" + name}, 2, "?]0;x");
  expectOneError({"evaluate", at(name), "--reference", at(name)}, 3, "a?]0;x??b");
  expectOneError({"compare", "--reference", at(name + ".stl"), "--test", at("a.stl")}, 3, "a?]0;x");
  writePng(at(name + ".png"), ColourImage(16, 16, Rgb8{10, 20, 30}), true);
  const Outcome told = run({"info", at(name + ".png")});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out + told.err, Not(HasSubstr("\x1b")));
  EXPECT_THAT(told.out, testing::StartsWith(at("a?]0;x??b.png")));
}

TEST_F(BadInputs, APipeIsRefusedAtOnce) {
  ASSERT_EQ(mkfifo(at("p.nii").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(at("p.vtp").c_str(), 0600), 0);
  expectOneError({"info", at("p.nii")}, 3, "p.nii");
  expectOneError({"export", at("p.vtp"), "--out", at("o.obj")}, 3, "p.vtp");
}

TEST_F(BadInputs, AFileThatBreaksItsLibraryIsAnErrorThatNamesIt) {
  const std::string cut =
      write("cut.vtk",
            "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
            "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1\n");
  expectOneError({"export", cut, "--out", at("o.obj")}, 3, "cut.vtk");
}

TEST_F(BadInputs, ALibraryPrintsNothingBesideOurError) {
  // A PNG whose parts have right check sums, but whose colours come from a palette that isn't
  // there.
  writePng(at("p.png"), ColourImage(16, 16, Rgb8{10, 20, 30}), true);
  EXPECT_EQ(run({"info", at("p.png"), "--quiet"}).err, "");
  std::string bytes = textOf(at("p.png"));
  const auto header = bytes.find("IHDR");
  bytes[header + 13] = 3;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + header, 17);
  for (int i = 0; i < 4; ++i) bytes[header + 17 + std::size_t(i)] = char(sum >> (24 - 8 * i));
  write("bad.png", bytes);
  expectOneError({"info", at("bad.png")}, 3, "bad.png");
}

TEST_F(BadInputs, AKeyOfThousandsOfPartsIsNoSettingsFile) {
  std::string key;
  for (int i = 0; i < 20000; ++i) key += "a.";
  const std::string sequence = makeSequence("s", 1);
  const std::string settings = write("deep.toml", "# a comment\n" + key + "b = 1\n");
  expectOneError({"depth", sequence, "--config", settings, "--out", at("d")}, 3, "deep.toml:2");
  const std::string brackets = write("list.toml", "x = " + std::string(5000, '['));
  expectOneError({"info", brackets}, 3, "list.toml:1");
}

TEST_F(BadInputs, AFullDiskBehindStdoutIsAnError) {
  const std::string sequence = makeSequence("s", 1);
  const std::string line = executable() + " info " + sequence + " > /dev/full 2> " + at("err");
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(textOf(at("err")), HasSubstr("can't be written"));
}

TEST_F(BadInputs, StdoutOnAFullDiskIsAnErrorOfEveryCommand) {
  const std::string sequence = makeSequence("s", 2);
  write("flat.obj", "v 0 0 50\nv 9 0 50\nv 0 9 50\nf 1 2 3\n");
  const std::string run_folder = at("r"), flat = at("flat.obj");
  ASSERT_EQ(run({"reconstruct", sequence, "--out", run_folder}).exit_code, 0);
  for (const std::string& words :
       std::vector<std::string>{"doctor", "--help", "--version", ("info " + sequence + " --json"),
                                ("depth " + sequence + " --out " + at("d")),
                                ("reconstruct " + sequence + " --out " + at("r2")),
                                ("simulate --frames 1 --size 96x80 --out " + at("c")),
                                ("evaluate " + run_folder + " --reference " + flat),
                                ("compare --reference " + flat + " --test " + flat),
                                ("export " + flat + " --out " + at("o.stl")),
                                ("slice --surface " + flat + " --json --out " + at("s.svg")),
                                ("figure --reference " + flat + " --json --out " + at("f.svg"))}) {
    const std::string line = executable() + " " + words + " --quiet > /dev/full 2> " + at("err");
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3) << words;
    EXPECT_THAT(textOf(at("err")), HasSubstr("can't be written")) << words;
  }
}

TEST_F(BadInputs, ALimitOfFileSizesIsAnErrorOfTheFile) {
  const std::string sequence = makeSequence("s", 3);
  const std::string line = executable() + " reconstruct " + sequence + " --out " + at("r") +
                           " --save-every 1 --quiet > /dev/null 2> " + at("err");
  const int status = std::system(("ulimit -f 64; exec " + line).c_str());
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(textOf(at("err")), HasSubstr(at("r/models/000000.")));
  EXPECT_THAT(textOf(at("err")), HasSubstr("ulimit -f"));
  EXPECT_TRUE(fs::exists(at("r/nodes/000000.csv"))) << "what was written stays";
}

TEST_F(BadInputs, ClosedStreamsReachNoFile) {
  const std::string sequence = makeSequence("s", 2), same = " --threads 1 --out ";
  const std::string line = executable() + " reconstruct " + sequence + same;
  ASSERT_EQ(std::system((line + at("open") + " > /dev/null 2>&1").c_str()), 0);
  ASSERT_EQ(std::system((line + at("shut") + " <&- >&- 2>&-").c_str()), 0);
  for (const char* name : {"model.ply", "trajectory.txt", "models.pvd"})
    EXPECT_EQ(textOf(at("shut/" + std::string(name))), textOf(at("open/" + std::string(name))));
  EXPECT_EQ(std::system((line + at("pipe") + " 2>&1 > /dev/null | true").c_str()), 0);
  EXPECT_TRUE(nlohmann::json::accept(textOf(at("pipe/run.json"))));
}

TEST_F(BadInputs, AFigureThatFailsLeavesNoneOfItsFiles) {
  write("flat.obj", "v 0 0 50\nv 9 0 50\nv 0 9 50\nf 1 2 3\n");
  write("occupied", "a file");
  expectOneError({"slice", "--surface", at("flat.obj"), "--out", at("new/a.svg"), "--out",
                  at("occupied/b.svg"), "--quiet"},
                 3, "occupied");
  EXPECT_FALSE(fs::exists(at("new"))) << "the first file and its folder are taken back";
}

TEST_F(BadInputs, ResultsAmongTheInputsAreRefused) {
  const std::string sequence = makeSequence("s", 2);
  fs::create_directory_symlink(sequence + "/left", at("link"));
  for (const std::string& out :
       {sequence + "/left", sequence + "/right/sub", at("link"), sequence + "/./left/"})
    expectOneError({"depth", sequence, "--out", out}, 2, "folder of the sequence");
  expectOneError({"reconstruct", sequence, "--out", sequence, "--force"}, 2,
                 "folder of the sequence");
  expectOneError({"reconstruct", sequence, "--out", sequence + "/left", "--force"}, 2,
                 "folder of the sequence");
  EXPECT_EQ(countFiles(sequence + "/left"), 2);
  EXPECT_EQ(run({"depth", sequence, "--out", sequence + "/results"}).exit_code, 0);
}

TEST_F(BadInputs, DepthOfNothingIsAnError) {
  const std::string sequence = makeSequence("s", 1);
  for (const char* view : {"left", "right"})
    writePng(sequence + "/" + view + "/000000.png", ColourImage(160, 120, Rgb8{0, 0, 0}), true);
  const Outcome outcome = run({"depth", sequence, "--out", at("d")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no pixel could be measured"));
}

TEST_F(BadInputs, TimesThatAreNoSecondsAreToldAtTheStart) {
  const std::string sequence = makeSequence("s", 2);
  for (const auto& [times, unit] : std::initializer_list<std::pair<const char*, const char*>>{
           {"1700000000000\n1700000000040\n", "milliseconds"},
           {"1700000000000000000\n1700000000040000000\n", "nanoseconds"}}) {
    write("s/timestamps.txt", times);
    expectOneError({"reconstruct", sequence, "--out", at("r")}, 3, unit);
    EXPECT_FALSE(fs::exists(at("r")));
  }
  write("s/timestamps.txt", "0\n40\n");
  EXPECT_THAT(run({"info", sequence}).out, HasSubstr("milliseconds"));
}

}  // namespace
}  // namespace softscope::test
