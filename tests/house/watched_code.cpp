// tests/house/watched_code.cpp: faults that a sanitized build must stop at.
#include <Eigen/Core>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>

namespace {

int overflowOfOwnCode(int by) { return std::numeric_limits<int>::max() + by; }

/// Read by a function of a header of Eigen, which UBSan passes by.
float readBehindTheEnd(int count) {
  const std::unique_ptr<float[]> values(new float[static_cast<std::size_t>(count)]());
  return Eigen::Map<const Eigen::VectorXf>(values.get(), count + 1).sum();
}

/// Asserted by Eigen itself.
float indexBehindTheEnd(int count) { return Eigen::VectorXf::Zero(count).eval()[count]; }

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGABRT, [](int) { std::_Exit(1); });  // ctest takes no abort for an answer
  const std::string fault = argc > 1 ? argv[1] : "";
  if (fault == "overflow") return overflowOfOwnCode(argc) == 0;
  if (fault == "memory") return readBehindTheEnd(argc) > 1;
  if (fault == "index") return indexBehindTheEnd(argc) > 1;
  std::puts("usage: watched_code overflow|memory|index");
  return 2;
}
