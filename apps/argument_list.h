// apps/argument_list.h: declaration of arguments, independent of the parser.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace softscope {

struct Argument {
  using Target = std::variant<bool*, int*, double*, std::string*, std::vector<std::string>*>;

  std::string name;        // "--out", or "LEFT" for a positional one
  std::string value_name;  // "DIR"; empty for switches
  Target target;           // set by the parser; a list may be given several times
  std::string help;
  bool required = false;

  bool isPositional() const { return name[0] != '-'; }
  /// Receives all words that belong to no option.
  bool isPositionalList() const {
    return isPositional() && std::holds_alternative<std::vector<std::string>*>(target);
  }
};

class ArgumentList {
 public:
  /// A switch: false unless given.
  void flag(const std::string& name, bool& target, const std::string& help) {
    arguments_.push_back({name, "", &target, help, false});
  }
  template <class Value>
  void option(const std::string& name, const std::string& value_name, Value& target,
              const std::string& help, bool required = false) {
    arguments_.push_back({name, value_name, &target, help, required});
  }
  /// In the order of declaration.
  void positional(const std::string& name, std::string& target, const std::string& help,
                  bool required) {
    arguments_.push_back({name, name, &target, help, required});
  }

  /// One or more words that belong to no option.
  void positionals(const std::string& name, std::vector<std::string>& target,
                   const std::string& help) {
    arguments_.push_back({name, name + "...", &target, help, true});
  }

  const std::vector<Argument>& all() const { return arguments_; }

 private:
  std::vector<Argument> arguments_;
};

}  // namespace softscope
