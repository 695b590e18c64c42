// apps/command.h: interface of one `softscope <command>`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/argument_list.h"
#include "apps/common_options.h"

namespace softscope {

class Command {
 public:
  virtual ~Command() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;  // one line, for the list of commands
  virtual std::string details() const = 0;  // for its own help; may be empty
  virtual std::string example() const = 0;  // a line to be copied
  /// Binds arguments to members; common options are declared elsewhere.
  virtual void declare(ArgumentList& arguments) = 0;
  /// Returns an ExitCode. Throws softscope::Error and derived exceptions.
  virtual int run() = 0;

  CommonOptions common;
  std::vector<std::string> words;  // of the command line, from the name of the command on
};

std::unique_ptr<Command> makeBenchmarkCommand();
std::unique_ptr<Command> makeCalibrateCommand();
std::unique_ptr<Command> makeCalibrationTemplateCommand();
std::unique_ptr<Command> makeCompareCommand();
std::unique_ptr<Command> makeDepthCommand();
std::unique_ptr<Command> makeSettingsCommand();
std::unique_ptr<Command> makeDoctorCommand();
std::unique_ptr<Command> makeEvaluateCommand();
std::unique_ptr<Command> makeExportCommand();
std::unique_ptr<Command> makeFigureCommand();
std::unique_ptr<Command> makeInfoCommand();
std::unique_ptr<Command> makeReconstructCommand();
std::unique_ptr<Command> makeReportCommand();
std::unique_ptr<Command> makeSimulateCommand();
std::unique_ptr<Command> makeSliceCommand();
std::unique_ptr<Command> makeStudyCommand();
std::unique_ptr<Command> makeViewCommand();

/// In the order of the help.
std::vector<std::unique_ptr<Command>> allCommands();

}  // namespace softscope
