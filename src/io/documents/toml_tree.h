// src/io/documents/toml_tree.h: TOML file as a tree of lists and tables.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace softscope {

/// Throws InputError for too deeply nested keys or
/// brackets: the recursive parser would overflow its stack.
void requireShallowToml(std::string_view toml, const std::string& name);

/// Message of the parser at the error, with its key in backticks.
std::string tomlComplaint(std::string_view description);

/// Tables become objects, lists arrays; lists keep their order, keys are sorted.
/// Throws InputError for a missing file or invalid TOML, OptionError for a date.
nlohmann::ordered_json readTomlTree(const std::filesystem::path& file);
nlohmann::ordered_json parseTomlTree(std::string_view toml, const std::string& name);

}  // namespace softscope
