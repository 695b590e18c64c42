// tests/apps/run_softscope.cpp: runs, waits, collects; makes small sequences.
#include "tests/apps/run_softscope.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "io/calibrations/calibration_writer.h"
#include "io/images/image_writer.h"
#include "support/scene.h"
#include "tests/apps/forked_program.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

int spawn(const std::vector<std::string>& arguments, const std::string& out,
          const std::string& err) {
  std::string line = "env -u DISPLAY " + quoted(executable());
  for (const std::string& argument : arguments) line += " " + quoted(argument);
  return std::system((line + " >" + quoted(out) + " 2>" + quoted(err)).c_str());
}

ColourImage tinted(const GrayImage& gray) {
  ColourImage colour(gray.width_px, gray.height_px);
  for (std::size_t i = 0; i < gray.size(); ++i) {
    const std::uint8_t value = gray.values[i];
    colour.values[i] = {value, std::uint8_t(value / 2), std::uint8_t(value / 3)};
  }
  return colour;
}

}  // namespace

std::string executable() { return SOFTSCOPE_EXECUTABLE; }

Outcome run(const std::vector<std::string>& arguments) {
  static int count = 0;
  const fs::path base = fs::temp_directory_path() / ("softscope_run_" + std::to_string(getpid()) +
                                                     "_" + std::to_string(count++));
  const std::string out = base.string() + ".out", err = base.string() + ".err";
  const bool runs_itself =  // by its own file
      !arguments.empty() && (arguments[0] == "study" || arguments[0] == "benchmark");
  const int status = runs_itself ? spawn(arguments, out, err) : runForked(arguments, out, err);
  const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(out), textOf(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

RectifiedRig sequenceRig() { return endoscope(160, 120); }

std::string InFolder::makeSequence(const std::string& name, int frames) const {
  const RectifiedRig rig = sequenceRig();
  const Scene scene = makeScene(rig, plane(50, 0.2, 0.1));
  StereoCalibration calibration;
  calibration.left.pinhole = calibration.right.pinhole = rig.left;
  calibration.right_from_left.translation().x() = -rig.baseline_mm;
  calibration.rectified = true;
  fs::create_directories(folder / name / "left");
  fs::create_directories(folder / name / "right");
  writeCalibration(folder / name / "calibration.yaml", calibration);
  for (int i = 0; i < frames; ++i) {
    const std::string file = "00000" + std::to_string(i) + ".png";
    writePng(folder / name / "left" / file, tinted(scene.left));
    writePng(folder / name / "right" / file, tinted(scene.right));
  }
  return at(name);
}

int InFolder::countFiles(const std::string& path) {
  if (!fs::exists(path)) return 0;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(path)) count += !entry.is_directory();
  return count;
}

}  // namespace softscope::test
