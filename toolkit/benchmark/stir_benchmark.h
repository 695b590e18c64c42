// toolkit/benchmark/stir_benchmark.h: STIR 2026: clips to predictions, predictions to the table.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolkit/benchmark/stir_scores.h"
#include "toolkit/progress.h"

namespace softscope {

struct StirBenchmarkOptions {
  std::filesystem::path data;  // one clip, or a folder of clips
  std::filesystem::path out;
  std::vector<std::string> settings;  // KEY=VALUE for `reconstruct`
  bool force = false;                 // do clips again that are done
};

/// The clips' folders in natural order, by the names that preds.json uses. Throws InputError where
/// there is none.
std::vector<std::filesystem::path> findStirClips(const std::filesystem::path& data);

/// Runs `reconstruct` on each clip (with `run_softscope`: words, log file; its exit code), then
/// writes OUT/preds.json, OUT/benchmark.json. Clips whose run is complete are not run again. A clip
/// that fails is excluded and named; all that fail: InputError.
StirBenchmarkResult benchmarkStir(
    const StirBenchmarkOptions& options,
    const std::function<int(const std::vector<std::string>&, const std::filesystem::path&)>&
        run_softscope,
    const Progress& progress = {});

}  // namespace softscope
