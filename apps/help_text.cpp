// apps/help_text.cpp: usage, arguments and example.
#include "apps/help_text.h"

#include <algorithm>
#include <sstream>

#include "toolkit/record/version.h"

namespace softscope {
namespace {

constexpr std::size_t kHelpColumn = 26;

/// "  --out DIR              help"; for a long left side the help begins on the next line.
std::string entry(const std::string& left, const std::string& help) {
  std::string line = "  " + left;
  if (line.size() + 2 > kHelpColumn) line += "\n";
  const std::size_t last_line = line.size() - std::min(line.size(), line.rfind('\n') + 1);
  if (line.find('\n') == std::string::npos)
    line.append(kHelpColumn - line.size(), ' ');
  else
    line.append(kHelpColumn - last_line, ' ');
  return line + help + "\n";
}

std::string usage(const Command& command, const ArgumentList& arguments) {
  std::string line = "usage: softscope " + command.name();
  for (const Argument& a : arguments.all())
    if (a.isPositional()) line += a.required ? " " + a.value_name : " [" + a.name + "]";
  for (const Argument& a : arguments.all())
    if (!a.isPositional() && a.required) line += " " + a.name + " " + a.value_name;
  return line + " [options]\n";
}

}  // namespace

std::string overviewText(const std::vector<std::unique_ptr<Command>>& commands) {
  std::string text = "softscope " + versionText() +
                     ": dense 3-D models of soft tissue from stereo endoscopes.\n"
                     "Research use only, not for diagnosis.\n\n"
                     "usage: softscope <command> [options]\n\n";
  for (const auto& command : commands) text += entry(command->name(), command->summary());
  text += "\n";
  text += entry("--help", "this text; `softscope <command> --help` lists the options of a command");
  text += entry("--version, -V", "the version");
  text += "\nexample:\n  softscope doctor\n";
  return text;
}

std::string helpText(const Command& command, const ArgumentList& arguments) {
  std::ostringstream text;
  text << "softscope " << command.name() << ": " << command.summary() << "\n\n"
       << usage(command, arguments) << "\n";
  if (!command.details().empty()) text << command.details() << "\n\n";
  for (const Argument& a : arguments.all())
    if (a.isPositional()) text << entry(a.name, a.help);
  for (const Argument& a : arguments.all())
    if (!a.isPositional())
      text << entry(a.value_name.empty() ? a.name : a.name + " " + a.value_name, a.help);
  text << entry("--help", "this text") << "\nexample:\n  " << command.example() << "\n";
  return text.str();
}

}  // namespace softscope
