#include "pipeline/checkpoint.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/error.h"

namespace softscope {
namespace {

constexpr std::string_view kMagic = "softscope checkpoint 14\n";

/// FNV-1a, 64 bits, over 8 bytes at a time.
std::uint64_t checksumOf(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037ull;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    sum = (sum ^ word) * 1099511628211ull;
    sum ^= sum >> 29;
  }
  return sum;
}

class Writer {
 public:
  template <class Value>
  void value(const Value& value) {
    static_assert(std::is_arithmetic_v<Value>);
    raw(&value, sizeof value);
  }
  void text(const std::string& text) {
    value(static_cast<std::uint64_t>(text.size()));
    raw(text.data(), text.size());
  }
  /// Elements without pointers: numbers, Eigen's fixed sizes, and structs of them.
  template <class Element>
  void array(const std::vector<Element>& elements) {
    value(static_cast<std::uint64_t>(elements.size()));
    value(static_cast<std::uint64_t>(sizeof(Element)));
    raw(elements.data(), elements.size() * sizeof(Element));
  }
  void pose(const Eigen::Isometry3d& pose) { raw(pose.matrix().data(), 16 * sizeof(double)); }
  template <class Element, class Visit>
  void list(const std::vector<Element>& elements, const Visit& visit) {
    value(static_cast<std::uint64_t>(elements.size()));
    for (const Element& element : elements) visit(element);
  }
  std::string bytes;

 private:
  void raw(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  template <class Value>
  void value(Value& value) {
    raw(&value, sizeof value);
  }
  void text(std::string& text) {
    std::uint64_t size = 0;
    value(size);
    if (size > bytes_.size()) fail();
    text.resize(size);
    raw(text.data(), size);
  }
  template <class Element>
  void array(std::vector<Element>& elements) {
    std::uint64_t count = 0, element_size = 0;
    value(count);
    value(element_size);
    if (element_size != sizeof(Element) || count > bytes_.size() / sizeof(Element)) fail();
    elements.resize(count);
    raw(static_cast<void*>(elements.data()), count * sizeof(Element));
  }
  void pose(Eigen::Isometry3d& pose) { raw(pose.matrix().data(), 16 * sizeof(double)); }
  template <class Element, class Visit>
  void list(std::vector<Element>& elements, const Visit& visit) {
    std::uint64_t count = 0;
    value(count);
    if (count > bytes_.size()) fail();
    elements.clear();
    for (std::uint64_t i = 0; i < count; ++i) visit(elements.emplace_back());
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(name_ + ": the checkpoint is damaged. Start the run again without `resume=`");
  }
  void raw(void* data, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
  const std::string& name_;
};

/// One list of what a checkpoint holds, for writing and for reading.
template <class Archive, class Model>
void visitModel(Archive& archive, Model& model) {
  archive.array(model.positions_mm);
  archive.array(model.normals);
  archive.array(model.colours);
  archive.array(model.anchors);
  archive.array(model.weights);
  archive.array(model.bindings);
}

template <class Archive, class Graph>
void visitGraph(Archive& archive, Graph& graph) {
  archive.array(graph.positions_mm);
  archive.array(graph.transforms);
  archive.array(graph.since_reference);
  archive.array(graph.turned);
  archive.array(graph.edges);
  archive.array(graph.edge_shapes);
  archive.array(graph.stencils);
  archive.array(graph.inactive_pairs);
  archive.array(graph.afar);
}

template <class Archive, class Camera>
void visitCamera(Archive& archive, Camera& camera) {
  archive.value(camera.width_px);
  archive.value(camera.height_px);
  archive.value(camera.fx_px);
  archive.value(camera.fy_px);
  archive.value(camera.cx_px);
  archive.value(camera.cy_px);
}

template <class Archive, class Memory>
void visitMemory(Archive& archive, Memory& memory) {
  archive.value(memory.unexplained_mm.width_px);
  archive.value(memory.unexplained_mm.height_px);
  archive.array(memory.unexplained_mm.values);
  visitCamera(archive, memory.left);
  archive.pose(memory.world_from_left);
}

template <class Archive, class Last>
void visitLast(Archive& archive, Last& last) {
  archive.value(last.left.width_px);
  archive.value(last.left.height_px);
  archive.array(last.left.values);
  archive.pose(last.world_from_left);
}

template <class Archive, class Errors>
void visitErrors(Archive& archive, Errors& errors) {
  visitCamera(archive, errors.camera);
  archive.pose(errors.world_from_left);
  archive.value(errors.depth_mm.width_px);
  archive.value(errors.depth_mm.height_px);
  archive.array(errors.depth_mm.values);
  archive.value(errors.variance_mm2.width_px);
  archive.value(errors.variance_mm2.height_px);
  archive.array(errors.variance_mm2.values);
  archive.value(errors.same_surface_mm);
  archive.array(errors.nodes_mm2);
  archive.array(errors.nodes_mm);
  archive.value(errors.reference_sigma_mm);
}

template <class Archive, class State>
void visitState(Archive& archive, State& state) {
  visitModel(archive, state.model);
  visitGraph(archive, state.graph);
  archive.list(state.inactive, [&archive](auto& inactive) {
    visitModel(archive, inactive.points);
    archive.array(inactive.stencils);
    archive.array(inactive.nodes);
    archive.array(inactive.pairs);
    archive.array(inactive.nodes_mm);
    archive.array(inactive.turned);
  });
  visitMemory(archive, state.memory);
  archive.array(state.tracked.points);
  archive.value(state.tracked.fused_frames);
  archive.value(state.tracked.drift_mm2);
  visitErrors(archive, state.errors);
  visitLast(archive, state.last);
  archive.value(state.exposure.red);
  archive.value(state.exposure.green);
  archive.value(state.exposure.blue);
}

template <class Archive, class Scope>
void visitScope(Archive& archive, Scope& scope) {
  archive.value(scope.map);
  archive.pose(scope.world_from_left);
  archive.pose(scope.reference_pose);
  archive.array(scope.key_views);
  archive.value(scope.lost);
  archive.value(scope.scope_moves);
  archive.value(scope.fused_frames);
  archive.value(scope.unfused_frames);
  archive.value(scope.searches);
}

template <class Archive, class Whole>
void visit(Archive& archive, Whole& checkpoint) {
  archive.text(checkpoint.settings);
  archive.value(checkpoint.next_frame);
  visitState(archive, checkpoint.state.model);
  visitScope(archive, checkpoint.state.scope);
  archive.value(checkpoint.state.maps);
  archive.list(checkpoint.state.others, [&archive](auto& other) {
    visitState(archive, other.model);
    visitScope(archive, other.scope);
  });
}

}  // namespace

std::string checkpointBytes(const CheckpointView& checkpoint) {
  Writer writer;
  visit(writer, checkpoint);
  const std::uint64_t checksum = checksumOf(writer.bytes);
  std::string bytes(kMagic);
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  return bytes + writer.bytes;
}

Checkpoint parseCheckpoint(std::string_view bytes, const std::string& name) {
  std::uint64_t checksum = 0;
  const std::size_t head = kMagic.size() + sizeof checksum;
  if (bytes.size() < head || bytes.substr(0, kMagic.size()) != kMagic)
    throw InputError(name + ": is no checkpoint of this version. Start again without `resume=`");
  std::memcpy(&checksum, bytes.data() + kMagic.size(), sizeof checksum);
  if (checksumOf(bytes.substr(head)) != checksum)
    throw InputError(name + ": the checkpoint is damaged. Start the run again without `resume=`");
  Reader reader(bytes.substr(head), name);
  Checkpoint checkpoint;
  visit(reader, checkpoint);
  return checkpoint;
}

}  // namespace softscope
