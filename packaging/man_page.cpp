#include "packaging/man_page.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace softscope {
namespace {

/// One line of text in roff: hyphens can be copied, no request at its beginning.
std::string roff(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '\\')
      out += "\\e";
    else if (letter == '-')
      out += "\\-";
    else
      out += letter;
  }
  return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

/// Several lines that keep their breaks.
std::string asWritten(const std::string& text) {
  std::istringstream lines(text);
  std::string line, out = ".nf\n";
  while (std::getline(lines, line)) out += roff(line) + "\n";
  return out + ".fi\n";
}

std::string head(const std::string& name, const std::string& summary, const std::string& version) {
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return ".TH " + roff(title) + " 1 \"\" \"softscope " + version +
         "\" \"User Commands\"\n.SH NAME\n" + roff(name) + " \\- " + roff(summary) + "\n";
}

std::string entry(const std::string& name, const std::string& value, const std::string& help) {
  std::string line = ".TP\n\\fB" + roff(name) + "\\fR";
  if (!value.empty()) line += " \\fI" + roff(value) + "\\fR";
  return line + "\n" + roff(help) + "\n";
}

std::string synopsis(const ListedCommand& listed) {
  std::string text = ".SH SYNOPSIS\n\\fBsoftscope " + roff(listed.command->name()) + "\\fR";
  for (const Argument& a : listed.arguments.all())
    if (a.isPositional())
      text +=
          a.required ? " \\fI" + roff(a.value_name) + "\\fR" : " [\\fI" + roff(a.name) + "\\fR]";
  for (const Argument& a : listed.arguments.all())
    if (!a.isPositional() && a.required)
      text += " \\fB" + roff(a.name) + "\\fR \\fI" + roff(a.value_name) + "\\fR";
  return text + " [\\fIoptions\\fR]\n";
}

std::string exitStatus() {
  return ".SH EXIT STATUS\n" + entry("0", "", "done") +
         entry("1", "", "a threshold that the command line set failed") +
         entry("2", "", "a wrong option, argument or settings key") +
         entry("3", "", "a file or folder that is missing, broken or implausible") +
         entry("4", "", "a back end or renderer that this machine lacks") +
         entry("70", "", "a fault of softscope") + entry("130", "", "interrupted by Ctrl-C");
}

}  // namespace

std::string overviewPage(const std::vector<ListedCommand>& commands, const std::string& version) {
  std::string text =
      head("softscope", "dense 3-D models of soft tissue from stereo endoscopes", version) +
      ".SH SYNOPSIS\n\\fBsoftscope\\fR \\fIcommand\\fR [\\fIoptions\\fR]\n"
      ".SH DESCRIPTION\nReconstructs soft tissue from stereo endoscope images, judges the result\n"
      "against ground truth, and reports it. Research use only, not for diagnosis.\n"
      ".SH COMMANDS\n";
  for (const ListedCommand& listed : commands)
    text += entry(listed.command->name(), "", listed.command->summary());
  text += ".SH OPTIONS\n" +
          entry("--help", "",
                "the list of commands; or, behind a command, its "
                "options") +
          entry("--version, -V", "", "the version") + exitStatus() + ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < commands.size(); ++i)
    text += ".BR " + roff("softscope-" + commands[i].command->name()) +
            (i + 1 < commands.size() ? " (1),\n" : " (1)\n");
  return text;
}

std::string commandPage(const ListedCommand& listed, const std::string& version) {
  const Command& command = *listed.command;
  std::string text =
      head("softscope-" + command.name(), command.summary(), version) + synopsis(listed);
  if (!command.details().empty()) text += ".SH DESCRIPTION\n" + asWritten(command.details());
  text += ".SH OPTIONS\n";
  for (const bool positional : {true, false})
    for (const Argument& a : listed.arguments.all())
      if (a.isPositional() == positional)
        text += entry(a.name, positional ? "" : a.value_name, a.help);
  return text + entry("--help", "", "these options") + ".SH EXAMPLE\n" +
         asWritten("  " + command.example()) + exitStatus() + ".SH SEE ALSO\n.BR softscope (1)\n";
}

}  // namespace softscope
