#include "apps/option_names.h"

#include <algorithm>
#include <map>

#include "apps/command.h"

namespace softscope {
namespace {

// Settings with shorter option names.
const std::map<std::string, std::string> kShorter{
    {"dots_per_inch", "--dpi"},     {"frames_per_second", "--fps"},
    {"turn_deg", "--turn"},         {"each_model", "--each"},
    {"map_kind", "--map"},          {"names", "--name"},
    {"overwrite", "--force"},       {"observed_only", "--observed"},
    {"planes", "--plane"},          {"scans", "--scan"},
    {"surfaces", "--surface"},      {"taus_mm", "--tau"},
    {"lens_coefficients", "--lens"}};

std::map<std::string, std::string> optionsOfSettings() {
  std::map<std::string, std::string> options = kShorter;
  for (const auto& command : allCommands()) {
    ArgumentList arguments;
    command->declare(arguments);
    command->common.declare(arguments);
    for (const Argument& argument : arguments.all()) {
      if (argument.isPositional()) continue;
      std::string setting = argument.name.substr(2);
      std::replace(setting.begin(), setting.end(), '-', '_');
      options.emplace(setting, argument.name);
    }
  }
  return options;
}

}  // namespace

std::string withOptions(const std::string& message) {
  static const std::map<std::string, std::string> options = optionsOfSettings();
  std::string out;
  std::size_t at = 0;
  for (std::size_t begin; (begin = message.find('`', at)) != std::string::npos;) {
    out.append(message, at, begin - at);
    const std::size_t end = message.find("=`", begin + 1);
    const auto option = end == std::string::npos
                            ? options.end()
                            : options.find(message.substr(begin + 1, end - begin - 1));
    out += option == options.end() ? "`" : option->second;
    at = option == options.end() ? begin + 1 : end + 2;
  }
  return out + message.substr(at);
}

}  // namespace softscope
