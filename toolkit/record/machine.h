// toolkit/record/machine.h: facts about the computer.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace softscope {

struct Machine {
  std::string processor;                                       // "AMD EPYC", as the system says
  std::vector<std::pair<std::string, bool>> instruction_sets;  // "AVX2", there or not; x86 only
  int cores = 0;                                               // that this process may use
  std::uint64_t memory_bytes = 0;  // of the machine, or of its container if that has less
};

/// Never throws; what the system doesn't say stays empty or 0.
Machine describeMachine();

}  // namespace softscope
