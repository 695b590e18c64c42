#include "io/sequences/picture_source.h"

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/images/image_reader.h"
#include "io/sequences/sequence_paths.h"
#include "io/sequences/video_source.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

class PictureFiles : public PictureSource {
 public:
  explicit PictureFiles(std::vector<fs::path> files) : files_(std::move(files)) {}

  int count() const override { return static_cast<int>(files_.size()); }
  ColourImage read(int index) override {
    return readColourImage(files_[static_cast<std::size_t>(index)]);
  }
  std::string nameOf(int index) const override {
    return shown(files_[static_cast<std::size_t>(index)]);
  }
  bool readsInAnyOrder() const override { return true; }
  bool survivesErrors() const override { return true; }
  std::vector<fs::path> files() const override { return files_; }

 private:
  std::vector<fs::path> files_;
};

}  // namespace

std::unique_ptr<PictureSource> openPictures(std::vector<fs::path> files) {
  return std::make_unique<PictureFiles>(std::move(files));
}

std::unique_ptr<PictureSource> openPictures(const fs::path& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) {
    auto files = filesIn(path, {kPictureKinds.begin(), kPictureKinds.end()});
    if (files.empty())
      throw InputError(shown(path) + ": holds no images, but png, jpg, bmp or tif are expected.");
    return std::make_unique<PictureFiles>(std::move(files));
  }
  requireFile(path);
  if (isVideo(path)) return openVideo(path);
  if (isPicture(path)) return std::make_unique<PictureFiles>(std::vector<fs::path>{path});
  throw InputError(say(shown(path),
                       ": its ending is neither an image's (png, jpg, bmp, tif) nor a ",
                       "video's (mp4, avi, mkv, mov, webm, …). Rename or convert it."));
}

}  // namespace softscope
