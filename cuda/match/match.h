// cuda/match/match.h: matches between the model view and the live image on the GPU.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "features/matcher.h"

namespace softscope::cuda {

/// The dense SURF matcher for one image size; memory is taken once, at the start. The same bytes as
/// the matcher of the CPU gives.
class Matcher : public FeatureMatcher {
 public:
  /// Throws BackendError without a device that runs this build, or with too little memory;
  /// OptionError where an option has no GPU version.
  Matcher(const MatcherOptions& options, int width_px, int height_px);
  ~Matcher() override;
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  std::string name() const override { return "dense-surf"; }
  /// upload(), compute(), download().
  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) override;

  /// Throws InputError for another shape.
  void upload(const MatchPicture& model, const MatchPicture& live);
  /// Returns when everything is enqueued.
  void compute();
  void wait();
  std::vector<PixelMatch> download();

  /// With stage times, kernels are launched one by one and compute() waits; without, as a graph.
  void timeStages(bool on);
  /// Of the last compute() with stage times: stage, ms.
  const std::vector<std::pair<std::string, double>>& stageTimes() const;

  std::size_t deviceBytes() const;

 private:
  class Device;
  std::unique_ptr<Device> device_;
};

}  // namespace softscope::cuda
