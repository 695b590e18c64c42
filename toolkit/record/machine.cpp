// toolkit/record/machine.cpp: facts from the files of Linux.
#include "toolkit/record/machine.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace softscope {
namespace {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return {};
}

int usableCores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return CPU_COUNT(&cores);
  return int(sysconf(_SC_NPROCESSORS_ONLN));
}

std::uint64_t usableMemory() {
  const auto machine = std::uint64_t(std::max(0L, sysconf(_SC_PHYS_PAGES))) *
                       std::uint64_t(std::max(0L, sysconf(_SC_PAGE_SIZE)));
  std::ifstream limit("/sys/fs/cgroup/memory.max");
  std::uint64_t container = 0;
  if (limit >> container && container > 0) return std::min(machine, container);
  return machine;
}

std::vector<std::pair<std::string, bool>> instructionSets() {
#if defined(__x86_64__) || defined(__i386__)
  return {{"SSE4.1", __builtin_cpu_supports("sse4.1") != 0},
          {"AVX2", __builtin_cpu_supports("avx2") != 0},
          {"FMA", __builtin_cpu_supports("fma") != 0},
          {"AVX-512", __builtin_cpu_supports("avx512f") != 0}};
#else
  return {};
#endif
}

}  // namespace

Machine describeMachine() {
  return {processorName(), instructionSets(), usableCores(), usableMemory()};
}

}  // namespace softscope
