#include "pipeline/backends.h"

#include "core/error.h"
#include "pipeline/cpu_backend.h"
#ifdef SOFTSCOPE_HAS_CUDA
#include "pipeline/cuda_backend.h"
#endif

namespace softscope {

// The only file that checks whether CUDA was built.
#ifdef SOFTSCOPE_HAS_CUDA
cuda::DeviceInfo cudaDevices() { return cuda::queryDevices(); }
std::vector<std::string> builtBackends() { return {"cpu", "cuda"}; }
#else
namespace {

constexpr const char* kNotBuilt =
    "this build has no CUDA: with a CUDA 12 or 13 toolkit installed, configure by "
    "`cmake --preset cuda`";

std::unique_ptr<StereoStage> makeCudaStereoStage(const StereoOptions&, const RectifiedRig&) {
  throw BackendError(kNotBuilt);
}
std::unique_ptr<ReconstructionBackend> makeCudaBackend(const StereoCalibration&,
                                                       const ReconstructionOptions&) {
  throw BackendError(kNotBuilt);
}

}  // namespace

cuda::DeviceInfo cudaDevices() {
  cuda::DeviceInfo info;
  info.why_none = kNotBuilt;
  return info;
}
std::vector<std::string> builtBackends() { return {"cpu"}; }
#endif

namespace {

/// Reason for the CPU under auto, by options and machine.
std::string gpuUnavailableReason(const FrameDepthOptions& depth) {
  if (depth.source == "files") return "depth.source is files, and stereo is what the GPU computes";
  if (depth.stereo.method != "elas") return depth.stereo.method + " has no GPU version";
  return cudaUnavailableReason();
}

/// `makeOnCpu()` or `makeOnGpu()`. `what` is computed by the GPU.
template <class MakeOnCpu, class MakeOnGpu>
auto choose(const std::string& name, const FrameDepthOptions& depth, const std::string& what,
            const MakeOnCpu& makeOnCpu, const MakeOnGpu& makeOnGpu)
    -> Chosen<decltype(makeOnCpu())> {
  requireBackendName(name);
  if (name == "cpu") return {makeOnCpu(), "cpu", ""};
  if (name == "cuda") {
    if (const std::string why = cudaUnavailableReason(); !why.empty())
      throw BackendError("`backend=` cuda: " + why + ". `backend=` cpu or auto needs no GPU");
    return {makeOnGpu(), "cuda", ""};
  }
  std::string why = gpuUnavailableReason(depth);
  if (why.empty()) try {
      return {makeOnGpu(), "cuda", what + " on the GPU"};
    } catch (const Error& error) {
      why = error.what();  // too little memory, or an option without kernels
    }
  return {makeOnCpu(), "cpu", why};
}

}  // namespace

std::string cudaUnavailableReason() {
  const cuda::DeviceInfo info = cudaDevices();
  if (info.devices.empty()) return info.why_none;
  const cuda::Device& first = info.devices.front();
  return first.problem.empty() ? "" : first.name + ": " + first.problem;
}

void requireBackendName(const std::string& name) {
  if (name != "auto" && name != "cpu" && name != "cuda")
    throw OptionError("`backend=` is `" + name + "`, but must be auto, cpu or cuda");
}

Chosen<std::unique_ptr<ReconstructionBackend>> makeBackend(const std::string& name,
                                                           const StereoCalibration& calibration,
                                                           const ReconstructionOptions& options) {
  return choose(
      name, options.depth, "stereo, matching, pose and the warp's solver",
      [&] { return makeCpuBackend(calibration, options); },
      [&] { return makeCudaBackend(calibration, options); });
}

Chosen<std::unique_ptr<FrameDepth>> makeFrameDepth(const std::string& name,
                                                   const StereoCalibration& calibration,
                                                   const FrameDepthOptions& options) {
  return choose(
      name, options, "stereo", [&] { return std::make_unique<FrameDepth>(calibration, options); },
      [&] { return std::make_unique<FrameDepth>(calibration, options, makeCudaStereoStage); });
}

}  // namespace softscope
