#include "io/images/image_header.h"

#include "core/error.h"
#include "io/images/image_walks.h"
#include "io/images/picture_limits.h"
#include "io/text/message.h"

namespace softscope {
namespace {

bool startsWith(std::string_view bytes, std::string_view head) {
  return bytes.substr(0, head.size()) == head;
}

PictureSize sizeOf(std::string_view bytes, ImageForm form, const std::string& name) {
  switch (form) {
    case ImageForm::kPng:
      return walkPng(bytes, name);
    case ImageForm::kJpeg:
      return walkJpeg(bytes, name);
    case ImageForm::kBmp:
      return walkBmp(bytes, name);
    case ImageForm::kTiff:
      return walkTiff(bytes, name);
    case ImageForm::kPnm:
      break;
  }
  return walkPnm(bytes, name);
}

ImageForm formOf(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) throw InputError(name + ": the file is empty. Copy or export it again.");
  if (startsWith(bytes, kPngSignature)) return ImageForm::kPng;
  if (startsWith(bytes, "\xFF\xD8")) return ImageForm::kJpeg;
  if (startsWith(bytes, "BM")) return ImageForm::kBmp;
  if (startsWith(bytes, {"II*\0", 4}) || startsWith(bytes, {"MM\0*", 4})) return ImageForm::kTiff;
  if (startsWith(bytes, "P5") || startsWith(bytes, "P6")) return ImageForm::kPnm;
  throw InputError(say(name, ": begins with ", excerpt(bytes.substr(0, 4)),
                       ", but a PNG, JPEG, BMP, TIFF or binary PGM/PPM image is expected."));
}

}  // namespace

ImageHeader inspectImage(std::string_view bytes, const std::string& name) {
  const ImageForm form = formOf(bytes, name);
  const PictureSize size = sizeOf(bytes, form, name);
  requirePictureSize(size.width_px, size.height_px, name);
  return {form, static_cast<int>(size.width_px), static_cast<int>(size.height_px)};
}

}  // namespace softscope
