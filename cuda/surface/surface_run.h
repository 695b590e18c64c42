// cuda/surface/surface_run.h: memory, copies and launches of the search of the model's surface, on
// any machine.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "core/error.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/model/model_home.h"
#include "cuda/surface/surface_kernels.h"
#include "fusion/surface_search.h"

namespace softscope::cuda {

/// Machine: as WarpRun has it. Where the device fails the CPU answers from the host's model, so
/// that tracked points are never half moved: the next stage that needs the device says so.
template <class Machine>
class SurfaceRun final : public SurfaceSearch {
 public:
  template <class... Arguments>
  explicit SurfaceRun(Arguments&&... arguments)
      : home_(std::make_shared<ModelHome<Machine>>()),
        machine_(std::forward<Arguments>(arguments)...) {}
  /// A model that knows what has changed.
  void share(std::shared_ptr<ModelHome<Machine>> home) {
    home_ = std::move(home);
    is_shared_ = true;
  }

  std::vector<std::int32_t> nearestPoints(
      const PointModel& model, const std::vector<Eigen::Vector3f>& positions_mm) override {
    if (model.empty() || positions_mm.empty()) return on_cpu_.nearestPoints(model, positions_mm);
    try {
      return findNearest(model, positions_mm);
    } catch (const BackendError&) {
      return on_cpu_.nearestPoints(model, positions_mm);
    }
  }
  std::vector<SurfacePiece> piecesAround(
      const PointModel& model, const std::vector<Eigen::Vector3d>& positions_mm) override {
    if (model.empty() || positions_mm.empty()) return on_cpu_.piecesAround(model, positions_mm);
    try {
      return findPieces(model, positions_mm);
    } catch (const BackendError&) {
      return on_cpu_.piecesAround(model, positions_mm);
    }
  }

 private:
  std::vector<std::int32_t> findNearest(const PointModel& model,
                                        const std::vector<Eigen::Vector3f>& positions_mm) {
    const std::size_t count = positions_mm.size();
    const ModelArrays from = takeModel(model, count);
    ResetKernel reset;
    reset.add(surface_.nearest, count * 2, ~std::uint32_t{0});
    machine_.executor().launch("reset", reset, reset.blocks());
    machine_.toDevice(surface_.targets_mm, positions_mm.data(), count * sizeof(Eigen::Vector3f));
    const NearestPointKernel kernel{from, static_cast<int>(model.size()), surface_,
                                    static_cast<int>(count)};
    machine_.executor().launch("nearest point", kernel, kernel.blocks());
    auto* arrived = static_cast<unsigned long long*>(arrived_.data());
    machine_.fromDevice(arrived, surface_.nearest, count * sizeof *arrived);
    machine_.wait();
    std::vector<std::int32_t> nearest(count);
    std::transform(arrived, arrived + count, nearest.begin(), [](unsigned long long key) {
      return key == NearestPointKernel::kNone ? -1 : static_cast<std::int32_t>(key & 0xFFFFFFFFU);
    });
    return nearest;
  }

  std::vector<SurfacePiece> findPieces(const PointModel& model,
                                       const std::vector<Eigen::Vector3d>& positions_mm) {
    const std::size_t count = positions_mm.size();
    const ModelArrays from = takeModel(model, count);
    ResetKernel reset;
    reset.add(surface_.counts, count, 0);
    machine_.executor().launch("reset", reset, reset.blocks());
    machine_.toDevice(surface_.positions_mm, positions_mm.data(), count * sizeof(Eigen::Vector3d));
    const ListPieceKernel list{from, static_cast<int>(model.size()), surface_,
                               static_cast<int>(count)};
    machine_.executor().launch("list pieces", list, list.blocks());
    const SumPieceKernel sum{from, surface_, static_cast<int>(count)};
    machine_.executor().launch("sum pieces", sum, sum.blocks());
    const auto* arrived = static_cast<const PieceOfSurface*>(arrived_.data());
    machine_.fromDevice(arrived_.data(), surface_.pieces, count * sizeof *arrived);
    machine_.wait();
    std::vector<SurfacePiece> pieces(count);
    for (std::size_t k = 0; k < count; ++k) {
      if (arrived[k].points > kMostOfPiece) return on_cpu_.piecesAround(model, positions_mm);
      pieces[k].weight = arrived[k].sums[0];
      pieces[k].height_mm = arrived[k].sums[1];
      for (int c = 0; c < 3; ++c) pieces[k].normal[c] = arrived[k].sums[2 + c];
    }
    return pieces;
  }

  ModelArrays takeModel(const PointModel& model, std::size_t positions) {
    reserve(positions);
    if (!is_shared_) home_->changed(kWholeModel);
    return home_->bring(model, kModelShape | kModelLooks, 0, machine_);
  }
  void reserve(std::size_t positions) {
    if (positions <= capacity_) return;
    Arena counting;
    const SurfaceLayout planned(counting, positions);
    capacity_ = 0;
    memory_ = Memory();
    memory_ = Memory(counting.bytes(), kWhat);
    arrived_ = typename Machine::Pinned();
    arrived_ = typename Machine::Pinned(positions * sizeof(PieceOfSurface), kWhat);
    Arena arena(memory_.data());
    surface_ = SurfaceLayout(arena, positions);
    capacity_ = positions;
  }

  using Memory = typename Machine::Memory;
  static constexpr const char* kWhat = "memory for tracked points";

  std::shared_ptr<ModelHome<Machine>> home_;
  bool is_shared_ = false;
  Memory memory_;
  typename Machine::Pinned arrived_;
  Machine machine_;
  SurfaceLayout surface_;
  std::size_t capacity_ = 0;
  CpuSurfaceSearch on_cpu_;
};

}  // namespace softscope::cuda
