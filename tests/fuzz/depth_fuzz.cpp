// tests/fuzz/depth_fuzz.cpp: depth and disparity from PFM, 16-bit PNG, float TIFF and NumPy arrays.
#include <cmath>

#include "fuzz/fuzz_target.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/pfm_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view bytes = textOf(data, size);
  if (const auto depth_mm = answerOf([&] { return parseDepth(bytes, "fuzz"); }))
    for (const float value : depth_mm->values)
      mustHold(std::isnan(value) || (value > 0 && std::isfinite(value)));
  if (const auto disparity_px = answerOf([&] { return parseDisparity(bytes, "fuzz"); }))
    for (const float value : disparity_px->values) mustHold(!std::isinf(value));
  if (const auto raster = answerOf([&] { return parsePfm(bytes, "fuzz"); }))
    mustHold(parsePfm(pfmBytes(*raster), "again").sameShape(*raster));
  return 0;
}
