// vtk_views/files/vtk_errors.h: turns what VTK would print into exceptions.
#pragma once

#include <vtkAlgorithm.h>

#include <string>

namespace softscope {

/// Runs a reader and its pipeline. VTK reports failures as events and still hands out data, so they
/// are collected instead of printed. Throws InputError with `source` and VTK's first complaint, and
/// Error outside guardedRead(): readers of other libraries crash on some damaged files.
void updateOrThrow(vtkAlgorithm& reader, const std::string& source);

}  // namespace softscope
