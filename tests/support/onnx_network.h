// tests/support/onnx_network.h: small stereo networks as ONNX files, written by hand, without
// weights of any training.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace softscope::test {

/// Protobuf's wire format: a message is a text of fields.
namespace protobuf {

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 127; value >>= 7) bytes += static_cast<char>((value & 127) | 128);
  return bytes + static_cast<char>(value);
}
inline std::string number(int field, std::int64_t value) {
  return varint(static_cast<std::uint64_t>(field) << 3) + varint(static_cast<std::uint64_t>(value));
}
inline std::string text(int field, const std::string& bytes) {
  return varint(static_cast<std::uint64_t>(field) << 3 | 2) + varint(bytes.size()) + bytes;
}

}  // namespace protobuf

/// A length that the network leaves open is its name.
struct OnnxLength {
  OnnxLength(int length) : value(length) {}     // NOLINT
  OnnxLength(const char* open) : name(open) {}  // NOLINT
  std::string message() const {
    return value > 0 ? protobuf::number(1, value) : protobuf::text(2, name);
  }
  int value = 0;
  std::string name;
};
using OnnxShape = std::vector<OnnxLength>;

/// Builds a graph node by node; field numbers are those of onnx.proto.
class OnnxGraph {
 public:
  void input(const std::string& name, const OnnxShape& shape, int type = 1) {
    graph_ += protobuf::text(11, valueInfo(name, shape, type));
  }
  void output(const std::string& name, const OnnxShape& shape) {
    graph_ += protobuf::text(12, valueInfo(name, shape, 1));
  }
  void weights(const std::string& name, const std::vector<int>& shape,
               const std::vector<float>& values, const std::string& more = "") {
    std::string tensor;
    for (const int length : shape) tensor += protobuf::number(1, length);
    std::string raw(values.size() * sizeof(float), '\0');
    if (!values.empty()) std::memcpy(raw.data(), values.data(), raw.size());
    tensor += protobuf::number(2, 1) + protobuf::text(8, name) + protobuf::text(9, raw) + more;
    graph_ += protobuf::text(5, tensor);
  }
  void node(const std::string& operation, const std::vector<std::string>& inputs,
            const std::string& result, const std::string& attributes = "",
            const std::string& domain = "") {
    std::string node;
    for (const std::string& input : inputs) node += protobuf::text(1, input);
    node += protobuf::text(2, result) + protobuf::text(3, "make_" + result) +
            protobuf::text(4, operation) + attributes;
    if (!domain.empty()) node += protobuf::text(7, domain);
    graph_ += protobuf::text(1, node);
  }
  static std::string integers(const std::string& name, const std::vector<int>& values) {
    std::string attribute = protobuf::text(1, name);
    for (const int value : values) attribute += protobuf::number(8, value);
    return protobuf::text(5, attribute + protobuf::number(20, 7));
  }
  static std::string integer(const std::string& name, int value) {
    return protobuf::text(
        5, protobuf::text(1, name) + protobuf::number(3, value) + protobuf::number(20, 2));
  }
  std::string model() const {
    return protobuf::number(1, 7) + protobuf::text(7, graph_ + protobuf::text(2, "stereo")) +
           protobuf::text(8, protobuf::number(2, 11));
  }

 private:
  static std::string valueInfo(const std::string& name, const OnnxShape& shape, int type) {
    std::string lengths;
    for (const OnnxLength& length : shape) lengths += protobuf::text(1, length.message());
    const std::string tensor = protobuf::number(1, type) + protobuf::text(2, lengths);
    return protobuf::text(1, name) + protobuf::text(2, protobuf::text(1, tensor));
  }
  std::string graph_;
};

/// A plane sweep: absolute difference of left and shifted right image, averaged over a window, and
/// the mean of the disparities weighted by softmax(-sharpness * cost).
struct PlaneSweep {
  int disparities = 16;  // 0 to this, without
  int window_px = 5;
  float sharpness = 4.0f;  // per level of the images
  int channels = 3;
  OnnxLength height = "height", width = "width";
  float output_factor = 1;  // of the disparity
  std::string left = "left", right = "right", result = "disparity";
  bool right_first = false;
  std::vector<std::string> more;  // operators behind it, of one input

  OnnxShape imageShape() const { return {1, channels, height, width}; }

  OnnxGraph graph() const {
    const int n = disparities, reach = 2 * n - 1;
    const auto size = [](int a, int b) { return std::size_t(a) * std::size_t(b); };
    const float mean = 1.0f / static_cast<float>(channels);
    std::vector<float> same(size(n, channels), mean), shifts(size(n * channels, reach));
    std::vector<float> sharpen(size(n, n)), expect(size(n, 1));
    for (int d = 0; d < n; ++d) {
      for (int c = 0; c < channels; ++c)
        shifts[size(d * channels + c, reach) + std::size_t(n - 1 - d)] = mean;
      sharpen[size(d, n) + std::size_t(d)] = -sharpness;
      expect[std::size_t(d)] = output_factor * static_cast<float>(d);
    }
    OnnxGraph graph;
    if (right_first) graph.input(right, imageShape());
    graph.input(left, imageShape());
    if (!right_first) graph.input(right, imageShape());
    graph.weights("same", {n, channels, 1, 1}, same);
    graph.weights("shifts", {n, channels, 1, reach}, shifts);
    graph.weights("sharpen", {n, n, 1, 1}, sharpen);
    graph.weights("expect", {1, n, 1, 1}, expect);
    const int half = window_px / 2;
    graph.node("Conv", {left, "same"}, "l", OnnxGraph::integers("kernel_shape", {1, 1}));
    graph.node("Conv", {right, "shifts"}, "r",
               OnnxGraph::integers("kernel_shape", {1, reach}) +
                   OnnxGraph::integers("pads", {0, n - 1, 0, n - 1}));
    graph.node("Sub", {"l", "r"}, "difference");
    graph.node("Abs", {"difference"}, "cost");
    graph.node("AveragePool", {"cost"}, "mean",
               OnnxGraph::integers("kernel_shape", {window_px, window_px}) +
                   OnnxGraph::integers("pads", {half, half, half, half}) +
                   OnnxGraph::integers("strides", {1, 1}));
    graph.node("Conv", {"mean", "sharpen"}, "score", OnnxGraph::integers("kernel_shape", {1, 1}));
    graph.node("Softmax", {"score"}, "share", OnnxGraph::integer("axis", 1));
    std::string last = more.empty() ? result : "expected";
    graph.node("Conv", {"share", "expect"}, last, OnnxGraph::integers("kernel_shape", {1, 1}));
    for (std::size_t i = 0; i < more.size(); ++i) {
      const std::string next = i + 1 == more.size() ? result : "more" + std::to_string(i);
      graph.node(more[i], {last}, next);
      last = next;
    }
    graph.output(result, {1, 1, height, width});
    return graph;
  }
  std::string model() const { return graph().model(); }
};

}  // namespace softscope::test
