// apps/doctor.cpp: `softscope doctor`: check of the installation.
#include <algorithm>
#include <iostream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/library_versions.h"
#include "apps/result_output.h"
#include "core/parallel.h"
#include "io/text/message.h"
#include "pipeline/backends.h"
#include "toolkit/record/machine.h"
#include "toolkit/record/version.h"
#include "vtk_views/drawing/fonts.h"
#include "vtk_views/scenes/render_check.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

/// Result of one check.
struct Finding {
  std::string what;
  bool fine = true;
  std::string found;
  std::string to_do;  // advice, if it failed
};

Finding examineProcessor(const Machine& machine, Json& json) {
  Finding finding{"processor", true, machine.processor, ""};
  Json& sets = json["instruction_sets"] = Json::object();
  for (const auto& [name, there] : machine.instruction_sets) {
    sets[name] = there;
    if (there) finding.found += ", " + name;
    if (name == "AVX2" && !there) {
      finding.fine = false;
      finding.to_do = "works, but slower: the fast loops need AVX2";
    }
  }
  json["processor"] = machine.processor;
  return finding;
}

Finding examineCores(const Machine& machine, Json& json) {
  json["usable_cores"] = machine.cores;
  json["threads"] = threadCount();
  return {"cores", true,
          std::to_string(machine.cores) + " usable, " + std::to_string(threadCount()) + " threads",
          ""};
}

Finding examineMemory(const Machine& machine, Json& json) {
  const double memory_gib = double(machine.memory_bytes) / double(1ull << 30);
  json["memory_bytes"] = machine.memory_bytes;
  return {"memory", memory_gib >= 2, fixed(memory_gib, 1) + " GiB",
          "softscope needs 2 GiB; give the machine or container more"};
}

std::string capability(const cuda::Device& device) {
  return std::to_string(device.capability_major) + "." + std::to_string(device.capability_minor);
}

Finding examineDevice(const cuda::Device& device, Json& devices) {
  const double memory_gib = double(device.memory_bytes) / double(1ull << 30);
  devices.push_back({{"name", device.name},
                     {"compute_capability", capability(device)},
                     {"multiprocessors", device.multiprocessors},
                     {"memory_bytes", device.memory_bytes},
                     {"problem", device.problem}});
  return {"GPU", device.problem.empty(),
          device.name + ", compute capability " + capability(device) + ", " + fixed(memory_gib, 1) +
              " GiB",
          device.problem};
}

std::vector<Finding> examineCuda(Json& json) {
  const cuda::DeviceInfo info = cudaDevices();
  const std::string built =
      info.runtime_version.empty() ? "not in this build" : "built with " + info.runtime_version;
  const std::string driver =
      info.driver_version.empty() ? "" : ", driver for " + info.driver_version;
  json["cuda"] = {{"built_with", info.runtime_version}, {"driver", info.driver_version}};
  Json& devices = json["cuda"]["devices"] = Json::array();
  const std::string use =
      cudaUnavailableReason().empty()
          ? ": the first GPU computes stereo, matching, pose and the solver of the warp"
          : "";
  std::vector<Finding> findings{{"CUDA", !info.devices.empty(), built + driver + use,
                                 info.why_none + ". The CPU computes everything"}};
  for (const cuda::Device& device : info.devices)
    findings.push_back(examineDevice(device, devices));
  return findings;
}

Finding examineRendering(Json& json) {
  const RenderCheck check = checkRendering();
  json["rendering"] = {{"works", check.works},
                       {"renderer", check.renderer},
                       {"first_frame_ms", check.first_frame_ms},
                       {"problem", check.problem}};
  return {"rendering", check.works,
          check.works ? check.renderer + ", first image " + fixed(check.first_frame_ms, 0) + " ms"
                      : "no renderer on this machine",
          check.problem};
}

Finding examineFonts(Json& json) {
  const FontFile font = findFont(figureFont());
  json["font"] = {{"wanted", "Arial or Helvetica, else Liberation Sans"},
                  {"family", font.family},
                  {"file", font.path}};
  return {"font", figureFontHasArialsWidths(),
          font.path.empty() ? "no font found" : font.family + ", " + font.path,
          "figures need Arial, Helvetica or a font of the same widths: install fonts-liberation"};
}

class DoctorCommand : public Command {
 public:
  std::string name() const override { return "doctor"; }
  std::string summary() const override {
    return "checks versions, processor, CUDA, rendering and fonts";
  }
  std::string details() const override {
    return "Renders a small image off-screen and reads it back. Exit code 4 without a renderer;\n"
           "every other missing part is a warning with advice.";
  }
  std::string example() const override { return "softscope doctor --json"; }
  void declare(ArgumentList&) override {}

  int run() override {
    Json json = Json::object();
    json["schema_version"] = 1;
    const std::vector<Finding> findings = examine(json);
    if (common.json)
      printJson(json);
    else
      print(findings);
    return json["rendering"]["works"].get<bool>() ? kDone : kNoBackend;
  }

 private:
  static std::vector<Finding> examine(Json& json) {
    std::vector<Finding> findings{{"softscope", true, versionText(), ""},
                                  {"compiler", true, compilerText(), ""}};
    json["softscope"] = versionText();
    json["compiler"] = compilerText();
    for (const auto& [name, version] : libraryVersions()) {
      findings.push_back({name, true, version, ""});
      json["libraries"][name] = version;
    }
    const Machine machine = describeMachine();
    findings.push_back(examineProcessor(machine, json));
    findings.push_back(examineCores(machine, json));
    findings.push_back(examineMemory(machine, json));
    for (Finding& finding : examineCuda(json)) findings.push_back(std::move(finding));
    findings.push_back(examineRendering(json));
    findings.push_back(examineFonts(json));
    Json& warnings = json["warnings"] = Json::array();
    for (const Finding& finding : findings)
      if (!finding.fine) warnings.push_back(finding.what + ": " + finding.to_do);
    return findings;
  }

  static void print(const std::vector<Finding>& findings) {
    for (const Finding& finding : findings) {
      std::cout << (finding.fine ? "ok    " : "warn  ") << finding.what
                << std::string(15 - std::min<std::size_t>(14, finding.what.size()), ' ')
                << printable(finding.found) << "\n";
      if (!finding.fine) std::cout << "        -> " << finding.to_do << "\n";
    }
    std::cout << std::flush;
  }
};

}  // namespace

std::unique_ptr<Command> makeDoctorCommand() { return std::make_unique<DoctorCommand>(); }

}  // namespace softscope
