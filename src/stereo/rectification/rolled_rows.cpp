#include "stereo/rectification/rolled_rows.h"

#include "stereo/rectification/row_model.h"

namespace softscope {
namespace {

constexpr double kFarthestRoll = 0.175;  // rad: 10°
constexpr double kStepPx = 8;            // between the trials, at the image's sides
constexpr double kAgree = 0.5;           // share of matches: no doubt
constexpr double kManyMoreAgree = 1.5;
constexpr double kFewestAgree = 50;

struct RollTrial {
  RowAlignment found;
  double agreeing = 0;  // matches
};

RollTrial tryRows(RowMeter meter, const GrayImage& right, const RowPlane& rows) {
  const std::vector<RowMatch> matches = meter.match(right, {}, rows);
  const RowAlignment found = fitRowModel(matches, meter.scale(), rows);
  return {found, found.agreeing_share * static_cast<double>(matches.size())};
}

}  // namespace

RowPlane findRolledRows(const RowMeter& meter, const GrayImage& right) {
  const RollTrial level = tryRows(meter, right, {});
  if (level.found.agreeing_share > kAgree) return {};
  RollTrial best = level;
  const double step = kStepPx / meter.scale().half_width_px;
  for (double roll = step; roll < kFarthestRoll + step / 2; roll += step)
    for (const double tilt : {-roll, roll}) {
      const RollTrial trial = tryRows(meter, right, {0, tilt, 0});
      if (trial.agreeing > best.agreeing) best = trial;
    }
  if (best.agreeing < kManyMoreAgree * level.agreeing) return {};
  best = tryRows(meter, right, best.found.plane());
  if (best.agreeing < kFewestAgree || best.found.agreeing_share < kAgree) return {};
  return best.found.plane();
}

}  // namespace softscope
