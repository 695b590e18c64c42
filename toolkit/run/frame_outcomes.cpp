// toolkit/run/frame_outcomes.cpp: counting, and one letter per frame.
#include "toolkit/run/frame_outcomes.h"

#include <algorithm>

#include "core/not_measured.h"

namespace softscope {
namespace {

constexpr std::size_t kMostLetters = 72;

constexpr FusionOutcome kAll[] = {FusionOutcome::kFused, FusionOutcome::kSkipped,
                                  FusionOutcome::kLost};

char letterOf(FusionOutcome outcome) {
  switch (outcome) {
    case FusionOutcome::kFused:
      return '#';
    case FusionOutcome::kSkipped:
      return 's';
    case FusionOutcome::kLost:
      return 'L';
  }
  return 'L';
}

}  // namespace

FusionOutcome outcomeOf(FrameStatus status) {
  switch (status) {
    case FrameStatus::kStarted:
    case FrameStatus::kFused:
    case FrameStatus::kRecovered:
      return FusionOutcome::kFused;
    case FrameStatus::kLost:
      return FusionOutcome::kLost;
    case FrameStatus::kSkippedDepth:
    case FrameStatus::kSkippedResidual:
    case FrameStatus::kUnconfirmed:
    case FrameStatus::kUnreadable:
    case FrameStatus::kUnpaired:
      return FusionOutcome::kSkipped;
  }
  return FusionOutcome::kSkipped;
}

int FrameOutcomes::count(FusionOutcome outcome) const {
  return static_cast<int>(std::count_if(each_.begin(), each_.end(),
                                        [&](const auto& e) { return e.second == outcome; }));
}

bool FrameOutcomes::fused(int frame) const {
  const auto found = each_.find(frame);
  return found == each_.end() || found->second == FusionOutcome::kFused;
}

FactSheet::Json FrameOutcomes::json() const {
  FactSheet::Json json;
  json["frames"] = empty() ? FactSheet::Json() : FactSheet::Json(count());
  for (const FusionOutcome outcome : kAll)
    json[toString(outcome)] = empty() ? FactSheet::Json() : FactSheet::Json(count(outcome));
  for (const FusionOutcome outcome : kAll)
    json[std::string(toString(outcome)) + "_share"] =
        empty() ? kNotMeasured<double> : static_cast<double>(count(outcome)) / count();
  return json;
}

std::string FrameOutcomes::text() const {
  std::string text = std::to_string(count(FusionOutcome::kFused)) + " of " +
                     std::to_string(count()) + " " + toString(FusionOutcome::kFused);
  for (const FusionOutcome outcome : {FusionOutcome::kSkipped, FusionOutcome::kLost})
    text += ", " + std::to_string(count(outcome)) + " " + toString(outcome);
  return text;
}

std::string FrameOutcomes::strip() const {
  std::vector<FusionOutcome> all;
  for (const auto& [frame, outcome] : each_) all.push_back(outcome);
  const std::size_t letters = std::min(all.size(), kMostLetters);
  std::string strip;
  for (std::size_t i = 0; i < letters; ++i) {
    const auto part = [&](std::size_t k) {
      return all.begin() + static_cast<std::ptrdiff_t>(k * all.size() / letters);
    };
    strip += letterOf(*std::max_element(part(i), part(i + 1)));
  }
  return strip;
}

void addOutcomeFacts(const FrameOutcomes& outcomes, FactSheet& facts) {
  if (outcomes.empty()) return;
  facts.addLine("frames", outcomes.text());
  facts.addLine("  over time", outcomes.strip() + "  # fused, s skipped, L lost");
}

}  // namespace softscope
