// python/arrays.h: conversion of NumPy arrays, dictionaries and callbacks.
#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "softscope/softscope.h"

namespace softscope::python {

namespace py = pybind11;
using namespace py::literals;
using Bytes = py::array_t<std::uint8_t, py::array::c_style>;
using Released = py::call_guard<py::gil_scoped_release>;

/// Memory of a contiguous array; else a copy, which `array` then holds.
inline api::ImageView viewOf(const Bytes& array, const char* what) {
  if (array.size() == 0) return {};
  const bool grey = array.ndim() == 2;
  if (!grey && array.ndim() != 3)
    throw InputError(std::string(what) + ": has " + std::to_string(array.ndim()) +
                     " dimensions; give height x width or height x width x 3, uint8");
  return {array.data(), static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
          grey ? 1 : static_cast<int>(array.shape(2))};
}

/// Array over memory kept alive by `owner`.
template <class Value>
py::array_t<Value> arrayOver(const std::vector<Value>& values, std::vector<py::ssize_t> shape,
                             const py::object& owner) {
  return py::array_t<Value>(std::move(shape), values.data(), owner);
}

inline std::optional<py::array_t<std::uint8_t>> arrayOf(const api::Image& image,
                                                        const py::object& owner) {
  if (image.values.empty()) return std::nullopt;
  std::vector<py::ssize_t> shape{image.height_px, image.width_px};
  if (image.channels > 1) shape.push_back(image.channels);
  return arrayOver(image.values, shape, owner);
}

inline py::array_t<double> poseArray(const api::Pose& pose) {
  return py::array_t<double>({4, 4}, pose.data());
}

inline py::array_t<double> poseArrays(const std::vector<api::Pose>& poses) {
  py::array_t<double> all({static_cast<py::ssize_t>(poses.size()), py::ssize_t(4), py::ssize_t(4)});
  for (std::size_t i = 0; i < poses.size(); ++i)
    std::copy(poses[i].begin(), poses[i].end(), all.mutable_data() + 16 * i);
  return all;
}

inline api::FrameView frameOf(const Bytes& left, const Bytes& right,
                              const std::optional<Bytes>& mask) {
  api::FrameView frame;
  frame.left = viewOf(left, "left");
  frame.right = viewOf(right, "right");
  if (mask) frame.mask = viewOf(*mask, "mask");
  return frame;
}

/// True, 3 and "sgbm" in the syntax of a settings file.
inline std::string settingText(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return py::str(value);
}

/// "stereo.method" from the keyword stereo_method. An unknown keyword keeps
/// its first word, so that the error of the library contains the nearest key.
inline std::string keyOf(const std::string& keyword,
                         const std::vector<api::SettingDescription>& known) {
  for (const api::SettingDescription& setting : known) {
    std::string as_keyword = setting.key;
    std::replace(as_keyword.begin(), as_keyword.end(), '.', '_');
    if (as_keyword == keyword) return setting.key;
  }
  std::string key = keyword;
  if (const std::size_t end = key.find('_'); end != std::string::npos) key[end] = '.';
  return key;
}

/// Settings by key and by keyword.
inline std::map<std::string, std::string> settingTexts(
    const py::dict& settings, const py::kwargs& keywords,
    const std::vector<api::SettingDescription>& known) {
  std::map<std::string, std::string> texts;
  for (const auto& [key, value] : settings) texts[py::str(key)] = settingText(value);
  for (const auto& [keyword, value] : keywords) {
    const std::string key = keyOf(py::str(keyword), known);
    if (!texts.emplace(key, settingText(value)).second)
      throw OptionError(key + ": given in settings and as a keyword; give it once");
  }
  return texts;
}

inline api::Options optionsOf(const std::map<std::string, std::string>& texts) {
  api::Options options;
  for (const auto& [key, value] : texts) options.set(key, value);
  return options;
}

/// Options of a reconstruction, and of its sequence.
inline api::Options reconstructionOptionsOf(const py::dict& settings, const py::kwargs& keywords) {
  return optionsOf(settingTexts(settings, keywords, api::reconstructionSettings()));
}

/// Acquires the lock of Python between two parts of long work, for `progress` and for Ctrl-C.
/// Copies of the callback hold no reference (that needs the lock): `progress` must outlive them.
inline std::function<bool(int, int)> progressOf(const std::optional<py::function>& progress) {
  return [&progress](int done, int total) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress) return true;
    const py::object answer = (*progress)(done, total);
    return answer.is_none() || answer.cast<bool>();
  };
}

}  // namespace softscope::python
