// tests/fuzz/onnx_fuzz.cpp: ONNX files: the reader of their declarations, and load and trial of a
// network in its child process.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "fuzz/fuzz_target.h"
#include "stereo/networks/disparity_network.h"
#include "stereo/networks/onnx_model.h"

namespace softscope::test {
namespace {

constexpr std::int64_t kLongestTried = 256;  // larger images are sound but slow

/// Gone with the program.
struct ModelFile {
  ModelFile()
      : path(std::filesystem::temp_directory_path() /
             ("softscope_fuzz_" + std::to_string(getpid()) + ".onnx")) {}
  ~ModelFile() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

/// True where it runs.
bool tryNetwork(const std::string& path) {
  DisparityNetwork network(path, NetworkInput::kLevels);
  network.prepare(64, 32, 63);
  return true;
}

}  // namespace
}  // namespace softscope::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const std::string_view bytes = textOf(data, size);
  const auto model = answerOf([&] { return parseOnnx(bytes, "fuzz"); });
  if (!model) return 0;
  mustHold(!model->operators.empty());
  const auto sized = answerOf([&] { return withInputShape(bytes, "fuzz", {1, 3, 32, 64}); });
  mustHold(sized.has_value());
  const auto again = answerOf([&] { return parseOnnx(*sized, "fuzz"); });
  mustHold(again && again->inputs.size() == model->inputs.size());
  for (const OnnxTensor& input : again->inputs) mustHold(input.shape.size() == 4);
  for (const OnnxTensor& input : model->inputs)
    for (const std::int64_t length : input.shape)
      if (length > kLongestTried) return 0;
  static const ModelFile file;
  std::ofstream(file.path, std::ios::binary) << bytes;
  answerOf([&] { return tryNetwork(file.path); });
  return 0;
}
