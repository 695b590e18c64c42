#include "deform/graph/model_warp.h"

#include <utility>

#include "deform/graph/warp.h"

namespace softscope {

bool CpuModelWarp::apply(const WarpGraph& graph, PointModel* model) {
  std::swap(positions_mm_, model->positions_mm);
  std::swap(normals_, model->normals);
  warpModel(graph, positions_mm_, normals_, model);
  return true;
}

void CpuModelWarp::undo(PointModel* model) {
  std::swap(positions_mm_, model->positions_mm);
  std::swap(normals_, model->normals);
}

}  // namespace softscope
