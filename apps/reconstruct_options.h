// apps/reconstruct_options.h: the keys of `softscope reconstruct`.
#pragma once

#include <string>

#include "apps/common_options.h"
#include "io/sequence_options.h"
#include "io/settings_binder.h"
#include "pipeline/reconstruction_options.h"

namespace softscope {

/// Of one run.
struct ReconstructOptions {
  ReconstructionOptions method;
  SequenceOptions sequence;
  int random_seed = 1;

  // Choices by name, as settings files have them.
  std::string node_model, edge_weighting, data_loss, correspondence_loss;
  std::string node_trust, illumination;

  /// Of `preset`: default or paper. Throws OptionError on another name.
  explicit ReconstructOptions(const std::string& preset);

  /// Brings the named choices into `method`, then checks all of it. Throws OptionError.
  void resolve();
};

/// Binds every field. The options must outlive the binder.
void bindReconstructOptions(SettingsBinder& binder, ReconstructOptions& options);

}  // namespace softscope
