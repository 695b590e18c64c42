// apps/main.cpp: main().
#include "apps/program.h"

int main(int argc, char** argv) {
  return softscope::runProgram(std::vector<std::string>(argv + 1, argv + argc));
}
