// toolkit/run/provenance.cpp: comparison of sizes, lengths and hashes.
#include "toolkit/run/provenance.h"

#include <cmath>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/file_hash.h"
#include "io/sequences/sequence_paths.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/record/record_values.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using Json = FactSheet::Json;

constexpr double kSameLength = 0.01;  // rectification changes a focal length by less

Json readRunRecord(const fs::path& file) {
  const Json record = Json::parse(readBytes(file, kTextLimitBytes), nullptr, false);
  if (!record.is_object())
    throw InputError(shown(file) + ": is no JSON object; is it damaged? Reconstruct again");
  return record;
}

bool differs(double recorded, double expected) {
  return std::isfinite(recorded) && std::abs(recorded - expected) > kSameLength * expected;
}

void requireSameSize(const Json& record, const PinholeCamera& left, const fs::path& file) {
  const double width = numberAt(record, "rectified_rig.width_px");
  const double height = numberAt(record, "rectified_rig.height_px");
  if (std::isnan(width) || std::isnan(height)) return;
  if (width == left.width_px && height == left.height_px) return;
  throw InputError(say(shown(file), ": the run's images have ", width, " x ", height,
                       " pixels, but the sequence's ", left.width_px, " x ", left.height_px,
                       "; a run of another sequence?"));
}

/// Empty if the images are the recorded ones, or either is unknown.
std::string pictureWarning(const Json& record, const SequenceTruth& truth) {
  const std::string recorded = textAt(record, "inputs.left.sha256");
  if (recorded.empty()) return {};
  SequencePaths paths;
  try {
    paths = findSequence(truth.folder);
  } catch (const InputError&) {  // ground truth without images is sufficient
    return {};
  }
  if (paths.left.empty() || sha256Of(paths.left) == recorded) return {};
  return shown(paths.left) + ": the run was made from other images; a run of another sequence?";
}

}  // namespace

std::vector<std::string> checkOrigin(const fs::path& run, const SequenceTruth& truth) {
  const fs::path file = run / "run.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  const Json record = readRunRecord(file);
  requireSameSize(record, truth.rig.left, file);
  std::vector<std::string> warnings;
  const double focal_px = numberAt(record, "rectified_rig.focal_px");
  const double baseline_mm = numberAt(record, "rectified_rig.baseline_mm");
  if (differs(focal_px, truth.rig.left.fx_px) || differs(baseline_mm, truth.rig.baseline_mm))
    warnings.push_back(say("the run was made with a focal length of ", focal_px,
                           " px and a baseline of ", baseline_mm, " mm, but the sequence has ",
                           truth.rig.left.fx_px, " px and ", truth.rig.baseline_mm, " mm"));
  if (const std::string warning = pictureWarning(record, truth); !warning.empty())
    warnings.push_back(warning);
  return warnings;
}

}  // namespace softscope
