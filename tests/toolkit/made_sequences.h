// tests/toolkit/made_sequences.h: simulated clips and their reconstruction, as functions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/settings/settings.h"
#include "toolkit/depth/measure_sequence.h"
#include "toolkit/run/reconstruct_sequence.h"
#include "toolkit/simulation/simulate_sequence.h"

namespace softscope::test {

/// "deform.node_model=rigid" and the like, as --set takes them.
template <class Options>
void set(const std::vector<std::string>& assignments, Options* options) {
  Settings settings;
  for (const std::string& assignment : assignments) addAssignment(settings, assignment);
  settingsOf(*options).apply(settings);
}

/// A sequence folder of small images, whose disparities are below 64 px, and where its run goes.
ReconstructOptions reconstruction(const std::filesystem::path& sequence,
                                  const std::filesystem::path& run);

/// A sequence folder, and where its depth goes.
MeasureOptions measurement(const std::filesystem::path& sequence, const std::filesystem::path& out);

/// A simulated clip of 160 x 120 px in a new folder; `more`: further settings. Without them the
/// beginning of a clip that is simulated once for all tests of the program.
void simulateClip(const std::filesystem::path& folder, int frames,
                  const std::vector<std::string>& more = {});

/// What long work told while it ran.
struct Told {
  std::vector<std::string> warnings, notes, failures;

  WorkListener listener();
};

/// Four frames of writeSequence() and their run, every model of which is saved. Made once for all
/// tests of the program, which must leave both as they are.
struct SlopeRun {
  std::string sequence, run;
  FactSheet::Json record;
};
const SlopeRun& slopeRun();

}  // namespace softscope::test
