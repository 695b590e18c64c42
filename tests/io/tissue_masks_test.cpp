// tests/io/tissue_masks_test.cpp: masks of StereoMIS: half rate, any size, tissue instead of
// instruments.
#include "io/sequences/tissue_masks.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "io/images/image_writer.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class TissueMaskFiles : public testing::Test {
 protected:
  void touch(const std::string& name) const { writePng(folder_ / name, GrayImage(2, 2, 255)); }
  std::vector<std::string> namesOf(const TissueMasks& masks) const {
    std::vector<std::string> names;
    for (const fs::path& file : masks.files) names.push_back(file.filename().string());
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(TissueMaskFiles, AMaskBelongsToItsFrameAndToTheNextOneWithoutAnother) {
  for (const char* name : {"000001l.png", "000003l.png", "000004l.png", "000003r.png", "l.png"})
    touch(name);
  const TissueMasks masks = findTissueMasks(folder_ / ".", 8);
  EXPECT_THAT(namesOf(masks), ElementsAre("", "000001l.png", "000001l.png", "000003l.png",
                                          "000004l.png", "000004l.png", "", ""));
  ASSERT_EQ(masks.warnings.size(), 1u);
  EXPECT_THAT(masks.warnings[0], HasSubstr("3 of 8 frames have no mask"));
}

TEST_F(TissueMaskFiles, HalfRateMasksOfAllFramesGiveNoWarning) {
  for (const char* name : {"000000l.png", "000002l.png"}) touch(name);
  EXPECT_TRUE(findTissueMasks(folder_ / ".", 4).warnings.empty());
  const TissueMasks shorter = findTissueMasks(folder_ / ".", 2);
  ASSERT_EQ(shorter.warnings.size(), 1u);
  EXPECT_THAT(shorter.warnings[0], HasSubstr("1 masks are of frames after the last, 1"));
}

TEST_F(TissueMaskFiles, FoldersWithoutMasksAndDuplicatesAreRefused) {
  expectError<InputError>([&] { findTissueMasks(folder_ / "masks", 2); }, {"masks"});
  touch("000000.png");
  expectError<InputError>([&] { findTissueMasks(folder_ / ".", 2); }, {"no mask NNNNNNl.png"});
  touch("000000l.png");
  touch("0l.png");
  expectError<InputError>([&] { findTissueMasks(folder_ / ".", 2); }, {"second mask of frame 0"});
}

TEST_F(TissueMaskFiles, TissueIsWhatIsNotIgnoredResizedByNearestNeighbour) {
  GrayImage tissue(3, 1, 0);
  tissue.at(1, 0) = 255;
  tissue.at(2, 0) = 1;
  writePng(folder_ / "000000l.png", tissue);
  const Mask larger = readTissueMask(folder_ / "000000l.png", 6, 2);
  EXPECT_THAT(larger.values, ElementsAre(255, 255, 0, 0, 0, 0, 255, 255, 0, 0, 0, 0));
  EXPECT_THAT(readTissueMask(folder_ / "000000l.png", 3, 1).values, ElementsAre(255, 0, 0));
  EXPECT_THAT(readTissueMask(folder_ / "000000l.png", 1, 1).values, ElementsAre(0));
  EXPECT_THAT(readTissueMask(folder_ / "000000l.png", 4, 1).values, ElementsAre(255, 0, 0, 0));
  fs::resize_file(folder_ / "000000l.png", 40);
  expectError<InputError>([&] { readTissueMask(folder_ / "000000l.png", 6, 2); }, {"000000l.png"});
}

}  // namespace
}  // namespace softscope::test
