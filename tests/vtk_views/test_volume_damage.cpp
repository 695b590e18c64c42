// tests/vtk_views/test_volume_damage.cpp: missing geometry is never invented, and damaged voxels
// are never drawn.
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/support/data_folder.h"
#include "tests/vtk_views/damaged_volume.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(DamagedVolume, WithoutSpacingAsksForItAndTakesWhatIsStated) {
  const std::string no_spacing = replaced(mha, "ElementSpacing = 2 2 3\n", "");
  const std::string no_directions =
      replaced(nrrd, "space directions: (2,0,0) (0,2,0) (0,0,3)\n", "");
  for (const std::string& file :
       {write("a.mha", no_spacing + voxels), write("a.nrrd", no_directions + voxels),
        write("zero.mha", replaced(mha, "= 2 2 3", "= 0 2 3") + voxels),
        write("minus.mha", replaced(mha, "= 2 2 3", "= 2 -2 3") + voxels),
        write("nan.mha", replaced(mha, "= 2 2 3", "= 2 nan 3") + voxels)}) {
    EXPECT_THAT(errorOf(file), HasSubstr("`spacing=` X,Y,Z"));
    const Volume volume = readVolume(file, stated);
    EXPECT_EQ(volume.facts.spacing_mm, (std::array<double, 3>{2, 2, 3})) << file;
  }
  const Volume other =
      readVolume(write("b.mha", replaced(mha, "= 2 2 3", "= 1 1 1") + voxels), stated);
  EXPECT_EQ(other.facts.spacing_mm, (std::array<double, 3>{2, 2, 3}));
  ASSERT_FALSE(other.facts.warnings.empty()) << "the file says otherwise";
  EXPECT_THAT(other.facts.warnings[0], HasSubstr("1 x 1 x 1 mm"));
}

TEST_F(DamagedVolume, WithoutAPatientSpaceHasNoLeftAndRight) {
  const std::string no_space = replaced(nrrd, "space: left-posterior-superior\n", "");
  const std::string no_directions =
      replaced(nrrd, "space directions: (2,0,0) (0,2,0) (0,0,3)\n", "spacings: 2 2 3\n");
  for (const std::string& file :
       {write("s.nrrd", no_space + voxels), write("d.nrrd", no_directions + voxels)}) {
    const Volume volume = readVolume(file);
    EXPECT_EQ(volume.facts.file_space, "unknown");
    EXPECT_EQ(volume.facts.axes, "unknown");
    ASSERT_FALSE(volume.facts.warnings.empty());
    EXPECT_THAT(volume.facts.warnings[0], HasSubstr("left and right are unknown"));
    EXPECT_EQ(volume.facts.spacing_mm, (std::array<double, 3>{2, 2, 3}));
  }
}

TEST_F(DamagedVolume, LengthsInMetresAreConvertedAndUnknownUnitsAreErrors) {
  const std::string metres =
      replaced(replaced(nrrd, "(2,0,0) (0,2,0) (0,0,3)", "(0.002,0,0) (0,0.002,0) (0,0,0.003)"),
               "endian", "space units: \"m\" \"m\" \"m\"\nendian");
  const Volume volume = readVolume(write("m.nrrd", metres + voxels));
  EXPECT_NEAR(volume.facts.spacing_mm[2], 3, 1e-12);
  EXPECT_NEAR(volume.facts.lps_from_voxel(0, 3), -20000, 1e-9) << "the origin is in metres too";
  EXPECT_THAT(errorOf("inch.nrrd", replaced(metres, "\"m\" \"m\"", "\"inch\" \"m\"") + voxels),
              HasSubstr("space units"));
}

TEST_F(DamagedVolume, WithAbsurdGeometryNamesTheField) {
  const auto directions = [&](const std::string& value) {
    return replaced(nrrd, "(2,0,0) (0,2,0) (0,0,3)", value) + voxels;
  };
  for (const char* value : {"(nan,0,0) (0,2,0) (0,0,3)", "(2,0,0) (0,2,0) (0,0,3",
                            "(2,0,0) (0,2,0)", "(0,0,0) (0,2,0) (0,0,3)", "(2,0,0) (2,0,0) (0,0,3)",
                            "(2,0,0) (0,0x2,0) (0,0,3)", "(2,0,0) (0,2e9,0) (0,0,3)", "", "x"})
    EXPECT_THAT(errorOf("d.nrrd", directions(value)), HasSubstr("space directions")) << value;
  EXPECT_THAT(errorOf("o.nrrd", replaced(nrrd, "(-20,-24", "(inf,-24") + voxels),
              HasSubstr("space origin"));
  for (const char* value : {"1 0 0 0 1 0 0 0 nan", "1 0 0 0 1 0 0 0", "1 0 0 1 0 0 0 0 1",
                            "9 0 0 0 9 0 0 0 9", "a b c"})
    EXPECT_THAT(errorOf("t.mha", replaced(mha, "1 0 0 0 1 0 0 0 1", value) + voxels),
                HasSubstr("TransformMatrix"))
        << value;
  EXPECT_THAT(
      errorOf("s.mha",
              replaced(mha, "ElementSpacing = 2 2 3", "ElementSpacing = 2 0x10 3") + voxels),
      HasSubstr("ElementSpacing"));
  EXPECT_THAT(errorOf("o.mha", replaced(mha, "Offset = 0 0 0", "Offset = 0 0 inf") + voxels),
              HasSubstr("Offset"));
}

TEST_F(DamagedVolume, WithAMisspeltKeyNamesItAndWhatIsExpected) {
  for (const auto& [key, wrong] : std::initializer_list<std::pair<const char*, const char*>>{
           {"ElementSpacing", "ElementSpacng"},
           {"ElementSpacing", "elementspacing"},
           {"ElementSpacing", "Element Spacing"},
           {"TransformMatrix", "TransfromMatrix"},
           {"Offset", "Ofset"},
           {"Offset", "OFFSET"},
           {"BinaryDataByteOrderMSB", "BinaryDataByteOrderMBS"},
           {"CompressedData", "CompresedData"}}) {
    const std::string error = errorOf("k.mha", replaced(mha, key, wrong) + voxels);
    EXPECT_THAT(error, testing::AllOf(HasSubstr("k.mha"), HasSubstr(std::string("`") + wrong + "`"),
                                      HasSubstr(std::string("`") + key + "` is expected")));
  }
  for (const auto& [key, wrong] : std::initializer_list<std::pair<const char*, const char*>>{
           {"space directions", "space directons"},
           {"space origin", "space orgin"},
           {"space:", "spaces:"},
           {"kinds", "sorts"}}) {
    const std::string error = errorOf("k.nrrd", replaced(nrrd, key, wrong) + voxels);
    const std::string name = std::string(wrong).substr(0, std::string(wrong).find(':'));
    EXPECT_THAT(error, testing::AllOf(HasSubstr("k.nrrd"), HasSubstr("`" + name + "`")));
  }
  EXPECT_THAT(errorOf("n.nrrd", replaced(nrrd, "space origin:", "space origin:=") + voxels),
              HasSubstr("`space origin:` is expected"));
}

TEST_F(DamagedVolume, WithNotesOfOtherProgramsIsRead) {
  const std::string noted = replaced(mha, "NDims", "Comment = made\n0008|0060 = CT\nNDims");
  EXPECT_TRUE(readVolume(write("n.mha", noted + voxels)).facts.warnings.empty());
  const Volume other =
      readVolume(write("o.mha", replaced(mha, "NDims", "Institution = X\nNDims") + voxels));
  ASSERT_EQ(other.facts.warnings.size(), 1U);
  EXPECT_THAT(other.facts.warnings[0], HasSubstr("Institution"));
  const std::string noted_nrrd =
      replaced(replaced(nrrd, "sizes", "modality:=CT\nsizes"), "space origin", "Space Origin");
  EXPECT_EQ(readVolume(write("n.nrrd", noted_nrrd + voxels)).facts.lps_from_voxel,
            readVolume(write("p.nrrd", nrrd + voxels)).facts.lps_from_voxel);
}

TEST_F(DamagedVolume, WithADamagedHeaderIsAnErrorAndNeverACrash) {
  for (const auto& [what, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"NDims = 3", "NDims = -1"},
           {"NDims = 3", "NDims = 2"},
           {"= 20 24 12", "= -20 24 12"},
           {"= 20 24 12", "= 0 24 12"},
           {"= 20 24 12", "= 1099511627776 1 1"},
           {"= 20 24 12", "= 21 24 12"},
           {"= 20 24 12", "= 19 24 12"},
           {"MET_SHORT", "MET_OTHER"},
           {"MET_SHORT", "MET_CHAR"},
           {"= LOCAL", "= LIST"},
           {"= LOCAL", "= a%03d.raw 1 12 1"},
           {"= LOCAL", "= %s%s%s%s%n 1 2 1"},
           {"= LOCAL", "= nowhere.raw"},
           {"= LOCAL\n", "= "},
           {"CompressedData = False", "CompressedData = Maybe"},
           {"BinaryData = True", "BinaryData = False"},
           {"Offset = 0 0 0\n", "Offset = 0 0 0\nOffset = 1 0 0\n"},
           {"ObjectType = Image", "ObjectType = Mesh"}})
    errorOf("h.mha", replaced(mha, what, with) + voxels);
  for (const auto& [what, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {"domain domain domain", "domain dom\nain domain"},
           {"sizes: 20", "sizes: -20"},
           {"sizes: 20", "sizes: 0"},
           {"sizes: 20 24 12", "sizes: 2147483648 1 1"},
           {"dimension: 3", "dimension: 2"},
           {"dimension: 3", "dimension: 99999999999"},
           {"type: short", "type: block"},
           {"encoding: raw", "encoding: hex"},
           {"endian: little\n", ""},
           {"endian: little", "endian: middle"},
           {"encoding: raw", "data file: LIST\nencoding: raw"},
           {"encoding: raw", "data file: a%03d.raw 1 12 1\nencoding: raw"},
           {"encoding: raw", "byte skip: -7\nencoding: raw"}})
    errorOf("h.nrrd", replaced(nrrd, what, with) + voxels);
  // The content of `kinds` moves no voxel; a reader of another library did not terminate there.
  EXPECT_EQ(readVolume(write("k.nrrd", replaced(nrrd, "kinds: domain", "kinds: d#omain") + voxels))
                .values.size(),
            std::size_t{20 * 24 * 12});
  const std::string nul = std::string("kinds: d") + '\0' + "omain domain domain";
  errorOf("nul.nrrd", replaced(nrrd, "kinds: domain domain domain", nul) + voxels);
}

TEST_F(DamagedVolume, WithOneFlippedBitInItsCompressedVoxelsIsAnError) {
  const std::string zlib = packed(voxels), gzip = packed(voxels, true);
  const std::string mha_head = replaced(mha, "CompressedData = False", "CompressedData = True");
  const std::string nrrd_head = replaced(nrrd, "encoding: raw", "encoding: gzip");
  EXPECT_EQ(readVolume(write("good.mha", mha_head + zlib)).values,
            readVolume(write("plain.mha", mha + voxels)).values);
  EXPECT_EQ(readVolume(write("good.nrrd", nrrd_head + gzip)).values,
            readVolume(folder / "plain.mha").values);
  for (std::size_t part = 1; part < 20; ++part) {
    std::string damaged_zlib = zlib, damaged_gzip = gzip;
    damaged_zlib[zlib.size() * part / 20] ^= 4;
    damaged_gzip[10 + (gzip.size() - 10) * part / 20] ^= 4;  // behind the header, which has no sum
    errorOf("z.mha", mha_head + damaged_zlib);
    errorOf("z.nrrd", nrrd_head + damaged_gzip);
  }
  errorOf("cut.mha", mha_head + zlib.substr(0, zlib.size() - 3));
  errorOf("short.mha", mha_head + packed(voxels.substr(2)));
  errorOf("long.mha", mha_head + packed(voxels + "xy"));
  errorOf("more.mha", mha_head + zlib + "more");
  errorOf("none.mha", mha_head + voxels);
}

TEST_F(DamagedVolume, WithAValueThatIsNotFiniteIsAnError) {
  std::string floats(4 * kVoxels, '\0');
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string head = replaced(mha, "MET_SHORT", "MET_FLOAT");
  EXPECT_NO_THROW(readVolume(write("f.mha", head + floats)));
  std::memcpy(floats.data() + 400, &nan, sizeof nan);
  EXPECT_THAT(errorOf("nan.mha", head + floats), HasSubstr("1 of 5760 values are not finite"));
}

TEST_F(DamagedVolume, InBigEndianOrInAFileBesideItsHeaderIsTheSame) {
  std::string swapped = voxels;
  for (std::size_t i = 0; i < swapped.size(); i += 2) std::swap(swapped[i], swapped[i + 1]);
  const auto values = readVolume(write("a.mha", mha + voxels)).values;
  EXPECT_EQ(readVolume(write("b.mha", replaced(mha, "MSB = False", "MSB = True") + swapped)).values,
            values);
  EXPECT_EQ(readVolume(write("b.nrrd", replaced(nrrd, "little", "big") + swapped)).values, values);
  write("v.raw", voxels);
  write("skip.raw", "12345" + voxels);
  EXPECT_EQ(readVolume(write("v.mhd", replaced(mha, "LOCAL", "v.raw"))).values, values);
  EXPECT_EQ(readVolume(write("s.mhd", replaced(mha, "ElementDataFile = LOCAL",
                                               "HeaderSize = -1\nElementDataFile = skip.raw")))
                .values,
            values);
  EXPECT_EQ(
      readVolume(write("s.nhdr", replaced(nrrd, "encoding: raw",
                                          "encoding: raw\nbyte skip: 5\ndata file: skip.raw")))
          .values,
      values);
}

TEST_F(DamagedVolume, APipeIsRefusedAtOnce) {
  for (const char* name : {"p.mha", "p.nii", "p.nii.gz", "p.nrrd", "p.dcm"}) {
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    errorOf(folder / name);
  }
}

TEST_F(DamagedVolume, ARealCtWithOneFlippedBitIsAnError) {
  SOFTSCOPE_DATA_OR_SKIP(ct, "ct");
  for (const char* name : {"chaos_set3_ct_256x256x78.mha", "chaos_set3_ct_256x256x78.nrrd",
                           "chaos_set3_ct_256x256x78.nii.gz"}) {
    std::ifstream file(ct / name, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(file), {}};
    for (int part = 1; part < 5; ++part) {
      std::string damaged = good;
      damaged[good.size() * std::size_t(part) / 5] ^= 4;
      errorOf(name, damaged);
    }
  }
}

}  // namespace
}  // namespace softscope::test
