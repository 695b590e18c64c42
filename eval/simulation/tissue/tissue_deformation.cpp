// eval/simulation/tissue/tissue_deformation.cpp: closed
// forms of time, so every frame can be computed separately.
#include "eval/simulation/tissue/tissue_deformation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/simulation/noise/noise.h"
#include "eval/simulation/noise/random.h"
#include "eval/simulation/tissue/tissue_settings.h"

namespace softscope {
namespace {

constexpr float kBreathingWave_mm = 45;  // wavelength of breathing
constexpr float kHeartReach_mm = 14;
constexpr double kPushReach = 2.2;      // pushes are within this many spreads of the focus
constexpr std::size_t kStatesKept = 5;  // cache for small steps back in time
constexpr int kPushPeriods = 3;         // one for the push, two for the release

float gaussian(float distance2, float spread) {
  return static_cast<float>(std::exp(-0.5 * distance2 / (spread * spread)));
}

double breathAt(double time_s, const PeriodicMotion& motion) {
  return 0.5 - 0.5 * std::cos(2 * M_PI * time_s / motion.period_s);
}

/// Quick contraction in the first two fifths of the period.
double beatAt(double time_s, const PeriodicMotion& motion) {
  const double phase = time_s / motion.period_s - std::floor(time_s / motion.period_s);
  if (phase >= 0.4) return 0;
  const double wave = std::sin(M_PI * phase / 0.4);
  return wave * wave;
}

double pushAt(double age_periods) {
  if (age_periods <= 1) return smoothStep(0, 1, static_cast<float>(age_periods));
  return 1 - smoothStep(1, kPushPeriods, static_cast<float>(age_periods));
}

}  // namespace

void DeformationOptions::validate() const {
  requireAllowed(*this);
  require(push_spread_mm >= 2 * push.amplitude_mm, "push.spread_mm", push_spread_mm,
          "must be twice push.amplitude_mm or more, else the surface folds over");
}

TissueDeformation::TissueDeformation(const TriangleMesh& rest_mesh, const Eigen::Vector3f& focus_mm,
                                     const DeformationOptions& options, std::uint64_t seed)
    : options_(options), seed_(mixBits(seed)), rest_mm_(rest_mesh.vertices_mm) {
  options.validate();
  Eigen::Vector3f middle_mm = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : rest_mm_) middle_mm += p / float(rest_mm_.size());
  SeededRandom random(seed_);
  const Eigen::Vector3f main = random.direction().cast<float>();
  const auto noise_seed = static_cast<std::uint32_t>(seed_);
  const float reach2 = static_cast<float>(std::pow(kPushReach * options.push_spread_mm, 2));
  for (std::size_t i = 0; i < rest_mm_.size(); ++i) {
    const Eigen::Vector3f& p = rest_mm_[i];
    const float distance2 = (p - focus_mm).squaredNorm();
    breathing_mm_.push_back(float(options.breathing.amplitude_mm) *
                            (0.6F * main + 0.9F * vectorNoise(p / kBreathingWave_mm, noise_seed)));
    heartbeat_mm_.push_back(float(options.heartbeat.amplitude_mm) *
                            gaussian(distance2, kHeartReach_mm) * (middle_mm - p).normalized());
    if (distance2 < reach2) push_sites_.push_back(static_cast<std::int32_t>(i));
  }
  if (push_sites_.empty()) push_sites_.push_back(0);  // mesh coarser than the reach
  if (options.push_kind == "arap" && options.push.amplitude_mm > 0)
    arap_ = std::make_unique<ArapPushes>(rest_mesh, options.push_spread_mm);
}

TissueDeformation::Push TissueDeformation::pushNumber(int number) const {
  SeededRandom random(seed_ + 1 + static_cast<std::uint64_t>(number));
  const std::int32_t vertex = push_sites_[random.below(static_cast<int>(push_sites_.size()))];
  const double size_mm = options_.push.amplitude_mm * random.uniform(0.8, 1.2);
  return {vertex, rest_mm_[vertex], (size_mm * random.direction()).cast<float>()};
}

std::vector<TissueDeformation::Push> TissueDeformation::pushesAt(double time_s) const {
  std::vector<Push> active;
  if (options_.push.amplitude_mm == 0 || arap_) return active;
  const double periods = time_s / options_.push.period_s;
  const int newest = static_cast<int>(std::floor(periods));
  for (int number = std::max(0, newest - kPushPeriods + 1); number <= newest; ++number) {
    active.push_back(pushNumber(number));
    active.back().shift_mm *= static_cast<float>(pushAt(periods - number));
  }
  return active;
}

/// Valid until the second next call.
const std::vector<Eigen::Vector3f>& TissueDeformation::stateAfter(int pushes) {
  if (states_.empty() || pushes < oldest_) {
    oldest_ = 0;
    states_.assign(1, rest_mm_);
  }
  for (int done = oldest_ + static_cast<int>(states_.size()) - 1; done < pushes; ++done) {
    const Push next = pushNumber(done);
    states_.push_back(arap_->push(states_.back(), next.vertex, next.shift_mm.cast<double>()));
    if (states_.size() <= kStatesKept) continue;
    states_.pop_front();
    ++oldest_;
  }
  return states_[static_cast<std::size_t>(pushes - oldest_)];
}

std::vector<Eigen::Vector3f> TissueDeformation::restingAt(double time_s) {
  if (!arap_) return rest_mm_;
  const double periods = time_s / options_.push.period_s;
  const int number = static_cast<int>(std::floor(periods));
  const std::vector<Eigen::Vector3f>& before_mm = stateAfter(number);
  const float share = smoothStep(0, 1, static_cast<float>(periods - number));
  if (share == 0) return before_mm;
  const std::vector<Eigen::Vector3f>& after_mm = stateAfter(number + 1);
  std::vector<Eigen::Vector3f> now(rest_mm_.size());
  for (std::size_t i = 0; i < now.size(); ++i)
    now[i] = before_mm[i] + share * (after_mm[i] - before_mm[i]);
  return now;
}

std::vector<Eigen::Vector3f> TissueDeformation::verticesAt(double time_s) {
  const auto breath = static_cast<float>(breathAt(time_s, options_.breathing));
  const auto beat = static_cast<float>(beatAt(time_s, options_.heartbeat));
  const auto spread_mm = static_cast<float>(options_.push_spread_mm);
  const std::vector<Push> pushes = pushesAt(time_s);
  std::vector<Eigen::Vector3f> moved = restingAt(time_s);
  parallelRanges(static_cast<int>(moved.size()), 2048, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      moved[i] += breath * breathing_mm_[i] + beat * heartbeat_mm_[i];
      for (const Push& push : pushes)
        moved[i] += gaussian((rest_mm_[i] - push.site_mm).squaredNorm(), spread_mm) * push.shift_mm;
    }
  });
  return moved;
}

}  // namespace softscope
