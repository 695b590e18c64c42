// src/io/sequences/timestamps_file.h: timestamps of frames.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Seconds, one per line, ascending; lines that begin with #
/// and empty ones are skipped. Throws InputError with the line.
std::vector<double> readTimestamps(const std::filesystem::path& file);
std::vector<double> parseTimestamps(std::string_view text, const std::string& name);

/// Warning for frames that are many seconds apart, else empty.
std::string timeUnitWarning(const std::vector<double>& times_s);

}  // namespace softscope
