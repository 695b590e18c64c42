// tests/fuzz/calibration_fuzz.cpp: every form of calibration, of one file and of several.
#include <cmath>
#include <vector>

#include "fuzz/fuzz_target.h"
#include "io/calibrations/calibration_check.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_reader.h"
#include "io/calibrations/calibration_writer.h"

namespace softscope::test {
namespace {

// Parts of a form of several files are kept in one input, with this byte between them.
constexpr char kSeparator = '\x1E';

std::vector<NamedText> partsOf(std::string_view text) {
  std::vector<NamedText> parts;
  while (true) {
    const std::size_t end = text.find(kSeparator);
    parts.push_back({"part", text.substr(0, end)});
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// A calibration that was accepted is an endoscope's, and can be written and read again.
void mustBeSound(const StereoCalibration& found) noexcept {
  mustHold(found.left.pinhole.fx_px > 0 && found.right.pinhole.fy_px > 0);
  mustHold(found.baseline_mm() > 0.1 && found.baseline_mm() < 100);
  for (const double k : found.left.distortion.coefficients) mustHold(std::isfinite(k));
  const StereoCalibration again = parseCalibration(calibrationYaml(found), "again");
  mustHold(again.left.pinhole.matrix() == found.left.pinhole.matrix());
}

std::vector<Document> documentsOf(const std::vector<NamedText>& parts) {
  std::vector<Document> out;
  for (const NamedText& part : parts) out.push_back(parseDocument(part.text, part.name));
  return out;
}

void readParts(const std::vector<NamedText>& parts) {
  if (parts.size() == 2) {
    answerOf([&] { return draftFromOpenCv(documentsOf(parts), "two"); });
    for (const bool rectified : {false, true})
      answerOf([&] {
        const auto both = documentsOf(parts);
        return draftFromRos(both[0], both[1], "two", rectified);
      });
  } else if (parts.size() == 3) {
    answerOf([&] { return draftFromHamlyn(HamlynFiles{parts[0], parts[1], parts[2]}); });
  } else if (parts.size() == 5) {
    answerOf([&] {
      return draftFromOpenCas(OpenCasFiles{parts[0], parts[1], parts[2], parts[3], parts[4]});
    });
  }
}

}  // namespace
}  // namespace softscope::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view text = textOf(data, size);
  CalibrationHints hints;
  hints.baseline_mm = 4.3;
  for (const CalibrationHints& given : {CalibrationHints{}, hints})
    if (const auto found = answerOf([&] { return parseCalibration(text, "fuzz", given); }))
      mustBeSound(*found);
  readParts(partsOf(text));
  return 0;
}
