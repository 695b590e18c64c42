// src/core/error.h: exceptions, one type per kind of failure.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace softscope {

/// Any failure that softscope reports: where, what was found, what was expected, what to do; names
/// settings as a program gives them (`save_every=`). Libraries throw, only apps print and exit.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A wrong option, argument or settings key (exit code 2).
class OptionError : public Error {
 public:
  using Error::Error;
};

/// A file or folder that is missing, broken or implausible (exit code 3).
class InputError : public Error {
 public:
  using Error::Error;
};

/// A back end or renderer that this build or machine lacks (exit code 4).
class BackendError : public Error {
 public:
  using Error::Error;
};

/// Throws OptionError naming the field, its value and the rule it breaks.
template <class Value>
void require(bool holds, const std::string& field, const Value& value, const std::string& rule) {
  if (holds) return;
  std::ostringstream text;
  text << field << " is " << value << ", but " << rule;
  throw OptionError(text.str());
}

}  // namespace softscope
