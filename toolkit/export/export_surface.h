// toolkit/export/export_surface.h: surface from points, with facts about holes and drops.
#pragma once

#include <filesystem>
#include <string>

#include "core/model_surface.h"
#include "mesh/surface_from_points.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Triangulates the points; adds closed holes and dropped points
/// to the facts. Throws InputError that begins with `name`.
ModelSurface makeSurface(const ModelSurface& points, const SurfaceOptions& options,
                         const std::string& name, FactSheet& facts);

/// Counts, area, space.
void addModelFacts(const ModelSurface& model, FactSheet& facts);

/// One line of a ParaView collection, and the collection of such lines.
std::string pvdLine(double time_s, const std::filesystem::path& file);
std::string pvdFile(const std::string& lines);

}  // namespace softscope
