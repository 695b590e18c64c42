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

  /// Number of images; for a video the number in its header.
  virtual int count() const = 0;

  /// Throws InputError. Indices must not decrease between calls, unless readsInAnyOrder().
  virtual ColourImage read(int index) = 0;

  /// True if several threads may read at once, whatever each reads; then survivesErrors() too.
  virtual bool readsInAnyOrder() const { return false; }

  /// Name of image `index` in messages.
  virtual std::string nameOf(int index) const = 0;

  /// 0 if unknown.
  virtual double framesPerSecond() const { return 0; }

  /// True if images after an unreadable one can be read.
  virtual bool survivesErrors() const = 0;

  /// One file per image; empty for a video.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
};

/// Folder of images, one image, or a video. Throws InputError.
std::unique_ptr<PictureSource> openPictures(const std::filesystem::path& path);
/// One file per image.
std::unique_ptr<PictureSource> openPictures(std::vector<std::filesystem::path> files);

}  // namespace softscope
