// vtk_views/scenes/window_pixels.cpp: rows bottom-up in VTK, top-down in images.
#include "vtk_views/scenes/window_pixels.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include "core/parallel.h"

namespace softscope {
namespace {

struct FinePixels {
  const unsigned char* data;
  std::size_t row_bytes;
  int finer;

  /// Mean of the block with lower left pixel (x, y).
  Rgb8 mean(std::size_t x, std::size_t y) const {
    int sum[3] = {0, 0, 0};
    for (std::size_t j = 0; j < std::size_t(finer); ++j) {
      const unsigned char* row = data + (y + j) * row_bytes + 3 * x;
      for (int i = 0; i < 3 * finer; ++i) sum[i % 3] += row[i];
    }
    const int count = finer * finer;
    const auto rounded = [&](int c) { return std::uint8_t((sum[c] + count / 2) / count); };
    return {rounded(0), rounded(1), rounded(2)};
  }
};

}  // namespace

vtkSmartPointer<vtkImageData> vtkImageOf(const ColourImage& picture) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(picture.width_px, picture.height_px, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int v = picture.height_px - 1; v >= 0; --v)  // bottom-up in VTK
    for (int u = 0; u < picture.width_px; ++u) {
      const Rgb8 c = picture.at(u, v);
      *out++ = c.red;
      *out++ = c.green;
      *out++ = c.blue;
    }
  return image;
}

ColourImage readPixels(vtkRenderWindow* window, int width_px, int height_px, int finer) {
  vtkNew<vtkUnsignedCharArray> fine;
  window->GetPixelData(0, 0, finer * width_px - 1, finer * height_px - 1, 0, fine);
  const auto step = std::size_t(finer);
  const FinePixels pixels{fine->GetPointer(0), 3 * step * std::size_t(width_px), finer};
  ColourImage picture(width_px, height_px);
  parallelRows(height_px, [&](int v) {
    for (int u = 0; u < width_px; ++u)
      picture.at(u, v) = pixels.mean(step * std::size_t(u), step * std::size_t(height_px - 1 - v));
  });
  return picture;
}

}  // namespace softscope
