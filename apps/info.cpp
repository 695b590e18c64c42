// apps/info.cpp: `softscope info`: content and plausibility of a file.
#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "apps/shared_arguments.h"
#include "toolkit/figures/volume_arguments.h"
#include "toolkit/inspection/describe_path.h"

namespace softscope {
namespace {

class InfoCommand : public Command {
 public:
  std::string name() const override { return "info"; }
  std::string summary() const override {
    return "content of a sequence, image, mesh, volume, calibration or settings file";
  }
  std::string details() const override {
    return "Prints size, units, geometry, implausible values and missing parts.";
  }
  std::string example() const override { return "softscope info my_sequence"; }

  void declare(ArgumentList& arguments) override {
    softscope::declare(volume_, arguments);
    arguments.positional("PATH", path_, "file or folder", true);
    arguments.flag("--check", check_, "read every frame of a sequence instead of the first");
    arguments.flag("--patient", patient_,
                   "also print patient fields and description of a DICOM series");
  }

  int run() override {
    DescribeOptions options;
    options.check_all = check_;
    options.volume = volume_.options();
    options.volume.with_patient = patient_;
    const FactSheet facts = describePath(path_, options);
    printFacts(facts, common.json);
    return facts.hasProblems() ? kInput : kDone;
  }

 private:
  std::string path_;
  VolumeArguments volume_;
  bool check_ = false;
  bool patient_ = false;
};

}  // namespace

std::unique_ptr<Command> makeInfoCommand() { return std::make_unique<InfoCommand>(); }

}  // namespace softscope
