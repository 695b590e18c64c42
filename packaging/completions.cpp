#include "packaging/completions.h"

namespace softscope {
namespace {

const char* const kOrigin = "made from the program's list of commands and options.\n";

/// A word in single quotes, for every shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text)
    out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return out + "'";
}

/// Names of the options with values of this kind, each followed by a space.
std::string optionsOf(const ListedCommand& listed, ValueKind kind) {
  std::string names;
  for (const Argument& a : listed.arguments.all())
    if (!a.isPositional() && valueKind(a) == kind) names += a.name + " ";
  return names;
}

std::string allOptions(const ListedCommand& listed) {
  std::string names;
  for (const Argument& a : listed.arguments.all())
    if (!a.isPositional()) names += a.name + " ";
  return names + "--help";
}

std::string commandNames(const std::vector<ListedCommand>& commands) {
  std::string names;
  for (const ListedCommand& listed : commands) names += listed.command->name() + " ";
  return names;
}

std::string joined(const std::vector<std::string>& words, const std::string& ending) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word + ending;
  return all;
}

bool isRepeatable(const Argument& argument) {
  return std::holds_alternative<std::vector<std::string>*>(argument.target);
}

/// Help inside the brackets of zsh's _arguments.
std::string zshHelp(const std::string& help) {
  std::string out;
  for (const char letter : help) {
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') out += '\\';
    out += letter;
  }
  return out;
}

std::string zshAction(ValueKind kind) {
  switch (kind) {
    case ValueKind::kFile:
      return "_files";
    case ValueKind::kFolder:
      return "_files -/";
    case ValueKind::kSetting:
      return "_softscope_settings";
    default:
      return " ";
  }
}

std::string zshArgument(const Argument& a) {
  const ValueKind kind = valueKind(a);
  const std::string action = ":" + zshHelp(a.value_name) + ":" + zshAction(kind);
  if (a.isPositional())
    return quoted((a.isPositionalList() ? "*" : a.required ? "" : ":") + action);
  std::string text = (isRepeatable(a) ? "*" : "") + a.name + "[" + zshHelp(a.help) + "]";
  return quoted(kind == ValueKind::kNone ? text : text + action);
}

std::string fishValue(ValueKind kind, const std::vector<std::string>& setting_keys) {
  switch (kind) {
    case ValueKind::kFile:
      return " -r -F";
    case ValueKind::kFolder:
      return " -x -a '(__fish_complete_directories)'";
    case ValueKind::kSetting:
      return " -x -a '" + joined(setting_keys, "=") + "'";
    case ValueKind::kWord:
      return " -x";
    default:
      return "";
  }
}

}  // namespace

std::string bashCompletion(const std::vector<ListedCommand>& commands) {
  std::string text = std::string("# Completion of softscope for bash; ") + kOrigin +
                     R"(_softscope() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local options folders words settings keys
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W ')" +
                     commandNames(commands) + R"(help --help --version' -- "$word")
    return
  fi
  case ${COMP_WORDS[1]} in
)";
  for (const ListedCommand& listed : commands)
    text += "    " + listed.command->name() + ")\n      options=" + quoted(allOptions(listed)) +
            "\n      folders=" + quoted(optionsOf(listed, ValueKind::kFolder)) +
            "\n      words=" + quoted(optionsOf(listed, ValueKind::kWord)) +
            "\n      settings=" + quoted(optionsOf(listed, ValueKind::kSetting)) +
            "\n      keys=" + quoted(joined(listed.setting_keys, "=")) + "\n      ;;\n";
  return text + "    help)\n      options=" + quoted(commandNames(commands)) + R"(
      ;;
  esac
  if [[ " $words" == *" $before "* ]]; then return; fi
  if [[ " $settings" == *" $before "* ]]; then
    compopt -o nospace
    mapfile -t COMPREPLY < <(compgen -W "$keys" -- "$word")
  elif [[ " $folders" == *" $before "* ]]; then
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
  elif [[ $word == -* || ${COMP_WORDS[1]} == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -F _softscope softscope
)";
}

std::string zshCompletion(const std::vector<ListedCommand>& commands) {
  std::string text = std::string("#compdef softscope\n# Completion of softscope for zsh; ") +
                     kOrigin +
                     "_softscope_settings() {\n  compadd -S '' -- $setting_keys\n}\n"
                     "_softscope() {\n  local -a setting_keys commands=(\n";
  for (const ListedCommand& listed : commands)
    text += "    " + quoted(listed.command->name() + ":" + listed.command->summary()) + "\n";
  text += R"(  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
)";
  for (const ListedCommand& listed : commands) {
    text += "    " + listed.command->name() + ")\n      setting_keys=(" +
            joined(listed.setting_keys, "=") + ")\n      _arguments";
    for (const Argument& a : listed.arguments.all()) text += " \\\n        " + zshArgument(a);
    text += " \\\n        '--help[these options]'\n      ;;\n";
  }
  return text +
         "    help)\n      _describe command commands\n      ;;\n  esac\n}\n_softscope \"$@\"\n";
}

std::string fishCompletion(const std::vector<ListedCommand>& commands) {
  std::string text = std::string("# Completion of softscope for fish; ") + kOrigin +
                     "complete -c softscope -n __fish_use_subcommand -f\n"
                     "complete -c softscope -n __fish_use_subcommand -l version -s V "
                     "-d 'the version'\n"
                     "complete -c softscope -l help -d 'commands, or options of a command'\n";
  for (const ListedCommand& listed : commands) {
    text += "complete -c softscope -n __fish_use_subcommand -a " + listed.command->name() + " -d " +
            quoted(listed.command->summary()) + "\n";
    for (const Argument& a : listed.arguments.all())
      if (!a.isPositional())
        text += "complete -c softscope -n '__fish_seen_subcommand_from " + listed.command->name() +
                "' -l " + a.name.substr(2) + fishValue(valueKind(a), listed.setting_keys) + " -d " +
                quoted(a.help) + "\n";
  }
  return text;
}

}  // namespace softscope
