// cuda/looks/looks.h: first looks found in an image, on the first GPU.
#pragma once

#include <memory>
#include <vector>

#include "core/image.h"
#include "cuda/device/shared_rasters.h"
#include "features/first_look.h"

namespace softscope::cuda {

/// As findLooks() (features/first_look.h), with the same bytes.
class LookFinder {
 public:
  virtual ~LookFinder() = default;
  /// Numbers stand for other looks than before.
  virtual void forget() = 0;
  /// `rasters`: where image and mask lie on the device; null: they are copied. Throws BackendError
  /// if the device fails.
  virtual std::vector<FoundLook> find(const std::vector<SoughtLook>& sought, const GrayImage& image,
                                      const Mask& ignore, const SharedRasters* rasters) = 0;
};

/// Throws BackendError where no GPU works.
std::unique_ptr<LookFinder> makeLookFinder();

}  // namespace softscope::cuda
