// apps/main.cpp: main().
#include "apps/program.h"
#include "core/freed_memory.h"

int main(int argc, char** argv) {
  softscope::keepFreedMemory();
  return softscope::runProgram(std::vector<std::string>(argv + 1, argv + argc));
}
