// apps/calibration_template.cpp: `softscope calibration-template`: calibration template.
#include "toolkit/calibration/calibration_template.h"

#include <spdlog/spdlog.h>

#include <iostream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "io/files/atomic_file.h"

namespace softscope {
namespace {

class CalibrationTemplateCommand : public Command {
 public:
  std::string name() const override { return "calibration-template"; }
  std::string summary() const override { return "template of a calibration file, with comments"; }
  std::string details() const override {
    return "KIND is\n"
           "  stereo      raw images: M1 D1 M2 D2 R T, named as in OpenCV's stereoCalibrate\n"
           "  rectified   rectified images: f, cx, cy and baseline\n"
           "  rgb-d       one camera, for depth files with or without colour images: fx fy cx cy\n"
           "Printed, or written to --out. `softscope info FILE` checks the completed file.";
  }
  std::string example() const override {
    return "softscope calibration-template rectified --out calibration.yaml";
  }
  void declare(ArgumentList& arguments) override {
    arguments.positional("KIND", kind_, "stereo, rectified or rgb-d", true);
    arguments.option("--out", "FILE", out_, "output file (default: stdout)");
    arguments.flag("--force", force_, "overwrite an existing file");
  }

  int run() override {
    const std::string text = calibrationTemplate(kind_);
    if (!out_.empty()) {
      writeFile(out_, text, force_);
      spdlog::info("written: {}", out_);
    }
    if (common.json)
      printJson({{"schema_version", 1}, {"kind", kind_}, {"template", text}, {"file", fileJson()}});
    else if (out_.empty())
      std::cout << text << std::flush;
    return kDone;
  }

 private:
  FactSheet::Json fileJson() const {
    return out_.empty() ? FactSheet::Json() : FactSheet::Json(out_);
  }

  std::string kind_, out_;
  bool force_ = false;
};

}  // namespace

std::unique_ptr<Command> makeCalibrationTemplateCommand() {
  return std::make_unique<CalibrationTemplateCommand>();
}

}  // namespace softscope
