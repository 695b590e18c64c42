// src/io/sequences/picture_source.h: images of one view, from files or a video.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace softscope {

inline constexpr std::array<std::string_view, 8> kPictureKinds = {".png", ".jpg",  ".jpeg", ".bmp",
                                                                  ".tif", ".tiff", ".pgm",  ".ppm"};

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// How many images there are; of a video, as many as its header promises.
  virtual int count() const = 0;

  /// Throws InputError. Indices must not fall from call to call.
  virtual ColourImage read(int index) = 0;

  /// What messages call image `index`.
  virtual std::string nameOf(int index) const = 0;

  /// 0 where nothing is known of it.
  virtual double framesPerSecond() const { return 0; }

  /// Whether the image after one that can't be read can be.
  virtual bool survivesErrors() const = 0;

  /// The files, one an image; empty of a video.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
};

/// A folder of images, one image, or a video. Throws InputError.
std::unique_ptr<PictureSource> openPictures(const std::filesystem::path& path);
/// These files, one an image.
std::unique_ptr<PictureSource> openPictures(std::vector<std::filesystem::path> files);

}  // namespace softscope
