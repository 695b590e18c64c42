// vtk_views/files/vtk_errors.cpp: observer of
// the errors of a reader and its executive.
#include "vtk_views/files/vtk_errors.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <cstring>

#include "core/error.h"
#include "core/guarded_read.h"

namespace softscope {
namespace {

/// "ERROR: In file, line 1\nvtkReader (0x55): Can't open it.\n\n" becomes "Can't open it."
std::string plainText(std::string text) {
  const auto address = text.find("): ");
  if (address != std::string::npos) text.erase(0, address + 3);
  for (char& c : text)
    if (c == '\n') c = ' ';
  const auto last = text.find_last_not_of(" .");
  return last == std::string::npos ? "" : text.substr(0, last + 1);
}

class ErrorListener {
 public:
  explicit ErrorListener(vtkObject& subject) : subject_(subject) {
    command_->SetClientData(this);
    command_->SetCallback([](vtkObject*, unsigned long, void* self, void* text) {
      auto& first = static_cast<ErrorListener*>(self)->first_error;
      if (first.empty()) first = plainText(text ? static_cast<const char*>(text) : "unknown error");
    });
    tag_ = subject_.AddObserver(vtkCommand::ErrorEvent, command_);
    warning_tag_ = subject_.AddObserver(vtkCommand::WarningEvent, silence_);
  }
  ~ErrorListener() {
    subject_.RemoveObserver(tag_);
    subject_.RemoveObserver(warning_tag_);
  }
  ErrorListener(const ErrorListener&) = delete;
  ErrorListener& operator=(const ErrorListener&) = delete;

  std::string first_error;

 private:
  vtkObject& subject_;
  vtkNew<vtkCallbackCommand> command_;
  vtkNew<vtkCallbackCommand> silence_;
  unsigned long tag_ = 0;
  unsigned long warning_tag_ = 0;
};

/// Captures messages without an event (vtkGenericWarningMacro): readers report short files by them.
class SilentOutput : public vtkOutputWindow {
 public:
  static SilentOutput* New();
  vtkTypeMacro(SilentOutput, vtkOutputWindow)
  void DisplayText(const char* text) override {
    for (const char* sign : {"File operation failed", "Error reading"})
      if (std::strstr(text, sign) != nullptr) cut_short = true;
  }

  bool cut_short = false;
};
vtkStandardNewMacro(SilentOutput);

/// Suppresses VTK's warnings in its scope.
class Silence {
 public:
  Silence()
      : before_(vtkOutputWindow::GetInstance()), log_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(silent_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Silence() {
    vtkOutputWindow::SetInstance(before_);
    vtkLogger::SetStderrVerbosity(log_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

  bool reportedShortFile() const { return silent_->cut_short; }

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity log_;
  vtkNew<SilentOutput> silent_;
};

}  // namespace

void updateOrThrow(vtkAlgorithm& reader, const std::string& source) {
  if (!insideGuardedRead()) throw Error(source + ": is read outside guardedRead()");
  const Silence silence;
  const ErrorListener of_reader(reader);
  const ErrorListener of_executive(*reader.GetExecutive());
  reader.Update();
  const std::string& error =
      of_reader.first_error.empty() ? of_executive.first_error : of_reader.first_error;
  if (silence.reportedShortFile())
    throw InputError(source + ": is cut short: its data end before its header says. Copy it again");
  if (!error.empty() || reader.GetErrorCode() != 0)
    throw InputError(source + ": can't be read: " + (error.empty() ? "broken file" : error) +
                     ". Is it complete, and of the kind its name says?");
}

}  // namespace softscope
