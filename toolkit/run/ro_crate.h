// toolkit/run/ro_crate.h: metadata of a run folder for data repositories.
#pragma once

#include <filesystem>
#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

inline constexpr const char* kRecordFile = "run.json";
inline constexpr const char* kCrateFile = "ro-crate-metadata.json";

/// RO-Crate 1.1 (JSON-LD): the folder, each of its files with
/// format and meaning, the program with its version, and the action
/// that made them. `record`: of run.json, which is written later;
/// no other names are used here. `date`: ISO 8601, of the run.
FactSheet::Json roCrate(const std::filesystem::path& folder, const FactSheet::Json& record,
                        const std::string& date);

}  // namespace softscope
