// src/stereo/networks/onnx_model.h: declarations of an ONNX file, read without a library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Text of a file, for messages of one line: shortened, without control characters.
std::string printable(std::string text, std::size_t longest = 60);

struct OnnxTensor {
  static constexpr int kFloat32 = 1;
  static constexpr std::int64_t kFree = -1;

  std::string name;
  int element_type = 0;             // TensorProto.DataType
  std::vector<std::int64_t> shape;  // kFree: stated when the network is run

  std::string text() const;  // "left: 1 x 3 x H x W float32"; a free length is `?`
};

struct OnnxOperator {
  std::string domain;  // empty: ONNX's own
  std::string name;    // "Conv"
  int inputs = 0;      // of its first node
};

/// Declarations of a network: its inputs without stored weights, its outputs, each operator once.
struct OnnxModel {
  std::vector<OnnxTensor> inputs, outputs;
  std::vector<OnnxOperator> operators;
  bool has_external_weights = false;  // in other files
};

/// `name` is the name of the file in messages. Throws
/// InputError if the bytes are no complete ONNX model.
OnnxModel parseOnnx(std::string_view bytes, const std::string& name);

/// The model with this shape declared for each of its inputs. Throws InputError as parseOnnx().
std::string withInputShape(std::string_view bytes, const std::string& name,
                           const std::vector<std::int64_t>& shape);

/// A model of one node of this operator, to test whether a library supports it.
std::string oneNodeModel(const OnnxOperator& wanted);

}  // namespace softscope
