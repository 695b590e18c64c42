// eval/surfaces/hausdorff.cpp: percentiles and means, combined.
#include "eval/surfaces/hausdorff.h"

#include <algorithm>

namespace softscope {

HausdorffDistances hausdorffDistances(const std::vector<double>& forth_mm,
                                      const std::vector<double>& back_mm) {
  const Statistics forth = statistics(forth_mm), back = statistics(back_mm);
  HausdorffDistances result;
  if (forth.count == 0 || back.count == 0) return result;
  std::vector<double> both_mm = forth_mm;
  both_mm.insert(both_mm.end(), back_mm.begin(), back_mm.end());
  const Statistics both = statistics(both_mm);
  result.hd95_max_of_directed_mm = std::max(forth.p95, back.p95);
  result.hd95_pooled_mm = both.p95;
  result.hd95_mean_of_directed_mm = (forth.p95 + back.p95) / 2;
  result.hd_mm = both.max;
  result.assd_mm = both.mean;
  result.masd_mm = (forth.mean + back.mean) / 2;
  return result;
}

}  // namespace softscope
