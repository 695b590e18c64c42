// cuda/match/match.h: matches between the model view and the live image on the GPU.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "features/matcher.h"

namespace softscope::cuda {

/// Dense SURF matcher for one image size; memory is allocated
/// at construction. The same bytes as the matcher of the CPU.
class Matcher : public FeatureMatcher {
 public:
  /// Throws BackendError without a suitable device, or with too
  /// little memory; OptionError for an option without GPU version.
  Matcher(const MatcherOptions& options, int width_px, int height_px);
  ~Matcher() override;
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  std::string name() const override { return MatcherOptions::kDenseSurf; }
  /// upload(), compute(), download().
  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) override;

  /// Throws InputError for another size.
  void upload(const MatchPicture& model, const MatchPicture& live);
  /// Asynchronous.
  void compute();
  void wait();
  std::vector<PixelMatch> download();

  /// With stage times, kernels are launched one by one and compute() waits; otherwise as a graph.
  void timeStages(bool on);
  /// Of the last compute() with stage times: stage, ms.
  const std::vector<std::pair<std::string, double>>& stageTimes() const;

  std::size_t deviceBytes() const;

 private:
  class Device;
  std::unique_ptr<Device> device_;
};

}  // namespace softscope::cuda
