// apps/common_options.h: options with the same meaning in every command.
#pragma once

#include <string>
#include <vector>

#include "apps/argument_list.h"
#include "io/settings/settings.h"

namespace softscope {

/// --json, --quiet, --verbose, --color, --threads.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  std::string color = "auto";  // of warnings and errors: auto, always or never
  int threads = 0;             // 0 = number of cores

  void declare(ArgumentList& arguments);
  /// Throws OptionError.
  void validate() const;
};

/// --config and --set, for commands that compute.
struct SettingsArguments {
  std::string config_file;
  std::vector<std::string> assignments;  // "stereo.method=sgbm"

  void declare(ArgumentList& arguments);
  /// --config, then --set. Throws OptionError or InputError.
  Settings read() const;
};

}  // namespace softscope
