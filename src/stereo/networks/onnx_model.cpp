// src/stereo/networks/onnx_model.cpp: protobuf's wire format, and the fields of ONNX that matter.
#include "stereo/networks/onnx_model.h"

#include <algorithm>
#include <optional>

#include "core/error.h"

namespace softscope {
namespace {

// Fields by number, as https://onnx.ai/onnx/api/classes.html lists them.
enum ModelField { kIrVersion = 1, kGraph = 7, kOpsetImport = 8 };
enum GraphField { kNode = 1, kGraphName = 2, kInitialiser = 5, kInput = 11, kOutput = 12 };
enum NodeField { kNodeInput = 1, kNodeOutput = 2, kNodeName = 3, kOpType = 4, kDomain = 7 };
enum ValueField { kValueName = 1, kValueType = 2 };
enum TensorField { kTensorName = 8, kDataLocation = 14 };
constexpr int kTensorType = 1, kElementType = 1, kShape = 2, kDimension = 1, kLength = 1;
constexpr std::uint64_t kExternal = 1;  // TensorProto.DataLocation
constexpr std::uint64_t kIrVersionWritten = 7, kOpsetWritten = 13;

enum WireType { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

struct OnnxField {
  int number = 0, type = 0;
  std::uint64_t value = 0;  // of a varint
  std::string_view bytes;   // of kBytes
  std::string_view whole;   // with its key and length
};

/// The fields of one message, in order.
class Message {
 public:
  Message(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  std::optional<OnnxField> next() {
    if (rest_.empty()) return std::nullopt;
    const std::string_view before = rest_;
    const std::uint64_t key = varint();
    OnnxField field;
    field.number = static_cast<int>(std::min<std::uint64_t>(key >> 3, 1 << 30));
    field.type = static_cast<int>(key & 7);
    if (field.number == 0) fail();
    if (field.type == kVarint)
      field.value = varint();
    else if (field.type == kBytes)
      field.bytes = take(varint());
    else if (field.type == kFixed64)
      take(8);
    else if (field.type == kFixed32)
      take(4);
    else
      fail();
    field.whole = before.substr(0, before.size() - rest_.size());
    return field;
  }

 private:
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(take(1)[0]);
      value |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) return value;
    }
    fail();
  }
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) fail();
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  [[noreturn]] void fail() const {
    throw InputError(file_ + ": isn't an ONNX model, or is damaged or cut short. Export it again");
  }

  std::string_view rest_;
  const std::string& file_;
};

template <class Visit>
void forEachField(std::string_view bytes, const std::string& file, const Visit& visit) {
  Message message(bytes, file);
  while (const auto field = message.next()) visit(*field);
}

/// A nested message, as stated by its key.
template <class Visit>
void forEachFieldOf(const OnnxField& field, const std::string& file, const Visit& visit) {
  if (field.type == kBytes) forEachField(field.bytes, file, visit);
}

std::string nameOf(const OnnxField& field) { return std::string(field.bytes); }

std::int64_t lengthOf(const OnnxField& dimension, const std::string& file) {
  std::int64_t length = OnnxTensor::kFree;
  forEachFieldOf(dimension, file, [&](const OnnxField& field) {
    const auto value = static_cast<std::int64_t>(field.value);
    if (field.number == kLength && field.type == kVarint && value > 0) length = value;
  });
  return length;
}

OnnxTensor tensorOf(const OnnxField& value, const std::string& file) {
  OnnxTensor tensor;
  forEachFieldOf(value, file, [&](const OnnxField& field) {
    if (field.number == kValueName) tensor.name = nameOf(field);
    if (field.number != kValueType) return;
    forEachFieldOf(field, file, [&](const OnnxField& type) {
      if (type.number != kTensorType) return;
      forEachFieldOf(type, file, [&](const OnnxField& part) {
        if (part.number == kElementType)
          tensor.element_type = static_cast<int>(std::min<std::uint64_t>(part.value, 1000));
        if (part.number != kShape) return;
        forEachFieldOf(part, file, [&](const OnnxField& dimension) {
          if (dimension.number == kDimension) tensor.shape.push_back(lengthOf(dimension, file));
        });
      });
    });
  });
  return tensor;
}

void addOperator(const OnnxField& node, const std::string& file, std::vector<OnnxOperator>* all) {
  OnnxOperator found;
  forEachFieldOf(node, file, [&](const OnnxField& field) {
    if (field.number == kNodeInput) ++found.inputs;
    if (field.number == kOpType) found.name = nameOf(field);
    if (field.number == kDomain) found.domain = nameOf(field);
  });
  if (found.domain == "ai.onnx") found.domain.clear();
  const auto is_same = [&](const OnnxOperator& other) {
    return other.name == found.name && other.domain == found.domain;
  };
  if (std::none_of(all->begin(), all->end(), is_same)) all->push_back(found);
}

OnnxModel graphOf(const OnnxField& graph, const std::string& file) {
  OnnxModel model;
  std::vector<std::string> stored;
  forEachFieldOf(graph, file, [&](const OnnxField& field) {
    if (field.number == kNode) addOperator(field, file, &model.operators);
    if (field.number == kInput) model.inputs.push_back(tensorOf(field, file));
    if (field.number == kOutput) model.outputs.push_back(tensorOf(field, file));
    if (field.number != kInitialiser) return;
    forEachFieldOf(field, file, [&](const OnnxField& part) {
      if (part.number == kTensorName) stored.push_back(nameOf(part));
      if (part.number == kDataLocation && part.value == kExternal)
        model.has_external_weights = true;
    });
  });
  std::sort(stored.begin(), stored.end());
  const auto is_stored = [&](const OnnxTensor& input) {
    return std::binary_search(stored.begin(), stored.end(), input.name);
  };
  model.inputs.erase(std::remove_if(model.inputs.begin(), model.inputs.end(), is_stored),
                     model.inputs.end());
  return model;
}

void addVarint(std::uint64_t value, std::string* bytes) {
  for (; value > 127; value >>= 7) bytes->push_back(static_cast<char>(value & 127) | char(-128));
  bytes->push_back(static_cast<char>(value));
}

void addNumber(int field, std::uint64_t value, std::string* bytes) {
  addVarint(static_cast<std::uint64_t>(field) << 3 | kVarint, bytes);
  addVarint(value, bytes);
}

void addBytes(int field, std::string_view content, std::string* bytes) {
  addVarint(static_cast<std::uint64_t>(field) << 3 | kBytes, bytes);
  addVarint(content.size(), bytes);
  bytes->append(content);
}

std::string valueInfo(const std::string& name, const std::vector<std::int64_t>& shape) {
  std::string dimensions, tensor, type, value;
  for (const std::int64_t length : shape) {
    std::string dimension;
    addNumber(kLength, static_cast<std::uint64_t>(length), &dimension);
    addBytes(kDimension, dimension, &dimensions);
  }
  addNumber(kElementType, OnnxTensor::kFloat32, &tensor);
  addBytes(kShape, dimensions, &tensor);
  addBytes(kTensorType, tensor, &type);
  addBytes(kValueName, name, &value);
  addBytes(kValueType, type, &value);
  return value;
}

bool isAmong(const std::vector<OnnxTensor>& tensors, const std::string& name) {
  return std::any_of(tensors.begin(), tensors.end(),
                     [&](const OnnxTensor& tensor) { return tensor.name == name; });
}

}  // namespace

std::string printable(std::string text, std::size_t longest) {
  text.resize(std::min(text.size(), longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

std::string OnnxTensor::text() const {
  std::string text = printable(name) + ":";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i == 0 ? " " : " x ") + (shape[i] == kFree ? "?" : std::to_string(shape[i]));
  return text + (element_type == kFloat32 ? " float32"
                                          : " of ONNX's type " + std::to_string(element_type));
}

OnnxModel parseOnnx(std::string_view bytes, const std::string& name) {
  OnnxModel model;
  bool has_version = false;
  forEachField(bytes, name, [&](const OnnxField& field) {
    if (field.number == kIrVersion && field.type == kVarint) has_version = field.value > 0;
    if (field.number == kGraph && field.type == kBytes) model = graphOf(field, name);
  });
  if (!has_version || model.operators.empty())
    throw InputError(name + ": isn't an ONNX model: it has no " +
                     (has_version ? "graph with operators" : "version of ONNX") +
                     ". Export the network as ONNX");
  return model;
}

std::string withInputShape(std::string_view bytes, const std::string& name,
                           const std::vector<std::int64_t>& shape) {
  const OnnxModel model = parseOnnx(bytes, name);
  std::string whole;
  forEachField(bytes, name, [&](const OnnxField& field) {
    if (field.number != kGraph || field.type != kBytes) {
      whole.append(field.whole);
      return;
    }
    std::string graph;
    forEachField(field.bytes, name, [&](const OnnxField& part) {
      const std::string input = part.number == kInput ? tensorOf(part, name).name : "";
      if (part.number == kInput && isAmong(model.inputs, input))
        addBytes(kInput, valueInfo(input, shape), &graph);
      else
        graph.append(part.whole);
    });
    addBytes(kGraph, graph, &whole);
  });
  return whole;
}

std::string oneNodeModel(const OnnxOperator& wanted) {
  std::string node, graph, opset, model;
  for (int i = 0; i < std::max(wanted.inputs, 1); ++i)
    addBytes(kNodeInput, "in" + std::to_string(i), &node);
  addBytes(kNodeOutput, "out", &node);
  addBytes(kNodeName, "node", &node);
  addBytes(kOpType, wanted.name, &node);
  addBytes(kDomain, wanted.domain, &node);
  addBytes(kNode, node, &graph);
  addBytes(kGraphName, "probe", &graph);
  for (int i = 0; i < std::max(wanted.inputs, 1); ++i)
    addBytes(kInput, valueInfo("in" + std::to_string(i), {1, 1, 8, 8}), &graph);
  addBytes(kOutput, valueInfo("out", {1, 1, 8, 8}), &graph);
  addNumber(2, kOpsetWritten, &opset);
  addNumber(kIrVersion, kIrVersionWritten, &model);
  addBytes(kGraph, graph, &model);
  addBytes(kOpsetImport, opset, &model);
  return model;
}

}  // namespace softscope
