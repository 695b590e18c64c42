// apps/common_options.cpp: common help texts.
#include "apps/common_options.h"

#include "core/error.h"

namespace softscope {

void CommonOptions::declare(ArgumentList& arguments) {
  arguments.flag("--json", json, "print the result on stdout as JSON");
  arguments.flag("--quiet", quiet, "only warnings and errors on stderr, no progress bar");
  arguments.flag("--verbose", verbose, "more messages on stderr");
  arguments.option("--color", "WHEN", color,
                   "auto (the default: on a terminal, unless NO_COLOR is set), always or never");
  arguments.option("--threads", "N", threads, "number of threads (0: every core, the default)");
}

void CommonOptions::validate() const {
  require(threads >= 0 && threads <= 1024, "--threads", threads, "must be 0 (every core) to 1024");
  require(color == "auto" || color == "always" || color == "never", "--color", color,
          "must be auto, always or never");
  if (quiet && verbose) throw OptionError("--quiet and --verbose exclude each other; give one");
}

void SettingsArguments::declare(ArgumentList& arguments) {
  arguments.option("--config", "FILE", config_file, "settings file (TOML)");
  arguments.option(
      "--set", "KEY=VALUE", assignments,
      "one of `softscope settings`, e.g. stereo.method=sgbm; overrides --config; repeatable");
}

Settings SettingsArguments::read() const {
  Settings settings;
  if (!config_file.empty()) settings = readSettings(config_file);
  for (const std::string& assignment : assignments) addAssignment(settings, assignment);
  return settings;
}

}  // namespace softscope
