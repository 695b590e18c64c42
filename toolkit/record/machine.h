// toolkit/record/machine.h: facts about the computer.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace softscope {

struct Machine {
  std::string processor;                                       // "AMD EPYC", by the system
  std::vector<std::pair<std::string, bool>> instruction_sets;  // "AVX2", available or not; x86 only
  int cores = 0;                                               // available to this process
  std::uint64_t memory_bytes = 0;  // of the machine, or of its container if smaller
};

/// Never throws; unknown values remain empty or 0.
Machine describeMachine();

}  // namespace softscope
