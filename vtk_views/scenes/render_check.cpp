// vtk_views/scenes/render_check.cpp: scene with known pixels.
#include "vtk_views/scenes/render_check.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>

#include "vtk_views/scenes/offscreen_window.h"

namespace softscope {
namespace {

constexpr int kSizePx = 64;
using Rgb = std::array<int, 3>;
constexpr Rgb kSquare{255, 127, 0};
constexpr Rgb kGround{0, 0, 255};

vtkSmartPointer<vtkRenderer> squareOnGround() {
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> square;
  square->SetMapper(mapper);
  square->GetProperty()->SetColor(1.0, 0.5, 0.0);
  square->GetProperty()->LightingOff();
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(0.0, 0.0, 1.0);
  renderer->AddActor(square);
  renderer->ResetCamera();
  return renderer;
}

bool pixelIs(vtkRenderWindow* window, int x, int y, const Rgb& expected) {
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(x, y, x, y, 0, pixel);
  if (pixel->GetNumberOfValues() < 3) return false;
  for (int c = 0; c < 3; ++c)
    if (std::abs(int(pixel->GetValue(c)) - expected[c]) > 2) return false;  // rounding
  return true;
}

}  // namespace

RenderCheck checkRendering() {
  RenderCheck check;
  try {
    const auto start = std::chrono::steady_clock::now();
    const auto window = makeOffscreenWindow(kSizePx, kSizePx);
    check.renderer = offscreenDescription();
    window->AddRenderer(squareOnGround());
    window->Render();
    const bool middle = pixelIs(window, kSizePx / 2, kSizePx / 2, kSquare);
    const bool corner = pixelIs(window, 1, 1, kGround);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    check.first_frame_ms = took.count();
    check.works = middle && corner;
    if (!check.works) check.problem = check.renderer + " draws wrong pixels";
  } catch (const std::exception& error) {
    check.problem = error.what();
  }
  return check;
}

}  // namespace softscope
