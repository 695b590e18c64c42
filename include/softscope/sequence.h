// include/softscope/sequence.h: reader of a stereo sequence.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softscope/calibration.h"
#include "softscope/frame.h"
#include "softscope/options.h"

namespace softscope::api {

/// Frames are read once, ahead by a thread. For one consumer thread.
class Sequence {
 public:
  /// Folder with left/ and right/ images or videos and a calibration. `options` may also contain
  /// those of the Reconstructor. Throws InputError.
  explicit Sequence(const std::string& folder, const Options& options = {});
  /// Two image folders or videos with their calibration file. Throws InputError.
  Sequence(const std::string& left, const std::string& right, const std::string& calibration,
           const Options& options = {});
  ~Sequence();
  Sequence(Sequence&&) noexcept;
  Sequence& operator=(Sequence&&) noexcept;

  Calibration calibration() const;
  int frameCount() const;
  /// Of the calibration, and an estimated time offset between the views.
  std::vector<std::string> warnings() const;
  /// None after the last frame.
  std::optional<Frame> next();

 private:
  friend class Reconstructor;
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace softscope::api
