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

/// "blur_points" with its drawing.
using StudyFigure = std::pair<std::string, VectorDrawing>;

/// One curve per series for each sweep and plot; bars for each plot
/// of a study without sweeps. Figures without any value are omitted.
std::vector<StudyFigure> studyFigures(const Study& study,
                                      const std::vector<FactSheet::Json>& records);

/// One self-contained HTML page: table, figures, command.
std::string studyPage(const Study& study, const StudyTable& table,
                      const std::vector<StudyFigure>& figures, const FactSheet::Json& record);

/// table.csv, table.md, plots/ as SVG, PDF and PNG, report.html, and study.json last.
void writeStudy(const Study& study, const std::vector<FactSheet::Json>& records,
                const std::string& command, const StudyFolder& folder);

}  // namespace softscope
