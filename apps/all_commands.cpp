// apps/all_commands.cpp: list of commands.
#include "apps/command.h"

namespace softscope {

std::vector<std::unique_ptr<Command>> allCommands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(makeReconstructCommand());
  commands.push_back(makeDepthCommand());
  commands.push_back(makeCalibrateCommand());
  commands.push_back(makeCalibrationTemplateCommand());
  commands.push_back(makeSimulateCommand());
  commands.push_back(makeEvaluateCommand());
  commands.push_back(makeCompareCommand());
  commands.push_back(makeBenchmarkCommand());
  commands.push_back(makeStudyCommand());
  commands.push_back(makeSliceCommand());
  commands.push_back(makeFigureCommand());
  commands.push_back(makeReportCommand());
  commands.push_back(makeExportCommand());
  commands.push_back(makeViewCommand());
  commands.push_back(makeInfoCommand());
  commands.push_back(makeSettingsCommand());
  commands.push_back(makeDoctorCommand());
  return commands;
}

}  // namespace softscope
