// tests/vtk_views/test_nifti_damage.cpp: every field of a NIfTI header is checked, and any damage
// to a header of any form ends in an error or a sound geometry.
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tests/vtk_views/damaged_volume.h"

namespace softscope::test {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(errorOf(file), testing::AllOf(HasSubstr("pixdim[1]"), HasSubstr("`spacing=` X,Y,Z")));
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

}  // namespace
}  // namespace softscope::test
