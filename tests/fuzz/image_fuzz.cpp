// tests/fuzz/image_fuzz.cpp: colour pictures and masks of every form.
#include "fuzz/fuzz_target.h"
#include "io/images/image_header.h"
#include "io/images/image_reader.h"

namespace {

// Larger pictures are sound but slow, and find nothing more.
constexpr long kMostPixels = 1 << 20;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view bytes = textOf(data, size);
  const auto header = answerOf([&] { return inspectImage(bytes, "fuzz"); });
  if (!header || long{header->width_px} * header->height_px > kMostPixels) return 0;
  const auto image = answerOf([&] { return parseColourImage(bytes, "fuzz"); });
  const auto mask = answerOf([&] { return parseMask(bytes, "fuzz"); });
  if (image) mustHold(image->width_px == header->width_px && image->height_px == header->height_px);
  if (image && mask) mustHold(mask->sameShape(*image));
  return 0;
}
