// src/core/error.h: exceptions, one type per kind of failure.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace softscope {

/// Failure reported by softscope: where, what was found, what was expected, what to do; settings
/// are named as in the library (`save_every=`). Libraries throw; only apps print and exit.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Wrong option, argument or settings key (exit code 2).
class OptionError : public Error {
 public:
  using Error::Error;
};

/// Missing, damaged or implausible file or folder (exit code 3).
class InputError : public Error {
 public:
  using Error::Error;
};

/// Back end or renderer missing in this build or on this machine (exit code 4).
class BackendError : public Error {
 public:
  using Error::Error;
};

/// Throws OptionError with the field, its value and the violated rule.
template <class Value>
void require(bool holds, const std::string& field, const Value& value, const std::string& rule) {
  if (holds) return;
  std::ostringstream text;
  text << field << " is " << value << ", but " << rule;
  throw OptionError(text.str());
}

}  // namespace softscope
