// toolkit/study/study_outputs.h: the files of a study.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "toolkit/study/study_folder.h"
#include "toolkit/study/study_table.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// "blur_points" and its drawing.
using StudyFigure = std::pair<std::string, VectorDrawing>;

/// A curve a series for each sweep and plot; bars for each plot of a study without sweeps. What has
/// no value at all has no figure.
std::vector<StudyFigure> studyFigures(const Study& study,
                                      const std::vector<FactSheet::Json>& records);

/// One HTML page that opens from disk: the table, the figures inside it, how it was made.
std::string studyPage(const Study& study, const StudyTable& table,
                      const std::vector<StudyFigure>& figures, const FactSheet::Json& record);

/// table.csv, table.md, plots/ as SVG, PDF and PNG, report.html, and study.json last.
void writeStudy(const Study& study, const std::vector<FactSheet::Json>& records,
                const std::string& command, const StudyFolder& folder);

}  // namespace softscope
