// tests/vtk_views/damaged_volume.h: a small volume in MetaImage and NRRD, to be damaged.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

#include "core/error.h"
#include "support/folder_test.h"
#include "vtk_views/volumes/volume.h"

namespace softscope::test {

constexpr std::size_t kVoxels = 20 * 24 * 12;

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

/// 20 x 24 x 12 voxels of 16 bits, 2 x 2 x 3 mm.
class DamagedVolume : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    for (std::size_t i = 0; i < 2 * kVoxels; ++i) voxels += char(i * 7 % 251);
  }

  /// Reads it; the message, which names the file, in one line. Fails where it was read.
  std::string errorOf(const std::string& file, const VolumeOptions& options = {}) const {
    SCOPED_TRACE(file);
    try {
      readVolume(file, options);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(folder.string()));
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
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

}  // namespace softscope::test
