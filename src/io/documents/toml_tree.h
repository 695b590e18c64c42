// src/io/documents/toml_tree.h: a TOML file whose lists and tables matter, as a tree.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace softscope {

/// Throws InputError where keys or brackets nest deeper than any settings do: the parser, which
/// calls itself for each part of a key, would run out of its stack.
void requireShallowToml(std::string_view toml, const std::string& name);

/// What the parser says of the place where it stopped, with the key that it names, in backticks.
std::string tomlComplaint(std::string_view description);

/// Tables become objects, lists arrays; lists keep their order, keys are sorted.
/// Throws InputError where the file is missing or no TOML, OptionError where it holds a date.
nlohmann::ordered_json readTomlTree(const std::filesystem::path& file);
nlohmann::ordered_json parseTomlTree(std::string_view toml, const std::string& name);

}  // namespace softscope
