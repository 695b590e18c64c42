// tests/vtk_views/test_volume_damage.cpp: geometry that a file doesn't say is never made up, and
// damaged voxels are never drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <Eigen/LU>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "core/error.h"
#include "tests/support/data_folder.h"
#include "vtk_views/volume.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t kVoxels = 20 * 24 * 12;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

/// 20 x 24 x 12 voxels of 16 bits, 2 x 2 x 3 mm.
class DamagedVolume : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder = fs::temp_directory_path() / ("softscope_damage_" + test);
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (std::size_t i = 0; i < 2 * kVoxels; ++i) voxels += char(i * 7 % 251);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }

  /// Reads it; the message, which names the file, in one line. Fails where it was read.
  std::string errorOf(const std::string& file, const VolumeOptions& options = {}) const {
    SCOPED_TRACE(file);
    try {
      readVolume(file, options);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(folder.string()));
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      return error.what();
    }
    ADD_FAILURE() << file << " was read";
    return {};
  }
  std::string errorOf(const std::string& name, const std::string& bytes) const {
    return errorOf(write(name, bytes));
  }

  static std::string packed(const std::string& bytes, bool gzip = false) {
    std::string result(bytes.size() + 1000, '\0');
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, 15 + (gzip ? 16 : 0), 8, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    deflate(&stream, Z_FINISH);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    return result;
  }

  fs::path folder;
  std::string voxels;
  const std::string mha =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
      "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
      "ElementSpacing = 2 2 3\nDimSize = 20 24 12\nElementType = MET_SHORT\n"
      "ElementDataFile = LOCAL\n";
  const std::string nrrd =
      "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 20 24 12\n"
      "space directions: (2,0,0) (0,2,0) (0,0,3)\nkinds: domain domain domain\nendian: little\n"
      "encoding: raw\nspace origin: (-20,-24,-18)\n\n";
  const VolumeOptions stated = [] {
    VolumeOptions options;
    options.spacing_mm = Eigen::Vector3d(2, 2, 3);
    return options;
  }();
};

TEST_F(DamagedVolume, WithoutSpacingAsksForItAndTakesWhatIsStated) {
  const std::string no_spacing = replaced(mha, "ElementSpacing = 2 2 3\n", "");
  const std::string no_directions =
      replaced(nrrd, "space directions: (2,0,0) (0,2,0) (0,0,3)\n", "");
  for (const std::string& file :
       {write("a.mha", no_spacing + voxels), write("a.nrrd", no_directions + voxels),
        write("zero.mha", replaced(mha, "= 2 2 3", "= 0 2 3") + voxels),
        write("minus.mha", replaced(mha, "= 2 2 3", "= 2 -2 3") + voxels),
        write("nan.mha", replaced(mha, "= 2 2 3", "= 2 nan 3") + voxels)}) {
    EXPECT_THAT(errorOf(file), HasSubstr("--spacing X,Y,Z"));
    const Volume volume = readVolume(file, stated);
    EXPECT_EQ(volume.facts.spacing_mm, (std::array<double, 3>{2, 2, 3})) << file;
  }
  const Volume other =
      readVolume(write("b.mha", replaced(mha, "= 2 2 3", "= 1 1 1") + voxels), stated);
  EXPECT_EQ(other.facts.spacing_mm, (std::array<double, 3>{2, 2, 3}));
  ASSERT_FALSE(other.facts.warnings.empty()) << "the file says otherwise";
  EXPECT_THAT(other.facts.warnings[0], HasSubstr("1 x 1 x 1 mm"));
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
  for (const char* value :
       {"(nan,0,0) (0,2,0) (0,0,3)", "(2,0,0) (0,2,0) (0,0,3", "(2,0,0) (0,2,0)",
        "(0,0,0) (0,2,0) (0,0,3)", "(2,0,0) (2,0,0) (0,0,3)", "(2,0,0) (0,2e9,0) (0,0,3)", "", "x"})
    EXPECT_THAT(errorOf("d.nrrd", directions(value)), HasSubstr("space directions")) << value;
  EXPECT_THAT(errorOf("o.nrrd", replaced(nrrd, "(-20,-24", "(inf,-24") + voxels),
              HasSubstr("space origin"));
  for (const char* value : {"1 0 0 0 1 0 0 0 nan", "1 0 0 0 1 0 0 0", "1 0 0 1 0 0 0 0 1",
                            "9 0 0 0 9 0 0 0 9", "a b c"})
    EXPECT_THAT(errorOf("t.mha", replaced(mha, "1 0 0 0 1 0 0 0 1", value) + voxels),
                HasSubstr("TransformMatrix"))
        << value;
  EXPECT_THAT(errorOf("o.mha", replaced(mha, "Offset = 0 0 0", "Offset = 0 0 inf") + voxels),
              HasSubstr("Offset"));
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

/// A NIfTI-1 header of the same volume, and its fields by their offsets in the standard.
class DamagedNifti : public DamagedVolume {
 protected:
  void SetUp() override {
    DamagedVolume::SetUp();
    head.assign(352, '\0');
    set<std::int32_t>(0, 348);
    const std::int16_t dim[] = {3, 20, 24, 12, 1, 1, 1, 1};
    for (std::size_t i = 0; i < 8; ++i) set<std::int16_t>(40 + 2 * i, dim[i]);
    set<std::int16_t>(70, 4);
    set<std::int16_t>(72, 16);
    const float pixdim[] = {1, 2, 2, 3};
    for (std::size_t i = 0; i < 4; ++i) set<float>(76 + 4 * i, pixdim[i]);
    set<float>(108, 352);
    set<float>(112, 1);
    head[123] = 2;
    set<std::int16_t>(254, 1);
    const float srow[] = {2, 0, 0, -20, 0, 2, 0, -24, 0, 0, 3, -18};
    for (std::size_t i = 0; i < 12; ++i) set<float>(280 + 4 * i, srow[i]);
    std::memcpy(head.data() + 344, "n+1", 4);
  }
  template <class Stored>
  void set(std::size_t offset, Stored value) {
    std::memcpy(head.data() + offset, &value, sizeof value);
  }
  /// The message on a header with one other value.
  template <class Stored>
  std::string errorWith(std::size_t offset, Stored value) {
    const std::string before = head;
    set(offset, value);
    const std::string error = errorOf("n.nii", head + voxels);
    head = before;
    return error;
  }
  std::string head;
};

TEST_F(DamagedNifti, NamesTheFieldAndNeverGuesses) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Volume good = readVolume(write("good.nii", head + voxels));
  EXPECT_EQ(good.facts.spacing_mm, (std::array<double, 3>{2, 2, 3}));
  EXPECT_EQ(readVolume(write("good.nii.gz", packed(head + voxels, true))).values, good.values);
  EXPECT_THAT(errorWith<float>(280, nan), HasSubstr("srow_x"));
  EXPECT_THAT(errorWith<float>(112, nan), HasSubstr("scl_slope"));
  EXPECT_THAT(errorWith<float>(116, nan), HasSubstr("scl_inter"));
  EXPECT_THAT(errorWith<float>(280, 0), HasSubstr("srow_x"));
  EXPECT_THAT(errorWith<std::int16_t>(40, 0), HasSubstr("dim[0]"));
  EXPECT_THAT(errorWith<std::int16_t>(40, 9), HasSubstr("dim[0]"));
  EXPECT_THAT(errorWith<std::int16_t>(42, 0), HasSubstr("dim[1]"));
  EXPECT_THAT(errorWith<std::int16_t>(42, -20), HasSubstr("dim[1]"));
  EXPECT_THAT(errorWith<std::int16_t>(70, 3), HasSubstr("datatype"));
  EXPECT_THAT(errorWith<std::int16_t>(72, 8), HasSubstr("bitpix"));
  EXPECT_THAT(errorWith<float>(108, nan), HasSubstr("vox_offset"));
  EXPECT_THAT(errorWith<float>(108, 0), HasSubstr("vox_offset"));
  EXPECT_THAT(errorWith<char>(123, 7), HasSubstr("xyzt_units"));
  EXPECT_THAT(errorWith<char>(344, 'x'), HasSubstr("magic"));
  set<std::int16_t>(40, 5);
  set<std::int16_t>(50, 0);
  EXPECT_THAT(errorOf("five.nii", head + voxels), HasSubstr("dim[5]"));
}

TEST_F(DamagedNifti, OfAHugeSizeIsCutShort) {
  for (const std::size_t offset : {42, 44, 46}) set<std::int16_t>(offset, 32767);
  EXPECT_THAT(errorOf("huge.nii", head + voxels), HasSubstr("cut short"));
  EXPECT_THAT(errorOf("huge.nii.gz", packed(head + voxels, true)), HasSubstr("cut short"));
}

TEST_F(DamagedNifti, WithoutSidesOfItsVoxelsAsksForThem) {
  set<std::int16_t>(254, 0);
  set<std::int16_t>(252, 1);
  set<float>(80, 0);
  const std::string file = write("q.nii", head + voxels);
  EXPECT_THAT(errorOf(file), testing::AllOf(HasSubstr("pixdim[1]"), HasSubstr("--spacing X,Y,Z")));
  EXPECT_EQ(readVolume(file, stated).facts.spacing_mm, (std::array<double, 3>{2, 2, 3}));
  set<float>(80, 2);
  EXPECT_THAT(errorWith<float>(268, std::numeric_limits<float>::quiet_NaN()), HasSubstr("qoffset"));
  EXPECT_THAT(errorWith<float>(256, std::numeric_limits<float>::quiet_NaN()), HasSubstr("quatern"));
  EXPECT_THAT(errorWith<float>(256, 7), HasSubstr("quatern"));
}

TEST_F(DamagedNifti, OneFlippedBitInGzipIsAnError) {
  const std::string good = packed(head + voxels, true);
  for (std::size_t part = 1; part < 20; ++part) {
    std::string damaged = good;
    damaged[10 + (good.size() - 10) * part / 20] ^= 4;
    errorOf("d.nii.gz", damaged);
  }
}

TEST_F(DamagedVolume, APipeIsRefusedAtOnce) {
  for (const char* name : {"p.mha", "p.nii", "p.nii.gz", "p.nrrd", "p.dcm"}) {
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    errorOf(folder / name);
  }
}

/// `count` files with a few bytes changed, taken out or put in among the first `head_bytes`, or
/// cut.
template <class Use>
void forDamagedCopies(const std::string& good, std::size_t head_bytes, int count, const Use& use) {
  std::mt19937 random(7);
  const std::string digits = "0123456789.-+e(), \n=:%";
  for (int round = 0; round < count; ++round) {
    std::string bad = good;
    for (int k = 0; k < 1 + round % 4; ++k) {
      const std::size_t at = random() % head_bytes;
      const char byte = round % 2 == 0 ? char(random()) : digits[random() % digits.size()];
      const int kind = round % 5;
      if (kind == 3)
        bad.erase(at, 1 + random() % 4);
      else if (kind == 4)
        bad.insert(at, 1, byte);
      else
        bad[at] = byte;
    }
    if (round % 11 == 0) bad.resize(random() % bad.size());
    use(bad);
  }
}

TEST_F(DamagedNifti, AnyDamageToAHeaderIsAnErrorOrASoundGeometry) {
  const std::pair<const char*, std::string> files[] = {
      {"d.mha", mha + voxels},
      {"d.nrrd", nrrd + voxels},
      {"d.nii", head + voxels},
      {"z.mha", replaced(mha, "CompressedData = False", "CompressedData = True") + packed(voxels)}};
  int read = 0;
  for (const auto& [name, good] : files)
    forDamagedCopies(good, 340, 400, [&, name = std::string(name)](const std::string& bad) {
      const std::string file = write(name, bad);
      try {
        const Volume volume = readVolume(file);
        ++read;
        for (const double spacing_mm : volume.facts.spacing_mm)
          EXPECT_TRUE(spacing_mm >= 1e-4 && spacing_mm <= 1e3) << spacing_mm;
        EXPECT_TRUE(volume.facts.lps_from_voxel.allFinite());
        EXPECT_GT(std::abs(volume.facts.lps_from_voxel.determinant()), 0);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      }
    });
  EXPECT_GT(read, 50) << "some damage means nothing";
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
}  // namespace softscope
