// apps/command_line.cpp: parsing with CLI11, and own checks.
#include "apps/command_line.h"

#include <CLI/CLI.hpp>

#include "apps/help_text.h"
#include "core/decimal_number.h"
#include "core/error.h"
#include "core/nearest_name.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

[[noreturn]] void fail(const Command& command, const std::string& what) {
  throw OptionError("softscope " + command.name() + ": " + what + ". See `softscope " +
                    command.name() + " --help`");
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = nearestName(word, names);
  return nearest.empty() ? nearest : " (did you mean `" + nearest + "`?)";
}

template <class Number>
Number toNumber(const std::string& name, const std::string& text, const char* kind) {
  const auto value = decimalNumber<Number>(text);
  if (!value || *value != *value)  // nan
    throw OptionError(name + " is `" + text + "`, but must be " + kind);
  return *value;
}

void assign(const Argument& argument, const std::vector<std::string>& values) {
  if (auto* flag = std::get_if<bool*>(&argument.target)) **flag = true;
  if (auto* text = std::get_if<std::string*>(&argument.target)) **text = values.back();
  if (auto* list = std::get_if<std::vector<std::string>*>(&argument.target)) **list = values;
  if (auto* number = std::get_if<int*>(&argument.target))
    **number = toNumber<int>(argument.name, values.back(), "a whole number");
  if (auto* number = std::get_if<double*>(&argument.target))
    **number = toNumber<double>(argument.name, values.back(), "a number");
}

/// Declares every argument as text: numbers are checked with our own messages.
void addTo(CLI::App& app, const ArgumentList& arguments) {
  for (const Argument& argument : arguments.all()) {
    CLI::Option* option = nullptr;
    if (std::holds_alternative<bool*>(argument.target))
      option = app.add_flag(argument.name);
    else
      option = app.add_option(argument.name)->expected(1);
    if (std::holds_alternative<std::vector<std::string>*>(argument.target))
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (argument.isPositionalList()) option->allow_extra_args();
  }
}

void refuseUnknown(const Command& command, const ArgumentList& arguments,
                   const std::vector<std::string>& rest) {
  std::vector<std::string> names{"--help"};
  for (const Argument& a : arguments.all())
    if (!a.isPositional()) names.push_back(a.name);
  for (const std::string& word : rest)
    if (word.size() > 1 && word[0] == '-')
      fail(command, "unknown option `" + word + "`" + didYouMean(word, names));
  if (!rest.empty()) fail(command, "`" + rest[0] + "` is one argument too many");
}

[[noreturn]] void failWithoutValue(const Command& command, const Argument& argument,
                                   const std::string& found) {
  fail(command, argument.name + " has no value" + found + ": " + argument.help);
}

/// CLI11 takes the next word as the value, also if it is an option.
void refuseOptionsAsValues(const Command& command, const ArgumentList& arguments,
                           const CLI::App& app) {
  for (const Argument& argument : arguments.all()) {
    if (std::holds_alternative<bool*>(argument.target)) continue;
    for (const std::string& value : app.get_option(argument.name)->results())
      for (const Argument& other : arguments.all())
        if (!other.isPositional() && value == other.name)
          failWithoutValue(command, argument, ", `" + value + "` follows");
  }
}

/// An empty path would be the current folder, or an error of the system without a name.
void refuseEmptyOutput(const Command& command, const Argument& argument,
                       const std::vector<std::string>& values) {
  if (argument.name != "--out") return;
  for (const std::string& value : values)
    if (value.empty()) fail(command, argument.name + " is empty: " + argument.help);
}

void parseArguments(Command& command, const ArgumentList& arguments,
                    const std::vector<std::string>& words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  addTo(app, arguments);
  try {
    app.parse(
        std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 requires reverse order
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();  // "--board: 1 required  missing"
    for (const Argument& argument : arguments.all())
      if (text.rfind(argument.name + ":", 0) == 0) failWithoutValue(command, argument, "");
    fail(command, text);
  }
  refuseOptionsAsValues(command, arguments, app);
  refuseUnknown(command, arguments, app.remaining());
  for (const Argument& argument : arguments.all()) {
    const CLI::Option* option = app.get_option(argument.name);
    if (option->count() > 0) {
      refuseEmptyOutput(command, argument, option->results());
      assign(argument, option->results());
    } else if (argument.required) {
      fail(command, argument.name + " is missing: " + argument.help);
    }
  }
}

Command& findCommand(const std::string& word,
                     const std::vector<std::unique_ptr<Command>>& commands) {
  std::vector<std::string> names;
  for (const auto& command : commands) {
    if (command->name() == word) return *command;
    names.push_back(command->name());
  }
  const char* kind = word[0] == '-' ? "option" : "command";
  if (word[0] == '-') names = {"--help", "--version"};
  throw OptionError("softscope: unknown " + std::string(kind) + " `" + word + "`" +
                    didYouMean(word, names) + ". See `softscope --help`");
}

bool asksForHelp(const std::string& word) { return word == "--help" || word == "-h"; }

}  // namespace

ParsedLine parseCommandLine(const std::vector<std::string>& words,
                            const std::vector<std::unique_ptr<Command>>& commands) {
  if (words.empty()) throw OptionError("softscope: no command given. See `softscope --help`");
  if (asksForHelp(words[0]) || (words[0] == "help" && words.size() == 1))
    return {nullptr, overviewText(commands)};
  if (words[0] == "--version" || words[0] == "-V")
    return {nullptr, "softscope " + versionText() + "\n"};
  const bool help_word = words[0] == "help";
  Command& command = findCommand(words[help_word ? 1 : 0], commands);
  ArgumentList arguments;
  command.declare(arguments);
  command.common.declare(arguments);
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (help_word || std::any_of(rest.begin(), rest.end(), asksForHelp))
    return {nullptr, helpText(command, arguments)};
  parseArguments(command, arguments, rest);
  command.common.validate();
  command.words = words;
  return {&command, ""};
}

}  // namespace softscope
