// toolkit/run/ro_crate.h: a run folder described for data repositories.
#pragma once

#include <filesystem>
#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

inline constexpr const char* kRecordFile = "run.json";
inline constexpr const char* kCrateFile = "ro-crate-metadata.json";

/// RO-Crate 1.1 (JSON-LD): the folder, each file that is in it with its form and meaning, the
/// program with its version and the action that made them. `record`: of run.json as it will be
/// written, after this, so that nothing is named here that it leaves out. `date`: ISO 8601, of the
/// run.
FactSheet::Json roCrate(const std::filesystem::path& folder, const FactSheet::Json& record,
                        const std::string& date);

}  // namespace softscope
